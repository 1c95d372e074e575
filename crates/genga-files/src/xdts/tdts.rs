//! A sheet as TDTS (東映アニメーション デジタルタイムシート): ACTION and CELL in one file.

use serde::{Deserialize, Serialize};

use super::file::{Header, Root, TimeSheet};
use super::write::{Column, checked, header, slate, text, time_table};
use super::{CELS, TDTS_CELL, TDTS_SIGNATURE};
use genga::error::Error;
use genga::knob::{Knobs, knob, knobs};
use genga::sheet::Sheet;

/// First version whose time tables are nested in time sheets.
const IN_SHEETS: usize = 7;

/// Settings of a sheet as TDTS.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tdts {
    /// Version of the format, 5 to 11; default 11. From 7 on, time tables are nested in time sheets.
    pub version: usize,
    /// Whether ACTION marks the beginning of an inbetween; default yes. Some readers accept only numbers.
    pub marks: bool,
}

impl Default for Tdts {
    fn default() -> Self {
        Self { version: 11, marks: true }
    }
}

knobs!(tdts::Tdts {
    version: knob(
        "版",
        "Version of the format. Some readers accept only 5. From 7 on, the time tables are nested \
         one level deeper.",
        "形式の版。5にしか対応しないソフトもある。7からは表が一段内側に入る。",
    )
    .at_least(5.0)
    .at_most(11.0),
    marks: knob(
        "中割の印",
        "Whether ACTION marks the start of an inbetween. Some readers accept only numbers.",
        "ACTIONに中割の印を付けるか。数字しか読めないソフトもある。",
    ),
});

impl Tdts {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the version is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Writes the sheet as one file, in which each of the two columns has a track per layer. Readers require a cut
    /// number, so a cut without one gets its whole name instead, and scene 1.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Tdts::validate`]; [`Error::Sheet`] for a sheet without koma, and as
    /// [`Sheet::check`].
    pub fn write(&self, sheet: &Sheet, cut: &str) -> Result<String, Error> {
        self.validate()?;
        checked(sheet)?;
        let action = (CELS, Column::Genga { has_marks: self.marks });
        let cell = (TDTS_CELL, Column::Douga { has_circles: false });
        let time_tables = vec![time_table(sheet, cut, &[action, cell])];
        let slate = slate(sheet, cut);
        let or = |field: &str, other: &str| if field.is_empty() { other } else { field }.to_owned();
        let numbered = header(&slate).unwrap_or_else(|| Header {
            cut: or(&slate.cut, cut),
            scene: or(&slate.scene, "1"),
            episode: String::new(),
        });
        let header = Some(Header { episode: slate.episode, ..numbered });
        let version = self.version as u32;
        let file = if self.version < IN_SHEETS {
            Root { header, subversion: None, time_tables, time_sheets: vec![], version }
        } else {
            let time_sheets = vec![TimeSheet { header, time_tables }];
            Root { header: None, subversion: None, time_tables: vec![], time_sheets, version }
        };
        text(TDTS_SIGNATURE, &file)
    }
}
