//! `sheet.json` (タイムシート): the sheet itself, which a person can edit by hand and deliver again.
//!
//! Each drawing and each exposure has a line of its own. A written sheet reads back identically, to the last
//! digit. The schema is `docs/schema/sheet-2.json`.

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

use genga::exaggerate::Exaggerate;
use genga::sheet::Sheet;

pub use made::MadeWith;
pub use read::read;
pub use write::write;

/// The schema version that is written: drawings and koma count from 1, frames from 0.
pub const SCHEMA: &str = "genga-sheet-2";

/// The version before, which is still read: drawings and koma count from 0.
pub const SCHEMA_FROM_0: &str = "genga-sheet-1";

/// The contents of a `sheet.json`.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetFile {
    /// The name of the cut.
    pub cut: String,
    /// The version of genga that wrote it.
    pub genga: String,
    /// The clip it was made of.
    pub clip: MadeOf,
    /// The exaggeration of that clip: the drawings are poses of what [`Exaggerate::apply`] makes of it.
    pub exaggerate: Exaggerate,
    /// The recipe and corrections of the sheet, if known.
    pub made_with: Option<MadeWith>,
    /// The sheet.
    pub sheet: Sheet,
}

/// The clip of a sheet, in enough detail to tell whether another clip fits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "what there is to know of the clip")]
pub struct MadeOf {
    /// The name of its file, without folders.
    pub file: String,
    /// Frames per second.
    pub frame_rate: f64,
    /// Number of its first frame in the file, shown at koma 0.
    pub first_frame: usize,
    /// Number of frames.
    pub frames: usize,
    /// Digest of the channel values of these frames.
    pub motion: String,
    /// Digest of hierarchy, offsets and channels.
    pub skeleton: String,
    /// Names of the joints, in the order of the file.
    pub joints: Vec<String>,
}
