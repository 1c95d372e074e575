//! **Hand over** (渡す): one file a format, each a function of clip and sheet.
//!
//! [`FORMATS`] lists those that can be asked for by name. A format is a row there and a file here.

mod actions;
mod after_effects;
mod columns;
mod comparison;
mod cut;
#[cfg(feature = "pictures")]
mod cut_folder;
mod drawings;
mod figures;
mod format;
mod glb;
mod koma;
mod limited_bvh;
mod manifest;
mod marked;
mod mp4;
mod pictures;
mod reference_keys;
mod remap;
mod report;
mod run;
mod settings;
pub mod sheet_json;
mod sts;
mod study_table;
mod table;
#[cfg(test)]
pub(crate) mod tests;
mod turns;
mod vmd;
pub mod xdts;
mod xsheet;
#[cfg(feature = "zip")]
pub mod zip;

pub use actions::actions_csv;
pub use after_effects::time_remap;
pub use columns::columns_csv;
pub use comparison::comparison_csv;
pub use cut::{Cut, Sink};
pub use drawings::{Drawings, Rows};
pub use figures::FigureSettings;
pub use format::{FORMATS, Format};
pub use glb::{Glb, LengthUnit, Up};
pub use koma::sheet_csv;
pub use limited_bvh::{keys_bvh, limited, limited_bvh};
pub use manifest::{ClipMark, Manifest};
pub use marked::{pins_from_sheet, pins_from_table};
pub use mp4::Mp4;
pub use pictures::{bars, poses};
pub use reference_keys::reference_keys;
pub use remap::{Remap, remap_csv};
pub use report::{GaitReport, LayerReport, Report};
pub use run::Run;
pub use settings::{CsvSettings, Settings};
pub use sts::sts;
pub use study_table::study_csv;
use table::{CsvText, csv_table, number};
pub use turns::turns_csv;
use vmd::vrma;
pub use vmd::{
    BoneMap, MmdModel, STILL_LIMB, Vmd, VmdBones, VmdKey, VmdMade, VmdMotion, VmdReport,
};
pub use xsheet::{XSheetFiles, xsheet};

/// What the reader of JSON says, without the place: that counts within the part which was read.
fn json_words(error: &serde_json::Error) -> String {
    let words = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    words.strip_suffix(&place).unwrap_or(&words).to_owned()
}
