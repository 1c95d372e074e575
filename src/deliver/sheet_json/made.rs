//! What a sheet was made with: the recipe as `--set` takes it, and a person's corrections.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::edits::Edits;
use crate::error::Error;
use crate::recipe::{KNOBS, Recipe};

/// Recipe and corrections of a sheet, for the record: a setting that is no longer known does no harm.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "{\"recipe\", \"edits\"}")]
pub struct MadeWith {
    /// The settings by their names, as words, since JSON has no infinity and a recipe may.
    pub recipe: BTreeMap<String, String>,
    /// The corrections.
    #[serde(default)]
    pub edits: Edits,
}

impl MadeWith {
    /// The record of a run.
    pub fn of(recipe: &Recipe, edits: &Edits) -> Self {
        let word = |name| recipe.get(name).expect("every knob has a value");
        let settings = KNOBS.iter().map(|knob| (knob.name.to_owned(), word(knob.name)));
        Self { recipe: settings.collect(), edits: edits.clone() }
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
}
