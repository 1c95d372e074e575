//! What the omission stages did, and why not more.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What the two stages did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OmissionReport {
    /// Naka-nashi: its `gone` were left out.
    pub naka_nashi: StageReport,
    /// Koma-dori: its `gone` were replaced by the drawing before them.
    pub koma_dori: StageReport,
    /// Koma that naka-nashi gave to other drawings.
    pub lengthened: usize,
}

/// What one stage did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StageReport {
    /// How many were asked for.
    pub asked: usize,
    /// How many were done: drawings, or koma for naka-nashi on ones without genga, where a held
    /// drawing may lose a koma and stay.
    pub done: usize,
    /// Drawings that are no longer on the sheet, in the order they went.
    pub gone: Vec<Gone>,
    /// Why fewer were done than asked for.
    pub shortfall: Option<Shortfall>,
}

/// A drawing that is no longer on the sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gone {
    /// Its index in the layer before the omission.
    pub drawing: usize,
    /// Its place in the source.
    pub place: f64,
    /// The koma it began on before the omission, from 0.
    pub koma: usize,
}

impl OmissionReport {
    /// A sentence for each stage that did less than it was asked for.
    pub fn shortfalls(&self) -> impl Iterator<Item = String> {
        let stages = [("naka-nashi", &self.naka_nashi), ("koma-dori", &self.koma_dori)];
        stages.into_iter().filter_map(|(name, stage)| {
            let why = stage.shortfall?;
            Some(format!("{name} did {} of {}: {why}", stage.done, stage.asked))
        })
    }
}

/// Why a stage did less than it was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shortfall {
    /// No inbetween is left that could go.
    NoneLeft,
    /// Every inbetween that is left is a hold already.
    AllHolds,
    /// Nothing moves between the drawings that could go and the ones before them.
    NoMotion,
    /// The drawings round those that could go cannot be held any longer.
    NoRoom,
    /// No movement that is left is markedly faster than the others of its action.
    NoneFast,
    /// No movement that is left is small.
    NoneSmall,
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoneLeft => "no inbetween is left",
            Self::AllHolds => "every inbetween that is left is a hold already",
            Self::NoMotion => "nothing moves in what is left",
            Self::NoRoom => "the drawings around cannot be held any longer",
            Self::NoneFast => "nothing that is left is markedly fast (omission.fast)",
            Self::NoneSmall => "no movement that is left is small (omission.small)",
        })
    }
}
