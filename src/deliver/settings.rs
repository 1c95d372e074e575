//! What can be asked of the formats: a small settings struct each, set by name.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::deliver::xdts::Xdts;
use crate::deliver::{FigureSettings, Glb, Vmd};
use crate::error::Error;
use crate::plot::{ContactSheet, FlipBook, NumberedImages, OnionSkin, Preview, Strip, XSheet};

/// The settings of every format, by its name. A new format's are a field here.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// The tables.
    pub csv: CsvSettings,
    /// The timesheets for programs.
    pub xdts: Xdts,
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

impl CsvSettings {
    /// The bytes of a table.
    pub(crate) fn encode(&self, table: String) -> Vec<u8> {
        if self.bom { ["\u{feff}", &table].concat().into_bytes() } else { table.into_bytes() }
    }
}

impl Settings {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.vmd.validate()?;
        self.glb.validate()?;
        in_section("strip", self.strip.validate())?;
        in_section("contact", self.contact.validate())?;
        in_section("onion", self.onion.validate())?;
        in_section("flipbook", self.flipbook.validate())?;
        in_section("preview", self.preview.validate())?;
        in_section("images", self.images.validate())
    }

    /// Sets one setting from text, as `--with FORMAT.SETTING=VALUE` does.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such setting, listing those there are, or the value is not one
    /// that it takes.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), Error> {
        let mut table = self.table();
        let place = name
            .split_once('.')
            .and_then(|(section, field)| table.get_mut(section)?.as_table_mut()?.get_mut(field));
        let Some(place) = place else {
            let message =
                format!("there is no such setting; there are {}", self.names().join(", "));
            return Err(Error::setting(name, message));
        };
        *place = like(place, text.trim());
        let changed: Self = Value::Table(table).try_into().map_err(|error: toml::de::Error| {
            let reason = error.message().lines().next().unwrap_or_default().to_owned();
            Error::setting(name, format!("cannot be \"{text}\": {reason}"))
        })?;
        changed.validate()?;
        // A table of bones is no word; it stays.
        let bones = self.vmd.bones.take();
        *self = changed;
        self.vmd.bones = bones;
        Ok(())
    }

    /// The name of every setting, as `FORMAT.SETTING`.
    pub fn names(&self) -> Vec<String> {
        let table = self.table();
        let sections =
            table.iter().filter_map(|(section, value)| Some((section, value.as_table()?)));
        sections
            .flat_map(|(section, fields)| {
                fields.keys().map(move |field| format!("{section}.{field}"))
            })
            .collect()
    }

    fn table(&self) -> Table {
        Table::try_from(self).expect("settings are plain numbers and words")
    }
}

/// What is wrong with a picture's setting, by its name here: a picture knows only its own.
fn in_section(section: &str, checked: Result<(), Error>) -> Result<(), Error> {
    checked.map_err(|error| match error {
        Error::Setting { name, message } => Error::setting(format!("{section}.{name}"), message),
        other => other,
    })
}

/// The value that a word means where such a value stands.
fn like(before: &Value, text: &str) -> Value {
    let value = match before {
        Value::Boolean(_) => text.parse().ok().map(Value::Boolean),
        Value::Integer(_) => text.parse().ok().map(Value::Integer),
        Value::Float(_) => text.parse().ok().map(Value::Float),
        _ => None,
    };
    value.unwrap_or_else(|| Value::String(text.into()))
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
        assert!(error.starts_with("csv.bom: cannot be \"yes\": "), "{error}");
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
