//! What can be asked of the formats: a small settings struct each, set by name.

use serde::{Deserialize, Serialize};

use crate::deliver::xdts::{Tdts, Xdts};
use crate::deliver::{FigureSettings, Glb, Mp4, Remap, Vmd};
use crate::error::Error;
use crate::knob::{Knob, Knobs, knob, knobs};
use crate::plot::{ContactSheet, FlipBook, NumberedImages, OnionSkin, Preview, Strip, XSheet};

/// The settings of every format, by its name. A new format's are a field here.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// The tables.
    pub csv: CsvSettings,
    /// The timing alone.
    pub remap: Remap,
    /// The timesheets for programs.
    pub xdts: Xdts,
    /// The same timesheets as one file.
    pub tdts: Tdts,
    /// The timesheet on paper.
    pub xsheet: XSheet,
    /// The motion for MikuMikuDance.
    pub vmd: Vmd,
    /// All pictures of figures.
    pub figures: FigureSettings,
    /// Source above, result below.
    pub strip: Strip,
    /// The genga one by one.
    pub contact: ContactSheet,
    /// Neighbouring drawings through each other.
    pub onion: OnionSkin,
    /// The page that plays the sheet.
    pub flipbook: FlipBook,
    /// Source beside result, moving.
    pub preview: Preview,
    /// The same as a video.
    pub mp4: Mp4,
    /// A picture a drawing.
    pub images: NumberedImages,
    /// The stepped motion as GLB.
    pub glb: Glb,
}

/// How tables are written.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CsvSettings {
    /// Begin with a byte order mark, by which Excel knows UTF-8; default no.
    pub bom: bool,
}

knobs!(csv::CsvSettings {
    bom: knob(
        "BOM",
        "Tables begin with a byte order mark, by which Excel knows UTF-8.",
        "表の先頭にBOMを付ける。ExcelがUTF-8と分かる。",
    ),
});

impl CsvSettings {
    /// The bytes of a table.
    pub(crate) fn encode(&self, table: String) -> Vec<u8> {
        if self.bom { ["\u{feff}", &table].concat().into_bytes() } else { table.into_bytes() }
    }
}

knobs!(Settings {
    ..[
        csv, remap, xdts, tdts, xsheet, vmd, figures, strip, contact, onion, flipbook, preview,
        mp4, images, glb
    ]
});

impl Settings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()?;
        self.remap.validate()?;
        self.mp4.validate()
    }

    /// Sets one setting from text, as `--with FORMAT.SETTING=VALUE` does.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such setting, listing those there are, or the value is not one
    /// that it takes.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), Error> {
        let mut changed = self.clone();
        changed.turn(name, text).ok_or_else(|| self.unknown(name))??;
        changed.validate()?;
        *self = changed;
        Ok(())
    }

    /// What is said of every setting; its name is `FORMAT.SETTING`.
    pub fn knobs(&self) -> Vec<&'static Knob> {
        self.values().into_iter().map(|(knob, _)| knob).collect()
    }

    /// Every setting with its value, in the words of [`Settings::set`].
    pub fn settings(&self) -> Vec<(&'static Knob, String)> {
        self.values().into_iter().map(|(knob, value)| (knob, value.text())).collect()
    }

    /// Those that are not as they usually are, a line each: `FORMAT.SETTING VALUE`.
    pub fn lines(&self) -> String {
        let own = self.settings().into_iter().zip(Self::default().settings());
        let own = own.filter(|(own, usual)| own != usual);
        own.map(|((knob, value), _)| format!("{} {value}\n", knob.name)).collect()
    }

    /// The settings of such lines. What is no setting any more, or not such a value, stays as it usually is.
    pub fn from_lines(lines: &str) -> Self {
        let mut settings = Self::default();
        for (name, value) in lines.lines().filter_map(|line| line.split_once(' ')) {
            drop(settings.set(name, value));
        }
        settings
    }

    /// The name of every setting, as `FORMAT.SETTING`.
    pub fn names(&self) -> Vec<String> {
        self.knobs().into_iter().map(|knob| knob.name.to_owned()).collect()
    }

    fn unknown(&self, name: &str) -> Error {
        let message = format!("there is no such setting; there are {}", self.names().join(", "));
        Error::setting(name, message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_is_set_by_its_name() {
        let mut settings = Settings::default();
        settings.set("csv.bom", "true").unwrap();
        assert!(settings.csv.bom);
        assert_eq!(settings.csv.encode("a\n".into()), b"\xef\xbb\xbfa\n");
        assert_eq!(Settings::default().csv.encode("a\n".into()), b"a\n");
        let mut again = Settings::default();
        for (knob, value) in settings.settings() {
            again.set(knob.name, &value).unwrap();
        }
        assert_eq!(again, settings);
        assert_eq!(Settings::from_lines(&settings.lines()), settings);
        assert_eq!(settings.lines(), "csv.bom true\n");
        assert_eq!(Settings::from_lines("xls.bom 1\ncsv.bom ?\n\n"), Settings::default());
    }

    #[test]
    fn a_wrong_setting_says_which_there_are() {
        let mut settings = Settings::default();
        for name in ["bom", "csv", "csv.mob", "xls.bom", "csv.bom.x", ""] {
            let error = settings.set(name, "true").unwrap_err().to_string();
            assert!(error.contains("there is no such setting; there are "), "{name}: {error}");
            assert!(error.contains("csv.bom"), "{name}: {error}");
        }
        let error = settings.set("csv.bom", "yes").unwrap_err().to_string();
        assert_eq!(error, "csv.bom: expected true | false, found \"yes\"");
        assert_eq!(settings, Settings::default(), "nothing was changed");
    }

    #[test]
    fn a_number_out_of_its_range_is_refused_by_its_whole_name() {
        let mut settings = Settings::default();
        let huge = "2305843009213693952";
        for name in settings.names() {
            for value in ["0", huge] {
                if let Err(error) = settings.set(&name, value) {
                    assert!(error.to_string().starts_with(&format!("{name}: ")), "{error}");
                }
            }
        }
        let counts = [
            "strip.rows",
            "strip.in_line",
            "strip.most",
            "contact.rows",
            "contact.in_row",
            "onion.rows",
            "flipbook.most",
            "preview.most",
        ];
        for name in counts {
            assert!(settings.set(name, huge).is_err(), "{name}");
        }
    }
}
