//! What a run found on the way to its sheet.

use super::layer::{LayerBreakdown, LayerStages};
use super::looped::LoopedLayer;
use crate::keys::{Actions, BodyTurns, Key, LayerKeys};
use crate::motion::{Clip, Screen, SeenFrom};
use crate::sheet::Sheet;
use crate::signal::{Signals, Turn};
use crate::time::Clock;

/// Every intermediate result of a run.
#[derive(Debug, Clone, Copy)]
pub struct Breakdown<'a> {
    /// The source motion, unchanged.
    pub source: &'a Clip,
    /// The motion that is measured and drawn: the source, exaggerated if the recipe asks for it.
    pub clip: &'a Clip,
    /// Camera in which movement was measured.
    pub seen_from: SeenFrom,
    /// The screen of that camera.
    pub screen: &'a Screen,
    /// Maps the sheet's koma to frames of the clip.
    pub clock: Clock,
    /// The speed of each joint.
    pub speed: &'a Signals,
    /// The smoothed speeds.
    pub filtered: &'a Signals,
    /// Confirmed keys and walls of each joint, by frame.
    pub turns: &'a [Vec<Turn>],
    /// The actions of the take.
    pub actions: &'a Actions,
    /// The sheet before omission.
    pub spaced: &'a Sheet,
    /// The final sheet.
    pub sheet: &'a Sheet,
    pub(super) layers: Shown<'a>,
}

/// The results of each layer: as the chain made them, or of the round of a loop.
#[derive(Debug, Clone, Copy)]
pub(super) enum Shown<'a> {
    Whole(&'a [LayerStages]),
    Round(&'a [LoopedLayer]),
}

/// Results up to the keys of the first layer.
#[derive(Debug, Clone, Copy)]
pub struct FoundKeys<'a> {
    /// Confirmed keys and walls of each joint, by frame.
    pub turns: &'a [Vec<Turn>],
    /// The turns of the layer as a whole.
    pub body: &'a BodyTurns,
    /// Keys and walls of the layer.
    pub keys: &'a LayerKeys,
    /// The keys without corrections, or the frozen ones.
    pub uncorrected: &'a [Key],
}

impl<'a> Breakdown<'a> {
    /// Replaces the final sheet by one with the same drawings and other numbers.
    pub fn with_sheet(self, sheet: &'a Sheet) -> Self {
        Self { sheet, ..self }
    }

    /// Returns the results of each layer of the sheet.
    pub fn layers(&self) -> impl ExactSizeIterator<Item = LayerBreakdown<'a>> + use<'a> {
        let (layers, count) = (self.layers, self.sheet.layers.len());
        (0..count).map(move |at| layers.breakdown(at))
    }

    /// Returns the first layer of the sheet: the whole body, unless the recipe splits it.
    pub fn first_layer(&self) -> LayerBreakdown<'a> {
        self.layers.breakdown(0)
    }
}

impl<'a> Shown<'a> {
    fn breakdown(self, at: usize) -> LayerBreakdown<'a> {
        match self {
            Self::Whole(layers) => layers[at].breakdown(),
            Self::Round(layers) => layers[at].breakdown(),
        }
    }
}
