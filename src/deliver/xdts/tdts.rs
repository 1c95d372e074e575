//! A sheet as TDTS (東映アニメーション デジタルタイムシート): ACTION and CELL in one file.

use serde::{Deserialize, Serialize};

use super::file::{Header, Root, TimeSheet};
use super::write::{Column, checked, header, text, time_table};
use super::{CELS, TDTS_CELL, TDTS_SIGNATURE};
use crate::error::Error;
use crate::knob::{Knobs, knob, knobs};
use crate::sheet::Sheet;

/// From this version on, time tables stand in time sheets.
const IN_SHEETS: usize = 7;

/// A sheet as TDTS.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tdts {
    /// The version of the format, 5 to 11; default 11. Time tables stand in time sheets from 7 on.
    pub version: usize,
    /// Whether ACTION has a mark where an inbetween begins; default yes. Some readers refuse what is no number.
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
        "The version of the format. Some readers take 5 alone; from 7 on its tables stand one level down.",
        "形式の版。5しか読めないソフトもある。7からは表が一段内側に入る。",
    )
    .at_least(5.0)
    .at_most(11.0),
    marks: knob(
        "中割の印",
        "Whether ACTION has a mark where an inbetween begins. Some readers refuse what is no number.",
        "ACTIONに中割の印を付けるか。数字しか読めないソフトもある。",
    ),
});

impl Tdts {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a version out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// The sheet as one file: a track a layer in each of the two columns. A cut without a number is called by its
    /// whole name, since readers ask for one.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Tdts::validate`], [`Error::Sheet`] for a sheet without a koma, and as
    /// [`Sheet::check`].
    pub fn write(&self, sheet: &Sheet, cut: &str) -> Result<String, Error> {
        self.validate()?;
        checked(sheet)?;
        let action = (CELS, Column::Genga { has_marks: self.marks });
        let cell = (TDTS_CELL, Column::Douga { has_circles: false });
        let time_tables = vec![time_table(sheet, cut, &[action, cell])];
        let unnumbered = || Header { cut: cut.into(), scene: "1".into() };
        let header = Some(header(cut).unwrap_or_else(unnumbered));
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
