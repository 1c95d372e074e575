//! Settings of layers and passages in a recipe file: `[[layers]]` and `[layer.NAME]`, `[[passages]]`, `outside`.

use std::collections::BTreeSet;
use std::ops::Range;

use serde::Deserialize;
use serde::de::IntoDeserializer;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

use super::{File, line_and_column, not_read, written};
use crate::error::Error;
use crate::keys::Layers;
use crate::recipe::Recipe;
use crate::recipe::scopes::{Frames, Overrides, Passage, Scope, Scopes};
use crate::sheet::is_default;

/// The comment above `outside` in a written recipe.
const ABOUT_OUTSIDE: &str = "\
# 区間の外 — Outside of the passages the take stays as it is, on ones.
# timed | source
";

/// The comment above the settings of layers.
const ABOUT_LAYERS: &str = "\n# セルごとの設定 — Settings of single layers, over those above.\n";

/// The comment above the passages.
const ABOUT_PASSAGES: &str = "
# 区間ごとの設定 — Passages of source frames (the last not included) with settings of their own, the later over the
# earlier: spacing, omission and keys.min_price. With layer = \"B\" a passage holds in that layer alone.
";

impl Recipe {
    /// Takes the layers of a file of their own: `[[layers]]` with `name`, `joints` and settings, as in a recipe.
    ///
    /// # Errors
    /// [`Error::Setting`] if the file is no such list, and those of [`Recipe::parse`].
    pub fn take_layers(&mut self, text: &str) -> Result<(), Error> {
        let layers = Layers::parse(text)?;
        let mut table = DeTable::parse(text).map_err(|error| not_read(text, error))?.into_inner();
        let recipe = Self { layers, ..self.clone() };
        let mut file = File { text, recipe, named: BTreeSet::new() };
        file.take_scopes(&mut table)?;
        *self = file.recipe;
        Ok(())
    }
}

