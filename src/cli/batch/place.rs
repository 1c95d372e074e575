//! The folder of a clip takes its place: whole, and never over what a person changed.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use walkdir::WalkDir;

use super::super::failure::Failure;
use crate::deliver::Manifest;

/// The folder in which each clip has its own.
pub(super) const CLIPS: &str = "clips";

/// Files with their digests.
type Files = BTreeMap<String, String>;

/// Where clips have their folders.
pub(in crate::cli) struct Places<'a> {
    pub(in crate::cli) out: &'a Path,
    /// Whether a person's changes may be written over.
    pub(in crate::cli) is_forced: bool,
}

impl Places<'_> {
    /// The folder of a clip.
    pub(in crate::cli) fn of(&self, name: &str) -> PathBuf {
        self.out.join(CLIPS).join(name)
    }

    /// Whether all files of a clip are there.
    pub(in crate::cli) fn has(&self, name: &str, files: &Files) -> bool {
        let folder = self.of(name);
        files.keys().all(|file| folder.join(file).is_file())
    }

    /// Puts a folder that is ready in the place of the one of an earlier batch, which goes to `old`. Without files there is none to
    /// put.
    pub(in crate::cli) fn put(
        &self,
        name: &str,
        (ready, old): (&Path, &Path),
        come: &Files,
        before: &Files,
    ) -> Result<(), Failure> {
        let place = self.of(name);
        let failed = |error| Failure::at(&place, error);
        if place.exists() {
            self.spare(&place, come, before)?;
            fs::rename(&place, old).map_err(failed)?;
        }
        if come.is_empty() {
            return Ok(());
        }
        place.parent().map_or(Ok(()), fs::create_dir_all).map_err(failed)?;
        fs::rename(ready, &place).map_err(failed)
    }

    /// Refuses a folder in which a file is neither as the batch before wrote it nor as this one does.
    fn spare(&self, place: &Path, come: &Files, before: &Files) -> Result<(), Failure> {
        if self.is_forced {
            return Ok(());
        }
        for entry in
            WalkDir::new(place).into_iter().flatten().filter(|entry| entry.file_type().is_file())
        {
            let path = entry.path();
            let name =
                path.strip_prefix(place).unwrap_or(path).to_string_lossy().replace('\\', "/");
            let digest = fs::read(path).map(|bytes| Manifest::digest(&bytes)).unwrap_or_default();
            let is_ours = |files: &Files| files.get(&name) == Some(&digest);
            if !is_ours(come) && !is_ours(before) {
                return Err(foreign(path, "file"));
            }
        }
        Ok(())
    }
}

/// Refuses to write over what no batch wrote.
pub(super) fn foreign(path: &Path, what: &str) -> Failure {
    let path = path.display();
    Failure::AskedWrongly(format!(
        "{path}: this {what} is not as a batch wrote it, and would be lost; move it, write elsewhere with --out, or write \
         over it with --force"
    ))
}
