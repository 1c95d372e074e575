//! Targets that gaits prevent: the steps of the gaits give way.

use super::counter::Counter;
use super::{Outcome, Target};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::AtGaits;
use crate::recipe::Recipe;

/// Meets a target. If gaits prevent that, tries without them and takes whichever result comes nearer. Of a largest error
/// that both meet, it takes the one with fewer keys.
pub(super) fn meet<C: Counter>(
    counter: &mut C,
    recipe: &Recipe,
    edits: &Edits,
    meet: impl Fn(&mut C, &Recipe) -> Result<(Recipe, Outcome), Error>,
) -> Result<(Recipe, Outcome), Error> {
    let met = meet(counter, recipe)?;
    let near = match met.1.target {
        // A whole number of drawings can be off by up to half a drawing.
        Target::DrawingsPerSecond(_) => {
            let breakdown = counter.engine().run(&met.0, edits)?;
            let seconds = breakdown.sheet.length() as f64 / breakdown.clock.koma_rate;
            0.5 * breakdown.sheet.rounds() as f64 / seconds + 1e-9
        }
        Target::Keys(_) | Target::MaxError(_) => 0.0,
    };
    let asks_for_few = matches!(met.1.target, Target::MaxError(_));
    if excess(&met.1) <= near && !asks_for_few || counter.gaits(&met.0, edits)? == 0 {
        return Ok(met);
    }
    let mut free = recipe.clone();
    free.keys.gaits = AtGaits::Off;
    let other = meet(counter, &free)?;
    if asks_for_few && excess(&met.1) <= near && excess(&other.1) <= near {
        let [own, without] = [&met.0, &other.0].map(|recipe| counter.genga(recipe, edits));
        return Ok(if without? < own? { other } else { met });
    }
    Ok(if excess(&other.1) < excess(&met.1) { other } else { met })
}

/// Returns how far an outcome misses its target: in genga, in drawings per second, or as excess in % of body height.
fn excess(Outcome { target, reached, .. }: &Outcome) -> f64 {
    match *target {
        Target::Keys(asked) => (reached - asked as f64).abs(),
        Target::DrawingsPerSecond(asked) => (reached - asked).abs(),
        Target::MaxError(most) => (reached - most).max(0.0),
    }
}
