//! The document (書類): what a person decides. Everything else is made from it and the clip.

use crate::edits::Edits;
use crate::error::Error;
use crate::recipe::Recipe;

/// The settings and a person's corrections: one recipe file, the one that `--recipe` reads.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Document {
    /// Every setting of the chain.
    pub recipe: Recipe,
    /// What a person wants in spite of what was found.
    pub edits: Edits,
}

impl Document {
    /// Reads a recipe file.
    ///
    /// # Errors
    /// Those of [`Recipe::parse`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        Recipe::parse(text).map(|(recipe, edits)| Self { recipe, edits })
    }

    /// The recipe file.
    pub fn text(&self) -> String {
        self.recipe.write(&self.edits)
    }
}
