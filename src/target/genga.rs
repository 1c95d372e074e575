//! The target of a number of genga.

use std::cmp::Ordering;

use super::{Outcome, Target, between, key_count_search, layer, reasons};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{AtRests, Fill, Merge, Rank};
use crate::motion::is_still;
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// Most settings tried: one more found key is nearly always one more genga.
const MOST_LOOKS: usize = 16;

/// Finds settings with which the sheet has `count` genga, including first and last drawing, or as near as possible.
///
/// One more found key is one more genga, or none if it falls on the koma of a pin or of an end. So the number of found
/// keys is corrected by the difference until it is right.
pub(super) fn meet(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    count: usize,
) -> Result<(Recipe, Outcome), Error> {
    let outcome = |reached: usize, shortfall| Outcome {
        target: Target::Keys(count),
        reached: reached as f64,
        shortfall,
    };
    let there = genga(engine, recipe, edits)?;
    if there == count {
        return Ok((recipe.clone(), outcome(there, None)));
    }
    if there < count && is_still(engine.clip()) {
        let why = "nothing moves in the clip, and all genga would be one";
        return Ok((recipe.clone(), outcome(there, Some(why.into()))));
    }
    // A requested number takes precedence over rests: they are still held, but their ends compete like other moments.
    let mut free = recipe.clone();
    free.keys.at_rests = AtRests::Off;
    let there = genga(engine, &free, edits)?;
    let Looked { reached, mut recipe, over } = look(engine, &free, edits, (count, there))?;
    if reached == count && recipe.keys.rank == Rank::Price {
        let priced = key_count_search::by_price(engine, &recipe, edits)?;
        if genga(engine, &priced, edits)? == count {
            recipe = priced;
        }
    }
    let shortfall = match reached.cmp(&count) {
        Ordering::Equal => None,
        Ordering::Less => Some(match over {
            Some(over) => format!("with a key more there are {over}"),
            None => too_few(&recipe, edits),
        }),
        Ordering::Greater if edits.freeze() => reasons::settled(edits).map(String::from),
        Ordering::Greater => {
            let left = engine.find_keys(&recipe, edits)?.keys.keys.clone();
            Some(reasons::staying(between(&engine.run(&recipe, edits)?), &left))
        }
    };
    Ok((recipe, outcome(reached, shortfall)))
}

/// The nearest result found for a number of genga.
struct Looked {
    reached: usize,
    recipe: Recipe,
    /// A number beyond the target, if one was met on the way.
    over: Option<usize>,
}

/// Searches for the number of found keys that gives `count` genga, starting from `there`.
fn look(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    (count, there): (usize, usize),
) -> Result<Looked, Error> {
    let mut best = Looked { reached: there, recipe: recipe.clone(), over: None };
    let (mut wanted, mut now) = (key_count_search::found(engine, recipe, edits)?, there);
    for _ in 0..MOST_LOOKS {
        let next = (wanted + count).saturating_sub(now);
        if best.reached == count || next == wanted {
            break;
        }
        wanted = next;
        let tried = key_count_search::with_found(engine, recipe, edits, wanted)?;
        now = genga(engine, &tried, edits)?;
        let over = best.over.or((now > count).then_some(now));
        let is_all = key_count_search::found(engine, &tried, edits)? < wanted;
        if now.abs_diff(count) < best.reached.abs_diff(count) {
            best = Looked { reached: now, recipe: tried, over };
        }
        best.over = over;
        if is_all {
            break;
        }
    }
    Ok(best)
}

/// Counts the genga on the sheet of a recipe.
fn genga(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> Result<usize, Error> {
    Ok(layer(&engine.run(recipe, edits)?).genga())
}

fn too_few(recipe: &Recipe, edits: &Edits) -> String {
    if let Some(why) = reasons::settled(edits) {
        return why.into();
    }
    let limits = reasons::limits(recipe, edits);
    match (recipe.keys.merge, recipe.keys.fill) {
        (Merge::Body, Fill::On) => {
            let stay = recipe.spacing.on.stay();
            let way = if stay > 1 { "; spacing.on=1 has more" } else { "" };
            format!(
                "there is no room for another{limits}: a drawing stays for {stay} koma at the least{way}"
            )
        }
        (Merge::Body, Fill::Off) => format!(
            "the body turns at no other moment{limits}; keys.fill=on takes every koma, and a smaller \
             filter.width or turns.persistence finds more turns"
        ),
        _ => format!(
            "no joint turns at any other moment{limits}; keys.merge=body takes every koma, and a smaller \
             turns.steady or turns.persistence finds more turns"
        ),
    }
}
