//! A number of genga: how many keys there is room for.

use super::{Outcome, Target, between, layer, reasons, room};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{Fill, Merge, Rank};
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// Settings that are looked at: a found key more is nearly always a genga more.
const MOST_LOOKS: usize = 16;

/// Settings with which the sheet has `count` genga, first and last drawing among them, or as near as it gets.
///
/// A found key more is a genga more on the sheet or, where it falls on the koma of a pin or of an end,
/// none. So the number of found keys is corrected by what is missing until it is right.
pub(super) fn meet(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    count: usize,
) -> Result<(Recipe, Outcome), Error> {
    let target = Target::Keys(count);
    let mut best = (layer(&engine.run(recipe, edits)?).genga(), recipe.clone());
    if best.0 == count {
        return Ok((best.1, Outcome { target, reached: count as f64, shortfall: None }));
    }
    let mut wanted = room::found(engine, recipe, edits)?;
    let mut now = best.0;
    for _ in 0..MOST_LOOKS {
        let next = (wanted + count).saturating_sub(now);
        if best.0 == count || next == wanted {
            break;
        }
        wanted = next;
        let tried = room::with_found(engine, recipe, edits, wanted)?;
        now = layer(&engine.run(&tried, edits)?).genga();
        let is_all = room::found(engine, &tried, edits)? < wanted;
        if now.abs_diff(count) < best.0.abs_diff(count) {
            best = (now, tried);
        }
        if is_all {
            break;
        }
    }
    let (reached, mut recipe) = best;
    if reached == count && recipe.keys.rank == Rank::Price {
        let priced = room::by_price(engine, &recipe, edits)?;
        if layer(&engine.run(&priced, edits)?).genga() == count {
            recipe = priced;
        }
    }
    let shortfall = match reached.cmp(&count) {
        std::cmp::Ordering::Equal => None,
        std::cmp::Ordering::Less => Some(too_few(&recipe, edits)),
        std::cmp::Ordering::Greater if edits.freeze() => reasons::settled(edits).map(String::from),
        std::cmp::Ordering::Greater => {
            let left = engine.find_keys(&recipe, edits)?.keys.keys.clone();
            Some(reasons::staying(between(&engine.run(&recipe, edits)?), &left))
        }
    };
    Ok((recipe, Outcome { target, reached: reached as f64, shortfall }))
}

fn too_few(recipe: &Recipe, edits: &Edits) -> String {
    if let Some(why) = reasons::settled(edits) {
        return why.into();
    }
    let limits = reasons::limits(recipe, edits);
    match (recipe.keys.merge, recipe.keys.fill) {
        (Merge::Body, Fill::On) => {
            format!(
                "there is no room for another{limits}: keys stand as far apart as a drawing stays"
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
