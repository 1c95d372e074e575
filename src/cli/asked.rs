//! The formats that a person asks for, and their files.

use std::path::Path;

use super::args::{BvhRows, FormatArgs};
use super::failure::Failure;
use super::io;
use crate::deliver::{BoneMap, Cut, Format, Settings};
use crate::error::{Error, Warning};

/// More files of one format than this are named by the first and the last.
const MOST_NAMES: usize = 3;

/// Formats and their settings.
pub(super) struct Asked {
    formats: Vec<&'static Format>,
    settings: Settings,
}

impl Asked {
    /// What `--option` names, what else is asked for, and what comes `always`.
    pub(super) fn new(
        option: &str,
        names: &[String],
        always: &[&str],
        args: &FormatArgs,
    ) -> Result<Self, Failure> {
        let bvh = args.bvh.map(|rows| match rows {
            BvhRows::Stepped => "bvh",
            BvhRows::Keys => "bvh-keys",
        });
        let names = names.iter().map(String::as_str).chain(bvh).chain(always.iter().copied());
        let formats = Format::find_all(names).map_err(|error| wrongly(option, &error))?;
        let mut settings = Settings::default();
        if let Some(camera) = args.camera {
            settings.look_from(camera);
        }
        for (name, value) in &args.with {
            settings.set(name, value).map_err(|error| wrongly("with", &error))?;
        }
        settings.vmd.bones = args.bones.as_deref().map(bones).transpose()?;
        Ok(Self { formats, settings })
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
    /// What a person should know of the files.
    pub(super) fn notes(&self, cut: &Cut<'_>) -> Result<Vec<Warning>, Failure> {
        let mut notes = Vec::new();
        for format in &self.formats {
            notes.extend(format.notes(cut, &self.settings)?);
        }
        Ok(notes)
    }
}

/// A person's table of bones.
fn bones(path: &Path) -> Result<BoneMap, Failure> {
    let name = io::named(path);
    let wrong = |reason: &dyn std::fmt::Display| {
        Failure::AskedWrongly(format!("--bones: {}: {reason}", name.display()))
    };
    let bytes = io::read(path)?;
    let text = std::str::from_utf8(&bytes).map_err(|_| wrong(&"is not UTF-8"))?;
    BoneMap::parse(text).map_err(|error| wrong(&error))
}

fn wrongly(option: &str, error: &Error) -> Failure {
    Failure::AskedWrongly(format!("--{option}: {error}"))
}
