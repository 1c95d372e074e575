//! The document (書類): a person's decisions. Everything else is computed from it and the clip.

use genga::edits::Edits;
use genga::error::Error;
use genga::recipe::{Footage, Recipe, Scopes};

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

    /// Takes over the settings of another take. Passages are frames of their own take, and stay.
    pub(super) fn take_settings(&mut self, other: &Recipe) {
        let Scopes { passages, outside, .. } = std::mem::take(&mut self.recipe.scopes);
        let scopes = Scopes { passages, outside, ..other.scopes.clone() };
        self.recipe = Recipe { scopes, ..other.clone() };
    }

    /// Writes the recipe file.
    pub fn text(&self) -> String {
        self.recipe.write(&self.edits) + &self.footage.write()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(text: &str) -> Document {
        Document::parse(text).unwrap()
    }

    #[test]
    fn settings_of_layers_and_passages_are_saved_and_only_passages_stay_with_their_take() {
        let own = document("layers = \"limbs\"\n[[passages]]\nframes = [20, 50]\nspacing.on = 1\n");
        let other = document(
            "outside = \"source\"\nlayers = \"limbs\"\n[layer.B]\nspacing.on = 3\n[[passages]]\nframes = [5, 9]\n",
        );
        for saved in [&own, &other] {
            assert_eq!(document(&saved.text()), *saved);
        }
        let mut taken = own.clone();
        taken.take_settings(&other.recipe);
        let expected = "layers = \"limbs\"\n[layer.B]\nspacing.on = 3\n[[passages]]\nframes = [20, 50]\nspacing.on = 1\n";
        assert_eq!(taken, document(expected));
    }
}
