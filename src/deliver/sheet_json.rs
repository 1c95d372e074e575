//! `sheet.json` (タイムシート): the sheet itself, which a person can edit by hand and deliver again.
//!
//! One drawing a line and one exposure a line; what is written reads back as the same sheet, to the last
//! digit. The schema is `docs/schema/sheet-1.json`.

mod check;
pub(super) mod digest;
pub mod fit;
mod layer;
mod lines;
mod made;
mod read;
mod text;
mod write;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::exaggerate::Exaggerate;
use crate::sheet::Sheet;

pub use made::MadeWith;
pub use read::read;
pub use write::write;

/// The version of the schema that is written, and the only one that is read.
pub const SCHEMA: &str = "genga-sheet-1";

/// What a `sheet.json` says.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetFile {
    /// The name of the cut.
    pub cut: String,
    /// The version of genga that wrote it.
    pub genga: String,
    /// The clip it was made of.
    pub clip: MadeOf,
    /// How that clip was exaggerated: the drawings are of what [`Exaggerate::apply`] makes of it.
    pub exaggerate: Exaggerate,
    /// What it was made with, where that is known.
    pub made_with: Option<MadeWith>,
    /// The sheet.
    pub sheet: Sheet,
}

/// The clip that a sheet was made of: enough to tell whether another one fits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "what there is to know of the clip")]
pub struct MadeOf {
    /// The name of its file, without folders.
    pub file: String,
    /// Frames a second.
    pub frame_rate: f64,
    /// The number that its first frame has in the file: koma 0 shows it.
    pub first_frame: usize,
    /// Number of frames.
    pub frames: usize,
    /// A digest of the channel values of these frames.
    pub motion: String,
    /// A digest of hierarchy, offsets and channels.
    pub skeleton: String,
    /// The names of the joints in the order of the file.
    pub joints: Vec<String>,
}
