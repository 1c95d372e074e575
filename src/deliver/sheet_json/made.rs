//! What a sheet was made with: the recipe as `--set` takes it, and a person's corrections.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::digest;
use crate::edits::Edits;
use crate::error::Error;
use crate::motion::SeenFrom;
use crate::recipe::Recipe;
use crate::sheet::{Sheet, is_default};

/// Recipe and corrections of a sheet, for the record: a setting that is no longer known does no harm.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "{\"recipe\", \"edits\", \"layers\"}")]
pub struct MadeWith {
    /// The settings by their names, as words, since JSON has no infinity and a recipe may.
    pub recipe: BTreeMap<String, String>,
    /// The corrections.
    #[serde(default)]
    pub edits: Edits,
    /// A digest of the layers that they made, with root, feet and exaggeration, by which a sheet that was edited since is known; empty
    /// where nobody took it.
    #[serde(default, skip_serializing_if = "is_default")]
    pub layers: String,
}

impl MadeWith {
    /// The record of a run and the sheet that it made.
    pub fn of(recipe: &Recipe, edits: &Edits, sheet: &Sheet) -> Self {
        let layers = digest::sheet(sheet, &recipe.exaggerate);
        let recipe = recipe.settings().into_iter().collect();
        Self { recipe, edits: edits.clone(), layers }
    }

    /// The recipe again; what is not named has its default.
    ///
    /// # Errors
    /// [`Error::Setting`] where a setting is not known or cannot have its value.
    pub fn recipe(&self) -> Result<Recipe, Error> {
        let mut recipe = Recipe::default();
        self.recipe.iter().try_for_each(|(name, word)| recipe.set(name, word))?;
        Ok(recipe)
    }

    /// From where movement was measured; of a record that does not say so, in the world.
    pub fn seen_from(&self) -> SeenFrom {
        let word = self.recipe.get("seen_from");
        word.and_then(|word| word.parse().ok()).unwrap_or_default()
    }
}
