//! A number of genga: how far down the ranked list keys go.

use std::collections::BTreeSet;

use super::{Outcome, Target, genga, reasons};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::Ranking;
use crate::motion::Clip;
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::time::Frame;

/// Settings with which the sheet has `count` genga, or as near as the ranked list comes.
///
/// The list is nested, so a key more of it is a genga more on the sheet or, where it falls on the koma of
/// another or of an end, none: every number from that of the keys that stay to that of all is there.
pub(super) fn meet(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    count: usize,
) -> Result<(Recipe, Outcome), Error> {
    let target = Target::Keys(count);
    if genga(&engine.run(recipe, edits)?) == count {
        return Ok((recipe.clone(), Outcome { target, reached: count as f64, shortfall: None }));
    }
    let ranking = engine.rank(recipe, edits)?;
    let found = reaching(count, &ranking, engine.clip(), recipe.rate);
    let keys = ranking.keeping(found, &recipe.keys);
    let recipe = Recipe { keys, ..recipe.clone() };
    let reached = genga(&engine.run(&recipe, edits)?);
    let shortfall = match reached.cmp(&count) {
        std::cmp::Ordering::Equal => None,
        std::cmp::Ordering::Less => Some(too_few(&recipe, edits)),
        std::cmp::Ordering::Greater => {
            let (_, left) = engine.find_keys(&recipe, edits)?;
            Some(reasons::staying(reached, &left.keys))
        }
    };
    Ok((recipe, Outcome { target, reached: reached as f64, shortfall }))
}

/// How many of the found keys give so many genga: the fewest that do, else as near as it gets.
fn reaching(count: usize, ranking: &Ranking, clip: &Clip, koma_rate: f64) -> usize {
    let clock = clip.clock(koma_rate);
    let last = clip.rate().koma_from_frames(clip.len(), koma_rate).saturating_sub(1);
    let mut taken = BTreeSet::from([0, last]);
    let mut genga = 0;
    let mut put = |frame: Frame| {
        let koma = clock.koma_from_place(frame.0 as f64).min(last);
        genga += usize::from(taken.insert(koma));
        genga
    };
    let staying = ranking.staying.iter().map(|frame| put(*frame)).last().unwrap_or(0);
    if staying >= count {
        return 0;
    }
    let enough = ranking.found.iter().position(|key| put(key.frame) == count);
    enough.map_or(ranking.found.len(), |at| at + 1)
}

fn too_few(recipe: &Recipe, edits: &Edits) -> String {
    if edits.only_pins {
        return reasons::ONLY_PINS.into();
    }
    format!(
        "no joint turns at any other moment{}; a pin makes a key anywhere, and a smaller turns.steady or \
         turns.persistence finds more turns",
        reasons::limits(recipe, edits)
    )
}
