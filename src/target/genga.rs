//! The target of a number of genga.

use std::cmp::Ordering;

use super::counter::Counter;
use super::{Outcome, Shortfall, Target, between, key_count_search, reasons};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{AtRests, Fill, Merge, Rank};
use crate::motion::is_still;
use crate::recipe::Recipe;

/// Most settings tried: one more found key is nearly always one more genga.
const MOST_LOOKS: usize = 16;

/// Finds settings with which the sheet has `count` genga, including first and last drawing, or as near as possible.
///
/// One more found key is one more genga, or none if it falls on the koma of a pin or of an end. So the number of found
/// keys is corrected by the difference until it is right.
pub(super) fn meet(
    counter: &mut impl Counter,
    recipe: &Recipe,
    edits: &Edits,
    count: usize,
) -> Result<(Recipe, Outcome), Error> {
    let outcome = |reached: usize, shortfall| Outcome {
        target: Target::Keys(count),
        reached: reached as f64,
        shortfall,
    };
    let there = counter.genga(recipe, edits)?;
    if there == count {
        return Ok((recipe.clone(), outcome(there, None)));
    }
    if there < count && is_still(counter.engine().clip()) {
        let why = Shortfall::new(
            "nothing moves in the clip, and all genga would be one",
            "動きがなく、原画はみな同じ画になる",
        );
        return Ok((recipe.clone(), outcome(there, Some(why))));
    }
    // A requested number takes precedence over rests: they are still held, but their ends compete like other moments.
    let mut free = recipe.clone();
    free.keys.at_rests = AtRests::Off;
    let there = counter.genga(&free, edits)?;
    let Looked { reached, mut recipe, over } = look(counter, &free, edits, (count, there))?;
    if reached == count && recipe.keys.rank == Rank::Price {
        let priced = key_count_search::by_price(counter, &recipe, edits)?;
        if counter.genga(&priced, edits)? == count {
            recipe = priced;
        }
    }
    let shortfall = match reached.cmp(&count) {
        Ordering::Equal => None,
        Ordering::Less => Some(match over {
            Some(over) => Shortfall::new(
                format!("with a key more there are {over}"),
                format!("原画をもう1枚選ぶと{over}枚になる"),
            ),
            None => too_few(&recipe, edits),
        }),
        Ordering::Greater if edits.freeze() => reasons::settled(edits),
        Ordering::Greater => {
            let engine = counter.engine();
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
    counter: &mut impl Counter,
    recipe: &Recipe,
    edits: &Edits,
    (count, there): (usize, usize),
) -> Result<Looked, Error> {
    let mut best = Looked { reached: there, recipe: recipe.clone(), over: None };
    let (mut wanted, mut now) = (counter.found(recipe, edits)?, there);
    for _ in 0..MOST_LOOKS {
        let next = (wanted + count).saturating_sub(now);
        if best.reached == count || next == wanted {
            break;
        }
        wanted = next;
        let tried = key_count_search::with_counted(counter, recipe, edits, wanted)?;
        now = counter.genga(&tried, edits)?;
        let over = best.over.or((now > count).then_some(now));
        let is_all = counter.found(&tried, edits)? < wanted;
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

fn too_few(recipe: &Recipe, edits: &Edits) -> Shortfall {
    if let Some(why) = reasons::settled(edits) {
        return why;
    }
    let limits = reasons::limits(recipe, edits);
    let within = limits.japanese();
    match (recipe.keys.merge, recipe.keys.fill) {
        (Merge::Body, Fill::On) => {
            let stay = recipe.spacing.on.stay();
            let (way, more) = match stay > 1 {
                true => ("; spacing.on=1 has more", "。spacing.on=1 なら増やせる"),
                false => ("", ""),
            };
            Shortfall::new(
                format!(
                    "there is no room for another{limits}: a drawing stays for {stay} koma at the least{way}"
                ),
                format!("{within}もう入らない: 1枚の画は最低{stay}コマ見せる{more}"),
            )
        }
        (Merge::Body, Fill::Off) => Shortfall::new(
            format!(
                "the body turns at no other moment{limits}; keys.fill=on takes every koma, and a smaller \
                 filter.width or turns.persistence finds more turns"
            ),
            format!(
                "{within}ほかに全身の変わり目がない。keys.fill=on ならどのコマも選べ、filter.width か \
                 turns.persistence を小さくすると変わり目が増える"
            ),
        ),
        _ => Shortfall::new(
            format!(
                "no joint turns at any other moment{limits}; keys.merge=body takes every koma, and a smaller \
                 turns.steady or turns.persistence finds more turns"
            ),
            format!(
                "{within}ほかに部位の変わり目がない。keys.merge=body ならどのコマも選べ、turns.steady か \
                 turns.persistence を小さくすると変わり目が増える"
            ),
        ),
    }
}
