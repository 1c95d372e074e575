//! What a reader is given: the bytes of a file, and the way to those beside it.

use std::fs::File;
use std::path::{Component, Path, PathBuf};

use super::Options;
use crate::error::{Error, Place};

/// A file that is read, whole, and where it lies.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a> {
    /// All its bytes.
    pub bytes: &'a [u8],
    /// Its path; none for bytes from memory and from a pipe.
    pub path: Option<&'a Path>,
}

impl Given<'_> {
    /// A file that this one names: one in its folder or below it, never anywhere else.
    ///
    /// # Errors
    /// [`Error::Motion`] at `place`, which names the file, where it cannot be had.
    pub fn beside(&self, name: &str, place: Place, options: &Options) -> Result<Vec<u8>, Error> {
        let wrong = |reason: String| Error::Motion { place: place.clone(), message: reason };
        let Some(folder) = self.path.and_then(Path::parent) else {
            let reason = format!("it needs {name} beside it: give it as a file, not as a stream");
            return Err(wrong(reason));
        };
        let below = |part| matches!(part, Component::Normal(_) | Component::CurDir);
        if name.is_empty() || !Path::new(name).components().all(below) {
            return Err(wrong(format!("{name:?} is no file in its folder or below it")));
        }
        let path = folder.join(name);
        let read = File::open(&path).and_then(|file| options.stream.read(file));
        read.map_err(|error| wrong(format!("it needs {}: {error}", path.display())))
    }

    /// Files of one ending in its folder, by name; none where it lies in no folder.
    pub fn neighbours(&self, ending: &str) -> Vec<PathBuf> {
        let folder = self.path.and_then(Path::parent);
        let here = |folder: &Path| match folder.as_os_str().is_empty() {
            true => PathBuf::from("."),
            false => folder.to_owned(),
        };
        let entries = folder.and_then(|folder| here(folder).read_dir().ok());
        let paths = entries.into_iter().flatten().flatten().map(|entry| entry.path());
        let is_asked = |path: &PathBuf| {
            path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending)) && path.is_file()
        };
        let mut found: Vec<PathBuf> = paths.filter(is_asked).collect();
        found.sort();
        found
    }
}