impl File<'_> {
    /// Takes the settings of layers and passages out of a file's table.
    pub(super) fn take_scopes(&mut self, table: &mut DeTable<'_>) -> Result<(), Error> {
        if let Some(DeValue::Array(layers)) = table.get_mut("layers").map(Spanned::get_mut) {
            for layer in layers.iter_mut() {
                if let DeValue::Table(layer) = layer.get_mut() {
                    self.take_of_layer(layer)?;
                }
            }
        }
        if let Some((key, value)) = table.remove_entry("layer") {
            for (name, own) in self.table(key.span(), value.get_ref())? {
                let scope = Scope { layer: Some(name.get_ref().to_string()), frames: None };
                let own = self.table(name.span(), own.get_ref())?;
                self.take_own(&scope, "", own)?;
            }
        }
        if let Some((key, value)) = table.remove_entry("outside") {
            let word = String::deserialize(value.into_deserializer());
            let word = word.map_err(|error| not_read(self.text, error))?;
            self.recipe.set("outside", &word).map_err(|error| self.wrong(key.span(), error))?;
        }
        match table.remove_entry("passages") {
            Some((key, value)) => self.take_passages(key.span(), value.get_ref()),
            None => Ok(()),
        }
    }

    /// Takes the settings out of a layer that a person names. What has no name is left, and refused with the layer.
    fn take_of_layer(&mut self, layer: &mut DeTable<'_>) -> Result<(), Error> {
        let Some(name) = layer.get("name").and_then(|name| name.get_ref().as_str()) else {
            return Ok(());
        };
        let scope = Scope { layer: Some(name.to_owned()), frames: None };
        let sections = layer.iter().filter(|(_, own)| own.get_ref().is_table());
        let sections: Vec<String> = sections.map(|(name, _)| name.get_ref().to_string()).collect();
        for section in sections {
            if let Some(DeValue::Table(own)) = layer.remove(&*section).map(Spanned::into_inner) {
                self.take_own(&scope, &section, &own)?;
            }
        }
        Ok(())
    }

    fn take_passages(&mut self, key: Range<usize>, value: &DeValue<'_>) -> Result<(), Error> {
        let wrong = "expected a list of passages, [[passages]] with frames = [120, 240]";
        let Some(passages) = value.as_array() else {
            return Err(self.wrong(key, Error::setting("passages", wrong)));
        };
        for passage in passages.iter() {
            let table = self.table(passage.span(), passage.get_ref())?;
            let Some(frames) = table.get("frames") else {
                return Err(self.wrong(passage.span(), Error::setting("passages", wrong)));
            };
            let frames = Frames::deserialize(frames.clone().into_deserializer());
            let layer = table
                .get("layer")
                .map(|name| String::deserialize(name.clone().into_deserializer()));
            let not_read = |error| not_read(self.text, error);
            let (frames, layer) = (frames.map_err(not_read)?, layer.transpose().map_err(not_read)?);
            let scope = Scope { layer, frames: Some(frames) };
            self.recipe.add(&scope).map_err(|error| self.wrong(passage.span(), error))?;
            let mut own = table.clone();
            for place in ["frames", "layer"] {
                own.remove(place);
            }
            self.take_own(&scope, "", &own)?;
        }
        Ok(())
    }

    /// Sets all settings of a scope in a table whose names start with `section`.
    fn take_own(&mut self, scope: &Scope, section: &str, table: &DeTable<'_>) -> Result<(), Error> {
        for (key, value) in table {
            let own = key.get_ref().as_ref();
            let name = if section.is_empty() { own.to_owned() } else { format!("{section}.{own}") };
            match value.get_ref() {
                DeValue::Table(table) => self.take_own(scope, &name, table)?,
                _ => self.set(format!("{scope}{name}"), key.span(), value)?,
            }
        }
        Ok(())
    }

    fn table<'t, 'v>(
        &self,
        place: Range<usize>,
        value: &'t DeValue<'v>,
    ) -> Result<&'t DeTable<'v>, Error> {
        value.as_table().ok_or_else(|| {
            let place = Some(line_and_column(self.text, place));
            let message =
                "expected a table of settings, as in [layer.B] with spacing.on = 3".into();
            Error::Recipe { place, message, source: None }
        })
    }
}

impl Scopes {
    /// Writes what is shown outside of passages, for the top of a file.
    pub(super) fn written_outside(&self) -> String {
        match is_default(&self.outside) {
            true => String::new(),
            false => format!("\n{ABOUT_OUTSIDE}outside = \"{}\"\n", self.outside),
        }
    }

    /// Writes the settings of layers and passages, for the end of a file.
    pub(super) fn written(&self) -> String {
        let mut text = String::new();
        let layers = self
            .layers
            .iter()
            .map(|(name, own)| format!("[layer.{}]\n{}", Value::from(name.as_str()), lines(own)));
        let passages = self
            .passages
            .iter()
            .map(|own| format!("[[passages]]\n{}\n{}", head(own, "\n"), lines(&own.settings)));
        for (about, parts) in
            [(ABOUT_LAYERS, layers.collect::<Vec<_>>()), (ABOUT_PASSAGES, passages.collect())]
        {
            if !parts.is_empty() {
                text = text + about + &parts.join("\n");
            }
        }
        text
    }
}

impl Passage {
    /// Writes it as an inline table.
    pub(in crate::recipe) fn word(&self) -> String {
        let settings =
            self.settings.iter().map(|(name, word)| format!(", {name} = {}", written(word)));
        format!("{{ {}{} }}", head(self, ", "), settings.collect::<String>())
    }
}

/// Writes where a passage holds.
fn head(passage: &Passage, between: &str) -> String {
    let frames = passage.frames.word();
    match &passage.layer {
        None => format!("frames = {frames}"),
        Some(name) => format!("frames = {frames}{between}layer = {}", Value::from(name.as_str())),
    }
}

fn lines(settings: &Overrides) -> String {
    settings.iter().map(|(name, word)| format!("{name} = {}\n", written(word))).collect()
}
