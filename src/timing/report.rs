//! Reports of the omission stages: what they did, and why not more.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The report of both stages.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OmissionReport {
    /// Naka-nashi: its `gone` drawings were left out.
    pub naka_nashi: StageReport,
    /// Koma-dori: its `gone` drawings were replaced by the one before them.
    pub koma_dori: StageReport,
    /// Number of koma that naka-nashi gave to other drawings.
    pub lengthened: usize,
}

/// The report of one stage.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StageReport {
    /// The requested number.
    pub asked: usize,
    /// The number done: of drawings, or of koma for naka-nashi on ones without genga, where a held drawing may lose a
    /// koma and stay.
    pub done: usize,
    /// The removed drawings, in the order they went.
    pub gone: Vec<Gone>,
    /// Why fewer were done than requested.
    pub shortfall: Option<Shortfall>,
}

/// A drawing removed from the sheet.
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
    /// Returns a sentence for each stage that did less than requested.
    pub fn shortfalls(&self) -> impl Iterator<Item = String> {
        let stages = [
            (
                "naka-nashi",
                &self.naka_nashi,
                " (omission.keep_length=false shortens the sheet instead)",
            ),
            ("koma-dori", &self.koma_dori, " (omission.max_hold)"),
        ];
        stages.into_iter().filter_map(|(name, stage, room)| {
            let why = stage.shortfall?;
            let room = if why == Shortfall::NoRoom { room } else { "" };
            Some(format!("{name} did {} of {}: {why}{room}", stage.done, stage.asked))
        })
    }
}

/// Why a stage did less than requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shortfall {
    /// No inbetween is left that could go.
    NoneLeft,
    /// The inbetweens that are left always stay: those of gaits, of koma that show the source, and at the ends.
    AllStay,
    /// Every remaining inbetween is a hold already.
    AllHolds,
    /// The drawings that could go do not differ from the ones before them.
    NoMotion,
    /// The drawings around those that could go cannot be held any longer.
    NoRoom,
    /// No remaining movement is markedly faster than the others of its action.
    NoneFast,
    /// No remaining movement is small.
    NoneSmall,
}

impl Shortfall {
    /// Returns the reason for two parts of a layer, of which the other comes first: that one, unless it has no inbetween
    /// left, which then does not hold for both.
    pub(super) fn after(self, first: Option<Self>) -> Self {
        first.filter(|first| *first != Self::NoneLeft).unwrap_or(self)
    }
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoneLeft => "no inbetween is left",
            Self::AllStay => "the inbetweens that are left always stay: in a gait, where the source shows, at the ends",
            Self::AllHolds => "every inbetween that is left is a hold already",
            Self::NoMotion => "nothing moves in what is left",
            Self::NoRoom => "the drawings around cannot be held any longer",
            Self::NoneFast => "nothing that is left is markedly fast (omission.fast)",
            Self::NoneSmall => "no movement that is left is small (omission.small)",
        })
    }
}
