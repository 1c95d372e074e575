//! Moves the folder of a clip into its place: as a whole, and never over a person's changes.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use walkdir::WalkDir;

use super::super::failure::Failure;
use super::super::format_args::Overwrites;
use super::super::paths;
use genga_files::Manifest;

/// Folder that holds a folder per clip.
pub(super) const CLIPS: &str = "clips";

/// Digests of files by name.
type Files = BTreeMap<String, String>;

/// The output folder of a batch, with the clips' folders.
pub(crate) struct Places<'a> {
    pub(crate) out: &'a Path,
    /// Changed files that this batch may overwrite.
    pub(crate) over: Overwrites<'a>,
}

impl Places<'_> {
    /// The folder of a clip.
    pub(crate) fn clip_folder(&self, name: &str) -> PathBuf {
        self.out.join(CLIPS).join(name)
    }

    /// Whether all files of a clip are there.
    pub(crate) fn has(&self, name: &str, files: &Files) -> bool {
        let folder = self.clip_folder(name);
        files.keys().all(|file| folder.join(file).is_file())
    }

    /// Moves a finished folder to the place of the earlier batch's folder, which goes to `old`; painted pictures stay.
    /// Does nothing if there are no files. Returns the names of the pictures that stay.
    pub(crate) fn put(
        &self,
        name: &str,
        (ready, old): (&Path, &Path),
        come: &Files,
        before: &Files,
    ) -> Result<Vec<String>, Failure> {
        let place = self.clip_folder(name);
        let failed = |error: io::Error| match is_too_long(&error) {
            // The clip's own fault, which becomes its row.
            true => Failure::AskedWrongly(too_long(&place)),
            false => Failure::at(&place, error),
        };
        let mut painted = Vec::new();
        if place.exists() {
            painted = self.spare(&place, come, before)?;
            painted
                .iter()
                .try_for_each(|file| copy(&place.join(file), &ready.join(file)))
                .and_then(|()| fs::rename(&place, old))
                .map_err(failed)?;
        }
        if come.is_empty() && painted.is_empty() {
            return Ok(painted);
        }
        place.parent().map_or(Ok(()), fs::create_dir_all).map_err(failed)?;
        fs::rename(ready, &place).map_err(failed).map(|()| painted)
    }

    /// Refuses a folder with a file that neither the previous batch nor this one wrote. Returns the names of such
    /// pictures.
    fn spare(&self, place: &Path, come: &Files, before: &Files) -> Result<Vec<String>, Failure> {
        let mut painted = Vec::new();
        for entry in
            WalkDir::new(place).into_iter().flatten().filter(|entry| entry.file_type().is_file())
        {
            let path = entry.path();
            let name =
                path.strip_prefix(place).unwrap_or(path).to_string_lossy().replace('\\', "/");
            let digest = fs::read(path).map(|bytes| Manifest::digest(&bytes)).unwrap_or_default();
            let is_ours = |files: &Files| files.get(&name) == Some(&digest);
            if is_ours(come) || is_ours(before) || self.over.has(place, &name) {
                continue;
            }
            match paths::is_picture(path) {
                true => painted.push(name),
                false if self.over.is_forced => {}
                false => return Err(foreign(path, "file")),
            }
        }
        Ok(painted)
    }
}

/// Whether the file system refuses a name, usually one of more than 255 bytes.
pub(super) fn is_too_long(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::InvalidFilename
}

/// The message for a name that the file system refuses.
pub(super) fn too_long(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    format!("{name}: the name is too long for the file system; give the clip a shorter one")
}

/// Copies a file, with the folders that it needs.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    to.parent().map_or(Ok(()), fs::create_dir_all)?;
    fs::copy(from, to).map(drop)
}

/// The failure for something that no batch wrote and that would be overwritten.
pub(super) fn foreign(path: &Path, what: &str) -> Failure {
    let path = path.display();
    Failure::AskedWrongly(format!(
        "{path}: this {what} is not as a batch wrote it, and would be lost; move it, write elsewhere with --out, or write \
         over it with --force"
    ))
}
