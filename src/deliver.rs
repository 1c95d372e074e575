//! **Hand over** (渡す): one file a format, each a function of clip and sheet.
//!
//! [`FORMATS`] lists those that can be asked for by name. A format is a row there and a file here.

mod actions;
mod after_effects;
mod columns;
mod comparison;
mod cut;
mod drawings;
mod figures;
mod format;
mod glb;
mod koma;
mod limited_bvh;
mod manifest;
mod marked;
mod pictures;
mod reference_keys;
mod report;
mod settings;
pub mod sheet_json;
mod sts;
mod study_table;
#[cfg(test)]
pub(crate) mod tests;
mod turns;
mod vmd;
pub mod xdts;
mod xsheet;

pub use actions::actions_csv;
pub use after_effects::time_remap;
pub use columns::columns_csv;
pub use comparison::comparison_csv;
pub use cut::{Cut, Sink};
pub use drawings::{Drawings, Rows};
pub use figures::FigureSettings;
pub use format::{FORMATS, Format};
pub use glb::{Glb, LengthUnit, Up};
pub use koma::{remap_csv, sheet_csv};
pub use limited_bvh::{keys_bvh, limited_bvh};
pub use manifest::{ClipMark, Manifest};
pub use marked::{pins_from_sheet, pins_from_table};
pub use pictures::{bars, poses};
pub use reference_keys::reference_keys;
pub use report::{LayerReport, Report};
pub use settings::{CsvSettings, Settings};
pub use sts::sts;
pub use study_table::study_csv;
pub use turns::turns_csv;
pub use vmd::{BoneMap, Vmd, VmdKey, VmdMade, VmdMotion, VmdReport};
pub use xsheet::{XSheetFiles, xsheet};

use crate::error::Error;

/// A CSV table (RFC 4180, LF, UTF-8) from a header and rows.
fn csv_table<Row>(header: &[&str], rows: impl IntoIterator<Item = Row>) -> Result<String, Error>
where
    Row: IntoIterator<Item = String>,
{
    let mut table = CsvText::new(csv::QuoteStyle::Necessary);
    table.row(header)?;
    for row in rows {
        table.row(row)?;
    }
    table.text()
}

/// A CSV table that grows row by row.
struct CsvText(csv::Writer<Vec<u8>>);

impl CsvText {
    fn new(quotes: csv::QuoteStyle) -> Self {
        Self(csv::WriterBuilder::new().quote_style(quotes).from_writer(Vec::new()))
    }

    fn row(&mut self, cells: impl IntoIterator<Item: AsRef<[u8]>>) -> Result<(), Error> {
        self.0.write_record(cells).map_err(Self::failed)
    }

    fn text(self) -> Result<String, Error> {
        let bytes = self.0.into_inner().map_err(|error| Self::failed(error.into_error().into()))?;
        Ok(String::from_utf8(bytes).expect("only text was written"))
    }

    fn failed(error: csv::Error) -> Error {
        Error::Encoding { what: "a table", source: error.into() }
    }
}

/// What the reader of JSON says, without the place: that counts within the part which was read.
fn json_words(error: &serde_json::Error) -> String {
    let words = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    words.strip_suffix(&place).unwrap_or(&words).to_owned()
}

/// A number as tables have it: the shortest that reads back as the same value, −0 as 0.
fn number(value: f64) -> String {
    (value + 0.0).to_string()
}
