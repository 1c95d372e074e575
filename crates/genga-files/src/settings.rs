//! The settings of the formats: a small struct per format, set by name.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::xdts::{Tdts, Xdts};
use crate::{Curves, FigureSettings, Glb, Mp4, Remap, Vmd};
use genga::error::{Error, did_you_mean};
use genga::knob::{Knob, Knobs, knob, knobs};
use genga_plot::{ContactSheet, FlipBook, NumberedImages, OnionSkin, Preview, Strip, XSheet};

/// The settings of every format, by its name. A new format with settings adds a field here.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// The CSV tables.
    pub csv: CsvSettings,
    /// The timing alone (`remap`).
    pub remap: Remap,
    /// The timesheets for drawing programs, as two files.
    pub xdts: Xdts,
    /// The timesheets for drawing programs, as one file.
    pub tdts: Tdts,
    /// The timesheet on paper.
    pub xsheet: XSheet,
    /// The motion for MikuMikuDance.
    pub vmd: Vmd,
    /// Common settings of all pictures of figures.
    pub figures: FigureSettings,
    /// The picture with the source above and the result below.
    pub strip: Strip,
    /// The contact sheet of the genga.
    pub contact: ContactSheet,
    /// The onion skin of neighbouring drawings.
    pub onion: OnionSkin,
    /// The web page that plays the sheet.
    pub flipbook: FlipBook,
    /// The animated preview, source beside result.
    pub preview: Preview,
    /// The preview as a video.
    pub mp4: Mp4,
    /// The numbered images, one per drawing.
    pub images: NumberedImages,
    /// The stepped motion as GLB.
    pub glb: Glb,
    /// Keys with curves between them.
    pub curves: Curves,
}

/// Settings of the CSV tables.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CsvSettings {
    /// Whether a table begins with a byte order mark, by which Excel recognizes UTF-8; default no.
    pub bom: bool,
}

knobs!(csv::CsvSettings {
    bom: knob(
        "BOM",
        "Whether tables begin with a byte order mark, by which Excel detects UTF-8.",
        "表の先頭にBOMを付けるか。ExcelがUTF-8と判別できる。",
    ),
});

impl CsvSettings {
    /// Encodes a table as bytes.
    pub fn encode(&self, table: String) -> Vec<u8> {
        if self.bom { ["\u{feff}", &table].concat().into_bytes() } else { table.into_bytes() }
    }
}

knobs!(Settings {
    ..[
        csv, remap, xdts, tdts, xsheet, vmd, figures, strip, contact, onion, flipbook, preview,
        mp4, images, glb, curves
    ]
});

impl Settings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first setting that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()?;
        self.remap.validate()?;
        self.mp4.validate()
    }

    /// Sets one setting from text, as `--with FORMAT.SETTING=VALUE` does.
    ///
    /// # Errors
    /// [`Error::Setting`] if no setting has that name (the error lists the known ones), or if the value is not
    /// valid for it.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), Error> {
        let mut changed = self.clone();
        changed.turn(name, text).ok_or_else(|| self.unknown(name))??;
        changed.validate()?;
        *self = changed;
        Ok(())
    }

    /// Descriptions of all settings, named `FORMAT.SETTING`.
    pub fn knobs(&self) -> Vec<&'static Knob> {
        self.values().into_iter().map(|(knob, _)| knob).collect()
    }

    /// All settings with their values, written as [`Settings::set`] takes them.
    pub fn settings(&self) -> Vec<(&'static Knob, String)> {
        self.values().into_iter().map(|(knob, value)| (knob, value.text())).collect()
    }

    /// The settings that differ from their defaults, by name. A model that was read from a file has a file's name, so that
    /// it is not taken for the name of a model alone.
    pub fn own(&self) -> BTreeMap<String, String> {
        let own = self.settings().into_iter().zip(Self::default().settings());
        let own = own.filter(|(own, usual)| own != usual);
        let mut own: BTreeMap<_, _> =
            own.map(|((knob, value), _)| (knob.name.to_owned(), value)).collect();
        if let Some(body) = &self.vmd.body {
            own.insert("vmd.model".into(), format!("{}.pmx", body.name));
        }
        own
    }

    /// The settings that differ from their defaults, one line each: `FORMAT.SETTING VALUE`.
    pub fn lines(&self) -> String {
        let own = self.settings().into_iter().zip(Self::default().settings());
        let own = own.filter(|(own, usual)| own != usual);
        own.map(|((knob, value), _)| format!("{} {value}\n", knob.name)).collect()
    }

    /// Reads lines written by [`Settings::lines`]. Ignores unknown settings and invalid values.
    pub fn from_lines(lines: &str) -> Self {
        let mut settings = Self::default();
        for (name, value) in lines.lines().filter_map(|line| line.split_once(' ')) {
            drop(settings.set(name, value));
        }
        settings
    }

    /// Names of all settings, as `FORMAT.SETTING`.
    pub fn names(&self) -> Vec<String> {
        self.knobs().into_iter().map(|knob| knob.name.to_owned()).collect()
    }

    fn unknown(&self, name: &str) -> Error {
        let names = self.names();
        let hint = match did_you_mean(name, names.iter().map(String::as_str)) {
            none if none.is_empty() => ";".to_owned(),
            hint => hint,
        };
        let message = format!("there is no such setting{hint} there are {}", names.join(", "));
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
        for (name, hint) in [
            ("bom", "; did you mean csv.bom?"),
            ("csv.mob", "; did you mean csv.bom?"),
            ("vmd.fsp", "; did you mean vmd.fps?"),
            ("xls", ";"),
            ("", ";"),
        ] {
            let error = settings.set(name, "true").unwrap_err().to_string();
            let said = format!("there is no such setting{hint} there are csv.bom, ");
            assert!(error.contains(&said), "{name}: {error}");
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
