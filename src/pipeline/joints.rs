//! The per-joint stages: smoothing the speeds and finding their turns.

use std::sync::Arc;

use super::stage::{Of, Stage};
use crate::motion::Clip;
use crate::recipe::Recipe;
use crate::signal::{LowPass, Signals, Spectrum, Turn, TurnFinder};
use crate::time::Span;

/// The stages of all joints, each with its last output.
#[derive(Debug, Clone, Default)]
pub(super) struct JointStages {
    pub(super) filtered: Stage<LowPass, Signals>,
    /// The turns at any persistence, and (in `turns`) those that the persistence confirms.
    pub(super) turning: Stage<(TurnFinder, f64), Vec<Vec<Turn>>>,
    pub(super) turns: Stage<TurnFinder, Vec<Vec<Turn>>>,
}

impl JointStages {
    /// Smooths the speeds and finds their turns.
    pub(super) fn turn(
        &mut self,
        clip: Of<'_, Arc<Clip>>,
        speed: Of<'_, Spectrum>,
        recipe: &Recipe,
    ) {
        let speed = (speed,);
        self.filtered.make(speed, recipe.filter.clone(), |(speed,), filter| filter.apply(&speed));
        // A candidate stores for how long it holds, so another persistence needs no new search.
        let search = TurnFinder { persistence: Span::Frames(0.0), ..recipe.turns.clone() };
        let settings = (search, recipe.filter.delay(clip.rate()));
        let filtered = self.filtered.output();
        self.turning.make((filtered,), settings, |(filtered,), (search, delay)| {
            search.candidates(&filtered, *delay)
        });
        let inputs = (self.turning.output(), filtered);
        self.turns.make(inputs, recipe.turns.clone(), |(candidates, filtered), finder| {
            finder.confirmed(&candidates, &filtered)
        });
    }

    /// Drops outputs that only a further run would use.
    pub(super) fn forget(&mut self) {
        self.turning.forget();
    }
}
