//! Corrections of a single layer.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::edits::{Edits, Forbidden, Move, Pin};
use crate::error::Error;
use crate::sheet::is_default;
use crate::time::Frame;

/// Corrections of a single layer (セル), as in [`Edits`].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LayerEdits {
    /// Frames that are keys of the layer.
    #[serde(skip_serializing_if = "is_default")]
    pub pins: Vec<Pin>,
    /// Frames near which the layer may have no key.
    #[serde(skip_serializing_if = "is_default")]
    pub forbidden: Vec<Forbidden>,
    /// Keys of the layer that are drawn elsewhere.
    #[serde(skip_serializing_if = "is_default")]
    pub moves: Vec<Move>,
    /// Frames of the layer's frozen keys.
    #[serde(skip_serializing_if = "is_default")]
    pub frozen: Vec<Frame>,
}

/// Whether no layer has corrections of its own.
pub(super) fn say_nothing(layers: &BTreeMap<String, LayerEdits>) -> bool {
    layers.values().all(is_default)
}

impl Edits {
    /// Returns the corrections of a layer's keys: those of all layers and its own. Holds, splits and speech do not
    /// concern keys and are left out.
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

    /// Returns the pins of one layer, or of all.
    pub fn pins_of(&mut self, layer: Option<&str>) -> &mut Vec<Pin> {
        match layer {
            None => &mut self.pins,
            Some(name) => &mut self.own(name).pins,
        }
    }

    /// Returns the forbidden frames of one layer, or of all.
    pub fn forbidden_of(&mut self, layer: Option<&str>) -> &mut Vec<Forbidden> {
        match layer {
            None => &mut self.forbidden,
            Some(name) => &mut self.own(name).forbidden,
        }
    }

    /// Returns the moves in one layer, or in all.
    pub fn moves_of(&mut self, layer: Option<&str>) -> &mut Vec<Move> {
        match layer {
            None => &mut self.moves,
            Some(name) => &mut self.own(name).moves,
        }
    }

    /// Returns the frozen keys of one layer, or of all.
    pub fn frozen_of(&mut self, layer: Option<&str>) -> &mut Vec<Frame> {
        match layer {
            None => &mut self.frozen,
            Some(name) => &mut self.own(name).frozen,
        }
    }

    /// Removes layers without corrections.
    #[must_use]
    pub fn without_empty_layers(mut self) -> Self {
        self.layers.retain(|_, own| !is_default(own));
        self
    }

    fn own(&mut self, layer: &str) -> &mut LayerEdits {
        self.layers.entry(layer.to_owned()).or_default()
    }

    /// Checks that every corrected layer exists.
    ///
    /// # Errors
    /// [`Error::Edits`] naming the missing layer and the existing ones.
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

/// Splits a correction of one layer, `B/150`, into layer and rest. A slash after a `:` or an `@` belongs to a name.
pub fn layer_of(text: &str) -> (Option<&str>, &str) {
    match text.split_once('/') {
        Some((layer, rest)) if !layer.contains([':', '@']) => (Some(layer.trim()), rest),
        _ => (None, text),
    }
}
