//! Finds settings with room for a number of found keys.

use super::counter::Counter;
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{AtRests, Key, Rank};
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// Range of prices searched, in % of body height.
const PRICES: (f64, f64) = (0.01, 1000.0);

/// Bisection steps over that range; nearer prices are indistinguishable.
const HALVINGS: usize = 20;

/// Finds a recipe with `count` found keys, or as many as there are: sets the limit per second, and drops the price if
/// too few keys are worth it. If rests leave too few other moments, they become moments too.
pub fn with_found(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    count: usize,
) -> Result<Recipe, Error> {
    with_counted(engine, recipe, edits, count)
}

/// Finds the same with any counter.
pub(super) fn with_counted(
    counter: &mut impl Counter,
    recipe: &Recipe,
    edits: &Edits,
    count: usize,
) -> Result<Recipe, Error> {
    let seconds = seconds(counter.engine(), recipe);
    let mut roomy = recipe.clone();
    roomy.keys.per_second = per_second(count, seconds);
    if counter.found(&roomy, edits)? < count && roomy.keys.rank == Rank::Price {
        roomy.keys.min_price = 0.0;
    }
    if counter.found(&roomy, edits)? < count {
        roomy.keys.at_rests = AtRests::Off;
    }
    Ok(roomy)
}

/// Replaces the limit by a price that gives the same number of keys; leaves the recipe as it is if no price does.
///
/// A price values a key independently of the clip's length, and leaves no keys above a limit.
pub(super) fn by_price(
    counter: &mut impl Counter,
    recipe: &Recipe,
    edits: &Edits,
) -> Result<Recipe, Error> {
    let count = counter.found(recipe, edits)?;
    let mut priced = recipe.clone();
    priced.keys.per_second = f64::INFINITY;
    let mut at = |price: f64| {
        priced.keys.min_price = price;
        Ok::<_, Error>((counter.found(&priced, edits)?, priced.clone()))
    };
    let (mut low, mut high) = PRICES;
    for _ in 0..HALVINGS {
        let price = (low * high).sqrt();
        let there = at(price)?.0;
        if there != count {
            *if there > count { &mut low } else { &mut high } = price;
            continue;
        }
        for decimals in 0..6 {
            let scale = 10_f64.powi(decimals);
            let (there, short) = at((price * scale).round() / scale)?;
            if there == count && short.keys.min_price > 0.0 {
                return Ok(short);
            }
        }
        return Ok(at(price)?.1);
    }
    Ok(recipe.clone())
}

/// Counts the keys of a recipe that are there because they are worth it. Corrections that change only their
/// neighbourhood come after the settings, so keys that they add or remove do not count.
pub(super) fn count_found(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
) -> Result<usize, Error> {
    if edits.only_pins || edits.freeze() {
        return Ok(0);
    }
    let found = engine.find_keys(recipe, edits)?;
    let keys = if edits.again { &found.keys.keys } else { found.uncorrected };
    let is_found = |key: &&Key| key.origin.is_found();
    Ok(keys.iter().filter(is_found).count())
}

/// Returns the duration of the clip's sheet in seconds.
fn seconds(engine: &Engine, recipe: &Recipe) -> f64 {
    let clip = engine.clip();
    clip.rate().koma_from_frames(clip.len(), recipe.rate) as f64 / recipe.rate
}

/// Returns the limit with the fewest digits that lets through exactly `count` keys.
fn per_second(count: usize, seconds: f64) -> f64 {
    let allowed = |limit: f64| limit > 0.0 && (limit * seconds).floor() == count as f64;
    let limit = (count as f64 + 0.5) / seconds;
    let rounded = |decimals| {
        let scale = 10_f64.powi(decimals);
        (limit * scale).floor() / scale
    };
    (0..=15).map(rounded).find(|short| allowed(*short)).unwrap_or(limit)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_limit_has_no_more_digits_than_it_takes() {
        assert_eq!(per_second(24, 10.0), 2.4);
        assert_eq!(per_second(9, 3.8), 2.5);
        assert_eq!(per_second(0, 4.0), 0.1);
    }

    proptest! {
        #[test]
        fn a_limit_lets_through_exactly_so_many(count in 0usize..3000, koma in 1usize..30_000) {
            let seconds = koma as f64 / 24.0;
            prop_assert_eq!((per_second(count, seconds) * seconds).floor(), count as f64);
        }
    }
}
