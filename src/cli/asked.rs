//! The formats that a person asks for, and their files.

use std::path::Path;

use super::args::FormatSettings;
use super::failure::Failure;
use super::io;
use crate::deliver::{Cut, Format, Settings};
use crate::error::Error;

/// More files of one format than this are named by the first and the last.
const MOST_NAMES: usize = 3;

/// Formats and their settings.
pub(super) struct Asked {
    formats: Vec<&'static Format>,
    settings: Settings,
}

impl Asked {
    /// What `--option` names, and what comes `always`.
    pub(super) fn new(
        option: &str,
        names: &[String],
        always: &[&str],
        settings: &FormatSettings,
    ) -> Result<Self, Failure> {
        let asked_wrongly = |option: &'static str| {
            move |error: Error| Failure::AskedWrongly(format!("--{option}: {error}"))
        };
        let names = names.iter().map(String::as_str).chain(always.iter().copied());
        let formats = Format::find_all(names)
            .map_err(|error| Failure::AskedWrongly(format!("--{option}: {error}")))?;
        let mut made = Settings::default();
        if let Some(camera) = settings.camera {
            made.look_from(camera);
        }
        for (name, value) in &settings.with {
            made.set(name, value).map_err(asked_wrongly("with"))?;
        }
        Ok(Self { formats, settings: made })
    }

    /// Refuses to write where the motion is read from.
    pub(super) fn spare(&self, source: &Path, folder: &Path) -> Result<(), Failure> {
        let mut files = self.formats.iter().flat_map(|format| format.files);
        files.try_for_each(|file| io::spare(source, &folder.join(file)))
    }

    /// Writes every file, one made after the other, and gives their names for a person to read.
    pub(super) fn write(
        &self,
        cut: &Cut<'_>,
        bundle: &mut io::Bundle<'_>,
    ) -> Result<Vec<String>, Failure> {
        let mut all = Vec::new();
        for format in &self.formats {
            let mut names = Vec::new();
            format.write(cut, &self.settings, &mut |name, bytes| {
                names.push(name.to_owned());
                bundle.add(name, bytes)
            })?;
            if names.len() > MOST_NAMES {
                names.drain(1..names.len() - 1);
                names.insert(1, "…".into());
            }
            all.extend(names);
        }
        Ok(all)
    }
}
