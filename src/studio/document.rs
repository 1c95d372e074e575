//! The document (書類): what a person decides. Everything else is made from it and the clip.

use crate::edits::Edits;
use crate::error::Error;
use crate::recipe::{Footage, Recipe};

/// The settings, a person's corrections, and what is shown beside: one recipe file, the one that `--recipe` reads.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Document {
    /// Every setting of the chain.
    pub recipe: Recipe,
    /// What a person wants in spite of what was found.
    pub edits: Edits,
    /// Pictures and sound that were recorded beside the motion.
    pub footage: Footage,
}

impl Document {
    /// Reads a recipe file.
    ///
    /// # Errors
    /// Those of [`Recipe::parse`] and [`Footage::parse`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        let (recipe, edits) = Recipe::parse(text)?;
        Ok(Self { recipe, edits, footage: Footage::parse(text)? })
    }

    /// The recipe file.
    pub fn text(&self) -> String {
        self.recipe.write(&self.edits) + &self.footage.write()
    }
}
