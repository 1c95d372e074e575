//! Counts keys, genga and gaits for the search (枚数を数える), at once or one count a step.

use super::{key_count_search, layer};
use crate::edits::Edits;
use crate::error::Error;
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// Counts what a recipe gives. A search asks for nearly all of its work in this way.
pub(super) trait Counter {
    /// The keys of a recipe that are there because they are worth it.
    fn found(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error>;

    /// The genga on the sheet of a recipe.
    fn genga(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error>;

    /// The gaits in all layers of a recipe.
    fn gaits(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error>;

    /// The engine that counts.
    fn engine(&mut self) -> &mut Engine;
}

impl Counter for Engine {
    fn found(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error> {
        key_count_search::count_found(self, recipe, edits)
    }

    fn genga(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error> {
        Ok(layer(&self.run(recipe, edits)?).genga())
    }

    fn gaits(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error> {
        let layers = self.run(recipe, edits)?.layers();
        Ok(layers.map(|layer| layer.keys.gaits.len()).sum())
    }

    fn engine(&mut self) -> &mut Engine {
        self
    }
}

/// What was counted for a recipe.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    Found,
    Genga,
    Gaits,
}

/// The counts of a search so far.
pub(super) type Known = Vec<(Of, Recipe, usize)>;

/// Counts once, and takes all other counts from a search's earlier steps. A second count is refused with an error, for
/// which the search stops: it is begun again in the next step, and comes one count further.
pub(super) struct OneStep<'a> {
    pub(super) engine: &'a mut Engine,
    pub(super) known: &'a mut Known,
    pub(super) is_spent: bool,
    /// Whether a second count was refused.
    pub(super) is_paused: bool,
}

impl OneStep<'_> {
    fn count(
        &mut self,
        of: Of,
        recipe: &Recipe,
        count: impl FnOnce(&mut Engine) -> Result<usize, Error>,
    ) -> Result<usize, Error> {
        let is_known = |(own, known, _): &&(Of, Recipe, usize)| *own == of && known == recipe;
        if let Some((.., count)) = self.known.iter().find(is_known) {
            return Ok(*count);
        }
        if std::mem::replace(&mut self.is_spent, true) {
            self.is_paused = true;
            return Err(Error::Clip { message: "the search goes on".into() });
        }
        let count = count(self.engine)?;
        self.known.push((of, recipe.clone(), count));
        Ok(count)
    }
}

impl Counter for OneStep<'_> {
    fn found(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error> {
        self.count(Of::Found, recipe, |engine| engine.found(recipe, edits))
    }

    fn genga(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error> {
        self.count(Of::Genga, recipe, |engine| engine.genga(recipe, edits))
    }

    fn gaits(&mut self, recipe: &Recipe, edits: &Edits) -> Result<usize, Error> {
        self.count(Of::Gaits, recipe, |engine| engine.gaits(recipe, edits))
    }

    fn engine(&mut self) -> &mut Engine {
        self.engine
    }
}
