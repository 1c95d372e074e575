//! **Hand over** (渡す): one file per format, each a function of clip and sheet.
//!
//! [`FORMATS`] lists the formats by name. Each format is a row there and a file in this crate.

// Tests may compare against the standard library.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod action_table;
mod after_effects;
mod beside;
mod column_table;
mod comparison_table;
mod curves;
mod cut;
#[cfg(feature = "images")]
mod cut_folder;
mod cycle_table;
mod drawing_table;
mod figures;
mod films;
mod glb;
mod humanoid;
mod koma;
mod limited_bvh;
mod manifest;
mod marked;
mod mp4;
mod number_table;
mod omission_table;
mod output_formats;
mod pictures;
mod reference_keys;
mod remap;
mod report;
mod run_files;
pub mod run_notes;
mod settings;
pub mod sheet_json;
mod sts;
mod study_table;
mod table;
#[cfg(test)]
pub(crate) mod tests;
mod timeline;
mod turn_table;
mod vmd;
mod vrma;
pub mod xdts;
mod xsheet;
#[cfg(feature = "zip")]
pub mod zip;

pub use action_table::actions_csv;
pub use after_effects::time_remap;
pub use column_table::columns_csv;
pub use comparison_table::comparison_csv;
pub use curves::{CurveErrors, Curves, distances, tangents};
pub use cut::{Cut, Sink};
pub use cycle_table::cycles_csv;
pub use drawing_table::{Drawings, Rows};
pub use figures::{FigureSettings, HAS_PIXELS};
pub use glb::{Glb, LengthUnit, Up};
pub use koma::sheet_csv;
pub use limited_bvh::{keys_bvh, limited, limited_bvh};
pub use manifest::{ClipMark, Manifest};
pub use marked::{pins_from_sheet, pins_from_table};
pub use mp4::Mp4;
pub use number_table::numbers_csv;
pub use omission_table::{OmissionRow, omission_csv};
pub use output_formats::{Attempt, FORMATS, Format};
pub use pictures::{bars, poses};
pub use reference_keys::reference_keys;
pub use remap::{Remap, remap_csv};
pub use report::{GaitReport, LayerReport, LoopReport, Report};
pub use run_files::Run;
pub use settings::{CsvSettings, Settings};
pub use sts::sts;
pub use study_table::study_csv;
pub use table::delimiter;
use table::{CsvText, csv_table, number};
pub use timeline::Others;
pub use turn_table::turns_csv;
pub use vmd::{
    BoneMap, MmdModel, STILL_LIMB, Vmd, VmdBones, VmdCameraMotion, VmdFaceKey, VmdKey, VmdMade,
    VmdMotion, VmdReport,
};
pub use xsheet::{XSheetFiles, xsheet};

/// The message of a JSON error without its line and column, which count within the parsed part only, nor types of Rust.
fn json_words(error: &serde_json::Error) -> String {
    let words = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    genga::error::in_words(words.strip_suffix(&place).unwrap_or(&words))
}

#[cfg(test)]
#[path = "../../../tests/cases/mod.rs"]
mod cases;
#[cfg(test)]
#[path = "../../../tests/real/mod.rs"]
mod real;
#[cfg(test)]
#[path = "../../../src/motion/bvh/sample.rs"]
mod sample;
#[cfg(test)]
#[path = "../../../tests/stage.rs"]
mod stage;
#[cfg(test)]
#[path = "../../genga-read/src/mmd/test_models.rs"]
mod test_models;
