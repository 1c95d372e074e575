//! A number of genga: how many keys there is room for.

use std::cmp::Ordering;

use super::{Outcome, Target, between, layer, reasons, room};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{AtRests, Fill, Merge, Rank};
use crate::motion::is_still;
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
    // A number that is asked for wins over rests: they hold on the sheet, but their ends are moments like others.
    let mut free = recipe.clone();
    free.keys.at_rests = AtRests::Off;
    let there = genga(engine, &free, edits)?;
    let Looked { reached, mut recipe, over } = look(engine, &free, edits, (count, there))?;
    if reached == count && recipe.keys.rank == Rank::Price {
        let priced = room::by_price(engine, &recipe, edits)?;
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

/// The nearest to a number of genga that was found.
struct Looked {
    reached: usize,
    recipe: Recipe,
    /// A number beyond the one that is asked for, where that was met on the way.
    over: Option<usize>,
}

/// Looks for the number of found keys with which there are so many genga, from those that there are.
fn look(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    (count, there): (usize, usize),
) -> Result<Looked, Error> {
    let mut best = Looked { reached: there, recipe: recipe.clone(), over: None };
    let (mut wanted, mut now) = (room::found(engine, recipe, edits)?, there);
    for _ in 0..MOST_LOOKS {
        let next = (wanted + count).saturating_sub(now);
        if best.reached == count || next == wanted {
            break;
        }
        wanted = next;
        let tried = room::with_found(engine, recipe, edits, wanted)?;
        now = genga(engine, &tried, edits)?;
        let over = best.over.or((now > count).then_some(now));
        let is_all = room::found(engine, &tried, edits)? < wanted;
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

/// How many genga the sheet of a recipe has.
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
