//! The summary of a clip in one row.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::super::format_args::shortened;
use super::place::is_picture;
use genga_files::{ClipMark, Report};

/// A row of `summary.csv`. For a failed clip most of it is empty.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Row {
    /// `done` or `failed`.
    pub(crate) status: String,
    /// Why it failed, or which formats of a clip that is done are not made, and why.
    pub(crate) message: String,
    /// Figures of a clip that is done.
    #[serde(flatten)]
    pub(crate) figures: Option<Figures>,
    /// Codes of the reader's warnings, each once.
    pub(crate) warnings: Vec<String>,
    /// Targets that were missed, corrections without effect, and settings that may not be meant.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) notes: Vec<String>,
    /// Names of files that a person changed, and which stay.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) kept: Vec<String>,
}

/// Figures of a clip that is done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Figures {
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

/// Warning of a clip whose folder has painted pictures, which stay.
const PAINTED: &str = "W_PAINTED";

/// Warning of a clip whose folder has other files that a person changed, which stay.
const EDITED: &str = "W_EDITED";

/// Warning of a clip with notes.
const NOTED: &str = "W_NOTED";

/// Begins the list of files that stay.
pub(crate) const KEPT: &str = "kept, as changed by a person: ";

/// Status of a clip that is done.
const DONE: &str = "done";

impl Row {
    /// Names of the cells; the clip's name comes first.
    pub(crate) const HEADER: [&str; 15] = [
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

    /// Builds the row of a finished clip; `motion` and `recipe` are digests.
    pub(crate) fn done(
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
        Self { status: DONE.into(), figures: Some(figures), warnings, ..Self::default() }
    }

    /// Builds the row of a failed clip.
    pub(crate) fn failed(message: String, warnings: Vec<String>) -> Self {
        Self { status: "failed".into(), message, warnings, ..Self::default() }
    }

    pub(crate) fn is_done(&self) -> bool {
        self.status == DONE
    }

    /// Whether it is done with all its formats. What one lacks, such as ffmpeg, may be there the next time.
    pub(crate) fn is_whole(&self) -> bool {
        self.is_done() && !self.lacks_formats()
    }

    /// Whether it is done but for formats that cannot be made of it.
    pub(crate) fn lacks_formats(&self) -> bool {
        self.is_done() && !self.message.is_empty()
    }

    /// The files that stay, shortened; `None` if there are none.
    pub(crate) fn kept(&self) -> Option<String> {
        (!self.kept.is_empty()).then(|| shortened(self.kept.clone()).join(" "))
    }

    /// The message, the notes, and which files stay.
    pub(crate) fn said(&self) -> String {
        let message = Some(self.message.clone()).filter(|message| !message.is_empty());
        let kept = self.kept().map(|files| format!("{KEPT}{files}"));
        let notes = self.notes.iter().cloned();
        message.into_iter().chain(notes).chain(kept).collect::<Vec<_>>().join("; ")
    }

    /// The codes of all warnings.
    fn codes(&self) -> String {
        let code = |file: &String| if is_picture(file) { PAINTED } else { EDITED };
        let kept: BTreeSet<&str> = self.kept.iter().map(code).collect();
        let noted = (!self.notes.is_empty()).then_some(NOTED);
        let warnings = self.warnings.iter().map(String::as_str);
        warnings.chain(noted).chain(kept).collect::<Vec<_>>().join(" ")
    }

    /// The cells after the clip's name.
    pub(crate) fn cells(&self) -> Vec<String> {
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
        let mut cells = vec![self.status.clone(), self.said()];
        cells.extend(numbers);
        cells.extend([self.codes(), motion, recipe]);
        cells
    }
}

/// The results of a clip, as a line of the journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Line {
    /// Index in the list, from 0.
    pub(crate) at: usize,
    /// Name of the clip.
    pub(crate) clip: String,
    /// Digest of the clip's file.
    pub(crate) file: String,
    /// Digest of the clip's options.
    pub(crate) asked: String,
    pub(crate) row: Row,
    /// Key table, as in `keys.csv` of a run.
    pub(crate) keys: String,
    /// Files and their digests.
    pub(crate) files: BTreeMap<String, String>,
    /// The motion that the files are made of, if there are any.
    #[serde(default)]
    pub(crate) made_of: Option<ClipMark>,
    /// Whether the drawings are not 1, 2, 3 …, to keep the numbers of an earlier sheet.
    #[serde(default)]
    pub(crate) has_old_numbers: bool,
    /// Whether a drawing that the batch before made too has its number.
    #[serde(skip)]
    pub(crate) keeps_numbers: bool,
    /// Milliseconds spent reading, drawing and writing.
    pub(crate) ms: [f64; 3],
}
