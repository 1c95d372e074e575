//! The studio's desk on a disk: it reads, writes and exports as the other commands do.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::args::{FormatArgs, Part};
use super::asked::Asked;
use super::failure::Failure;
use super::recent::Recent;
use super::results::{ALWAYS, OWN, Results};
use super::{dialog, io, source};
use crate::studio::{Desk, Export, Opened};

/// Files on a disk.
#[derive(Debug, Default)]
pub struct Disk {
    /// The clip that the command line names, and which part of it is meant.
    named: Option<(PathBuf, Part)>,
    recent: Recent,
}

impl Disk {
    /// A disk with a clip of which a part is meant, and the list of what was opened last.
    pub(super) fn with(clip: Option<PathBuf>, part: Part) -> Self {
        Self { named: clip.map(|clip| (clip, part)), recent: Recent::of_person() }
    }
}

impl Desk for Disk {
    fn open(&self, clip: &Path) -> Result<Opened, String> {
        let whole = Part::default();
        let part = self.named.as_ref().filter(|(named, _)| named == clip);
        let read = source::part(clip, part.map_or(&whole, |(_, part)| part)).map_err(said)?;
        let notes = read.notes.iter().map(ToString::to_string).collect();
        Ok(Opened { clip: read.clip, notes })
    }

    fn read(&self, path: &Path) -> Result<Option<String>, String> {
        match fs::read_to_string(path) {
            Ok(text) => Ok(Some(text)),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("{}: {error}", path.display())),
        }
    }

    fn write(&self, path: &Path, text: &str) -> Result<(), String> {
        io::write(path, text.as_bytes()).map_err(said)
    }

    fn remove(&self, path: &Path) -> Result<(), String> {
        match fs::remove_file(path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(format!("{}: {error}", path.display()))
            }
            _ => Ok(()),
        }
    }

    fn export(
        &self,
        folder: &Path,
        export: &Export<'_>,
        tell: &dyn Fn(&str),
    ) -> Result<Vec<String>, String> {
        written(folder, export, tell).map_err(said)
    }

    fn choose(&self) -> Option<PathBuf> {
        dialog::choose()
    }

    fn recent(&self) -> Vec<PathBuf> {
        self.recent.clips()
    }

    fn remember(&self, clip: &Path) {
        // A list that cannot be written is worth no word.
        drop(self.recent.remember(clip));
    }
}

/// Writes what a run writes, and spares what a run spares.
fn written(
    folder: &Path,
    export: &Export<'_>,
    tell: &dyn Fn(&str),
) -> Result<Vec<String>, Failure> {
    let mut asked = Asked::new("deliver", &[], &ALWAYS, &FormatArgs::default())?;
    let name = io::stem(export.clip);
    asked.spare("motion", export.clip, folder, &name)?;
    OWN.iter().try_for_each(|file| io::spare_the("motion", export.clip, &folder.join(file)))?;
    asked.spare_edited(folder)?;
    let results = Results {
        name: &name,
        clip_file: &io::file_name(export.clip),
        breakdown: export.breakdown,
        recipe: export.recipe,
        edits: export.edits,
        notes: export.notes.to_vec(),
        kept: None,
        tell,
    };
    let (_, written) = results.write(&mut asked, folder)?;
    Ok(written.files)
}

fn said(failure: Failure) -> String {
    failure.to_string()
}
