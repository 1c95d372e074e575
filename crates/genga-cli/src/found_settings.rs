//! The settings that a target found (目標からの設定). A folder keeps them apart from those that a person gave: another
//! target begins with the latter, so that it finds what it would find in a new folder.

use std::collections::BTreeMap;

use genga::error::Error;
use genga::recipe::{KNOBS, Recipe};

/// The words of each setting before and after the search, by its name.
pub(super) type Found = BTreeMap<String, [String; 2]>;

/// Returns the settings that differ between two recipes, in the order of a recipe.
pub(super) fn between(
    before: &Recipe,
    after: &Recipe,
) -> Result<Vec<(String, [String; 2])>, Error> {
    let words = KNOBS
        .iter()
        .map(|knob| Ok((knob.name.to_owned(), [before.get(knob.name)?, after.get(knob.name)?])));
    words.filter(|words| !matches!(words, Ok((_, [was, is])) if was == is)).collect()
}

/// Keeps those that a recipe still has as they were found.
pub(super) fn still_in(recipe: &Recipe, mut found: Found) -> Found {
    found.retain(|name, [_, is]| recipe.get(name).is_ok_and(|now| now == *is));
    found
}

/// Returns a recipe with the words from before the search, where nobody has changed them since.
pub(super) fn taken_back(recipe: &Recipe, found: &Found) -> Result<Recipe, Error> {
    let mut recipe = recipe.clone();
    for (name, [was, _]) in &still_in(&recipe, found.clone()) {
        recipe.set(name, was)?;
    }
    Ok(recipe)
}
