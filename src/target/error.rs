//! A largest error: the fewest keys of the ranked list with which the body is nowhere further off.

use super::{Outcome, Target};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::Origin;
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// Settings with the fewest keys that put the body nowhere further off than `most`, in % of its height;
/// with all keys when no number of them will do.
pub(super) fn meet(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    most: f64,
) -> Result<(Recipe, Outcome), Error> {
    let (ranking, fewest) = engine.fewest_within(most, recipe, edits)?;
    let count = fewest.unwrap_or(ranking.found.len());
    let (_, now) = engine.find_keys(recipe, edits)?;
    let found = now.keys.iter().filter(|key| key.origin == Origin::Found).count();
    let mut recipe = recipe.clone();
    if found != count {
        recipe.keys = ranking.keeping(count, &recipe.keys);
    }
    let reached = engine.reconstruction(&recipe, edits)?.worst();
    let shortfall = (reached > most).then(|| {
        let keys = ranking.staying.len() + count;
        format!(
            "all {keys} keys are there, and between two of them the body goes another way than a slerp; pin a \
             frame where it is furthest off"
        )
    });
    Ok((recipe, Outcome { target: Target::MaxError(most), reached, shortfall }))
}
