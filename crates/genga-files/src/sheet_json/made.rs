//! The record of how a sheet was made: the recipe as `--set` takes it, and a person's corrections.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::digest;
use genga::edits::Edits;
use genga::error::Error;
use genga::motion::SeenFrom;
use genga::recipe::Recipe;
use genga::sheet::{Sheet, is_default};

/// Recipe and corrections of a sheet, as a record: settings that no longer exist do no harm.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "{\"recipe\", \"edits\", \"layers\"}")]
pub struct MadeWith {
    /// The settings by name, as strings, because a recipe may hold infinity and JSON cannot.
    pub recipe: BTreeMap<String, String>,
    /// The corrections.
    #[serde(default)]
    pub edits: Edits,
    /// Digest of the layers they produced, with root, feet and exaggeration. It reveals a sheet that was edited
    /// since; empty if no digest was taken.
    #[serde(default, skip_serializing_if = "is_default")]
    pub layers: String,
}

impl MadeWith {
    /// Records a run and the sheet it made.
    pub fn new(recipe: &Recipe, edits: &Edits, sheet: &Sheet) -> Self {
        let layers = digest::sheet(sheet, &recipe.exaggerate);
        let recipe = recipe.settings().into_iter().collect();
        Self { recipe, edits: edits.clone(), layers }
    }

    /// Restores the recipe. Settings that are not named have their defaults.
    ///
    /// # Errors
    /// [`Error::Setting`] if a setting is unknown or its value is invalid.
    pub fn recipe(&self) -> Result<Recipe, Error> {
        let mut recipe = Recipe::default();
        self.recipe.iter().try_for_each(|(name, word)| recipe.set(name, word))?;
        Ok(recipe)
    }

    /// Camera in which movement was measured; world space if the record does not name one.
    pub fn seen_from(&self) -> SeenFrom {
        let word = self.recipe.get("seen_from");
        word.and_then(|word| word.parse().ok()).unwrap_or_default()
    }
}
