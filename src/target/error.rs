//! A largest error: the fewest keys of the ranked list with which the body is nowhere further off.

use super::{Outcome, Target, reasons};
use crate::edits::{Edits, Forbidden};
use crate::error::Error;
use crate::keys::Origin;
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::time::Frame;

/// Settings with the fewest keys that put the body nowhere further off than `most`, in % of its height;
/// where no number of keys will do, with the fewest that put it further off on the fewest koma.
pub(super) fn meet(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    most: f64,
) -> Result<(Recipe, Outcome), Error> {
    let (ranking, count) = engine.fewest_within(most, recipe, edits)?;
    let (_, now) = engine.find_keys(recipe, edits)?;
    let found = now.keys.iter().filter(|key| key.origin == Origin::Found).count();
    let mut recipe = recipe.clone();
    if found != count {
        recipe.keys = ranking.keeping(count, &recipe.keys);
    }
    let rebuilt = engine.reconstruction(&recipe, edits)?;
    let reached = rebuilt.worst();
    let shortfall = (reached > most).then(|| {
        let koma = rebuilt.errors.iter().position(|error| *error == reached).unwrap_or(0);
        let worst = Frame(engine.clip().clock(recipe.rate).place_from_koma(koma).round() as usize);
        let beyond = rebuilt.errors.iter().filter(|error| **error > most).count();
        let all = rebuilt.errors.len();
        format!("on {beyond} of {all} koma {}", too_far(&recipe, edits, worst))
    });
    Ok((recipe, Outcome { target: Target::MaxError(most), reached, shortfall }))
}

/// Why some koma are further off, the worst of them near a frame, and what helps.
fn too_far(recipe: &Recipe, edits: &Edits, worst: Frame) -> String {
    let why = if edits.only_pins {
        format!("it is further off: {}", reasons::ONLY_PINS)
    } else {
        let limits = reasons::limits(recipe, edits);
        format!("no key where a joint turns{limits} comes nearer")
    };
    let way = if edits.forbidden.contains(&Forbidden::one(worst)) {
        ", which is forbidden".into()
    } else {
        format!(": --pin {worst} helps")
    };
    format!("{why}; the worst is near frame {worst}{way}")
}
