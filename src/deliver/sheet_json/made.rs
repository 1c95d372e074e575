//! What a sheet was made with: the recipe as `--set` takes it, and a person's corrections.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::edits::Edits;
use crate::error::Error;
use crate::recipe::{KNOBS, Recipe};

/// Recipe and corrections as the file has them.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MadeWith {
    recipe: Map<String, Value>,
    #[serde(default)]
    edits: Edits,
}

impl MadeWith {
    pub(super) fn of(recipe: &Recipe, edits: &Edits) -> Self {
        // As words, since JSON has no infinity and a recipe may.
        let text = |name| recipe.get(name).expect("every knob has a value");
        let knobs = KNOBS.iter().map(|knob| (knob.name.to_owned(), text(knob.name).into()));
        Self { recipe: knobs.collect(), edits: edits.clone() }
    }

    pub(super) fn read(self) -> Result<(Recipe, Edits), Error> {
        let mut recipe = Recipe::default();
        for (name, value) in &self.recipe {
            match value {
                Value::String(text) => recipe.set(name, text)?,
                other => recipe.set(name, &other.to_string())?,
            }
        }
        Ok((recipe, self.edits))
    }
}
