//! What there is to say of a clip in one row.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::deliver::Report;

/// A row of `summary.csv`; of a clip that could not be done most of it is empty.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(in crate::cli) struct Row {
    /// `done` or `failed`.
    pub(in crate::cli) status: String,
    /// Why it failed.
    pub(in crate::cli) message: String,
    /// Its figures.
    #[serde(flatten)]
    pub(in crate::cli) figures: Option<Figures>,
    /// Codes of the reader's warnings, each once.
    pub(in crate::cli) warnings: Vec<String>,
}

/// The figures of a clip that is done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::cli) struct Figures {
    frames: usize,
    rate: f64,
    joints: usize,
    koma: usize,
    genga: usize,
    drawings: usize,
    held: usize,
    longest_hold: usize,
    actions: usize,
    motion: String,
    recipe: String,
}

/// The status of a clip that is done.
const DONE: &str = "done";

impl Row {
    /// The names of its cells, of which that of the clip comes first.
    pub(in crate::cli) const HEADER: [&str; 15] = [
        "clip",
        "status",
        "message",
        "frames",
        "rate",
        "joints",
        "koma",
        "genga",
        "drawings",
        "held",
        "longest_hold",
        "actions",
        "warnings",
        "motion",
        "recipe",
    ];

    /// A clip that is done; `motion` and `recipe` are digests.
    pub(in crate::cli) fn done(
        report: &Report,
        motion: String,
        recipe: String,
        warnings: Vec<String>,
    ) -> Self {
        let figures = Figures {
            frames: report.frames,
            rate: report.frame_rate,
            joints: report.joints,
            koma: report.koma,
            genga: report.genga,
            drawings: report.drawings,
            held: report.held_koma,
            longest_hold: report.longest_hold,
            actions: report.actions.len().max(1),
            motion,
            recipe,
        };
        Self { status: DONE.into(), message: String::new(), figures: Some(figures), warnings }
    }

    /// One that could not be done.
    pub(in crate::cli) fn failed(message: String, warnings: Vec<String>) -> Self {
        Self { status: "failed".into(), message, figures: None, warnings }
    }

    pub(in crate::cli) fn is_done(&self) -> bool {
        self.status == DONE
    }

    /// The cells behind the name of the clip.
    pub(in crate::cli) fn cells(&self) -> Vec<String> {
        let figures = self.figures.as_ref().map(|figures| {
            let Figures {
                frames,
                rate,
                joints,
                koma,
                genga,
                drawings,
                held,
                longest_hold,
                actions,
                ..
            } = figures;
            let counts =
                [*frames, *joints, *koma, *genga, *drawings, *held, *longest_hold, *actions];
            let mut cells: Vec<String> = counts.iter().map(ToString::to_string).collect();
            cells.insert(1, rate.to_string());
            (cells, figures.motion.clone(), figures.recipe.clone())
        });
        let (numbers, motion, recipe) =
            figures.unwrap_or_else(|| (vec![String::new(); 9], String::new(), String::new()));
        let mut cells = vec![self.status.clone(), self.message.clone()];
        cells.extend(numbers);
        cells.extend([self.warnings.join(" "), motion, recipe]);
        cells
    }
}

/// What a clip that is worked on brought, before it has its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::cli) struct Line {
    /// Its place in the list, from 0.
    pub(in crate::cli) at: usize,
    /// Its name.
    pub(in crate::cli) clip: String,
    /// A digest of its file.
    pub(in crate::cli) file: String,
    /// A digest of all that was asked of it.
    pub(in crate::cli) asked: String,
    pub(in crate::cli) row: Row,
    /// Its key table, as `keys.csv` of a run.
    pub(in crate::cli) keys: String,
    /// Its files, each with its digest.
    pub(in crate::cli) files: BTreeMap<String, String>,
    /// Milliseconds for reading, for the drawings, for writing.
    pub(in crate::cli) ms: [f64; 3],
}
