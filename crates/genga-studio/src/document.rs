//! The document (書類): a person's decisions. Everything else is computed from it and the clip.

use genga::edits::Edits;
use genga::error::Error;
use genga::recipe::{Footage, Recipe};

/// Settings, corrections and reference footage: one recipe file, the same that `--recipe` reads.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Document {
    /// Every setting of the chain.
    pub recipe: Recipe,
    /// A person's corrections of what was found.
    pub edits: Edits,
    /// Pictures and sound recorded beside the motion.
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

    /// Writes the recipe file.
    pub fn text(&self) -> String {
        self.recipe.write(&self.edits) + &self.footage.write()
    }
}
