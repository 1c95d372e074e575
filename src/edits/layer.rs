//! Corrections of one layer alone.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::edits::{Edits, Forbidden, Move, Pin};
use crate::error::Error;
use crate::sheet::is_default;
use crate::time::Frame;

/// What a person wants of one layer (セル) alone, in the words of [`Edits`].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LayerEdits {
    /// Frames that are keys of it.
    #[serde(skip_serializing_if = "is_default")]
    pub pins: Vec<Pin>,
    /// Frames near which it may have no key.
    #[serde(skip_serializing_if = "is_default")]
    pub forbidden: Vec<Forbidden>,
    /// Keys of it that are drawn elsewhere.
    #[serde(skip_serializing_if = "is_default")]
    pub moves: Vec<Move>,
    /// Frames of its keys that stay.
    #[serde(skip_serializing_if = "is_default")]
    pub frozen: Vec<Frame>,
}

/// Whether what is not for one layer is all that is said.
pub(super) fn say_nothing(layers: &BTreeMap<String, LayerEdits>) -> bool {
    layers.values().all(is_default)
}

impl Edits {
    /// What is wanted of the keys of a layer: what is wanted of all, and what of it alone. Holds, splits and
    /// what is spoken are no matter of keys and not among it.
    pub fn of_layer(&self, name: &str) -> Self {
        let mut edits = self.clone();
        (edits.holds, edits.splits, edits.speech) = (vec![], vec![], vec![]);
        edits.layers = BTreeMap::new();
        if let Some(own) = self.layers.get(name) {
            edits.pins.extend(own.pins.iter().cloned());
            edits.forbidden.extend(&own.forbidden);
            edits.moves.extend(own.moves.iter().cloned());
            edits.frozen.extend(&own.frozen);
        }
        edits
    }

    /// The pins of a layer alone, or of all.
    pub fn pins_of(&mut self, layer: Option<&str>) -> &mut Vec<Pin> {
        match layer {
            None => &mut self.pins,
            Some(name) => &mut self.own(name).pins,
        }
    }

    /// What is forbidden to a layer alone, or to all.
    pub fn forbidden_of(&mut self, layer: Option<&str>) -> &mut Vec<Forbidden> {
        match layer {
            None => &mut self.forbidden,
            Some(name) => &mut self.own(name).forbidden,
        }
    }

    /// The moves in a layer alone, or in all.
    pub fn moves_of(&mut self, layer: Option<&str>) -> &mut Vec<Move> {
        match layer {
            None => &mut self.moves,
            Some(name) => &mut self.own(name).moves,
        }
    }

    /// The frozen keys of a layer alone, or of all.
    pub fn frozen_of(&mut self, layer: Option<&str>) -> &mut Vec<Frame> {
        match layer {
            None => &mut self.frozen,
            Some(name) => &mut self.own(name).frozen,
        }
    }

    /// The same without layers of which nothing is said.
    #[must_use]
    pub fn without_empty_layers(mut self) -> Self {
        self.layers.retain(|_, own| !is_default(own));
        self
    }

    fn own(&mut self, layer: &str) -> &mut LayerEdits {
        self.layers.entry(layer.to_owned()).or_default()
    }

    /// Checks that there is a layer for each correction of one.
    ///
    /// # Errors
    /// [`Error::Edits`] naming the layer that is not there, and those that are.
    pub fn check_layers(&self, names: &[&str]) -> Result<(), Error> {
        match self.layers.keys().find(|name| !names.contains(&name.as_str())) {
            None => Ok(()),
            Some(name) => {
                let there = names.join(", ");
                let message =
                    format!("there is no layer {name} to correct; there is {there} (see --layers)");
                Err(Error::Edits { message })
            }
        }
    }
}

/// A correction of one layer, `B/150`, as the layer and the rest; a name behind a `:` or an `@` may have
/// a stroke of its own.
pub fn layer_of(text: &str) -> (Option<&str>, &str) {
    match text.split_once('/') {
        Some((layer, rest)) if !layer.contains([':', '@']) => (Some(layer.trim()), rest),
        _ => (None, text),
    }
}
