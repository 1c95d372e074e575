//! Provides the input of a reader: the bytes of a file, and access to the files beside it.

use std::fs::File;
use std::path::{Component, Path, PathBuf};

use super::Options;
use genga::error::{Error, Place};

/// A motion file in memory, and its path.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a> {
    /// All bytes of the file.
    pub bytes: &'a [u8],
    /// The path of the file; `None` for bytes from memory or a pipe.
    pub path: Option<&'a Path>,
}

impl Given<'_> {
    /// Reads a file to which this one refers. It must lie in the same folder or below it.
    ///
    /// # Errors
    /// [`Error::Motion`] at `place`, which names the file, if it cannot be read.
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

    /// Lists the files with an extension in the same folder, sorted by name; empty if the file has no path.
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

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use genga::motion::StreamLimit;

    #[test]
    fn a_neighbour_lies_in_the_folder_or_below_it() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        fs::create_dir(at("a")).unwrap();
        for name in ["secret", "a/walk.amc", "a/b.asf", "a/a.ASF", "a/data.bin"] {
            fs::write(at(name), name).unwrap();
        }
        let path = at("a/walk.amc");
        let given = Given { bytes: b"", path: Some(&path) };
        let beside = |name: &str| given.beside(name, Place::Byte(7), &Options::default());
        assert_eq!(beside("data.bin").unwrap(), b"a/data.bin");
        assert_eq!(beside("./data.bin").unwrap(), b"a/data.bin");
        for outside in ["../secret", "/etc/hostname", "", "x/../../secret", "none"] {
            assert!(beside(outside).unwrap_err().to_string().starts_with("byte 7: "), "{outside}");
        }
        assert_eq!(given.neighbours("asf"), [at("a/a.ASF"), at("a/b.asf")]);
        let nowhere = Given { bytes: b"", path: None };
        assert!(nowhere.neighbours("asf").is_empty());
        let limit = Options { stream: StreamLimit { bytes: 3 }, ..Options::default() };
        assert!(given.beside("data.bin", Place::Whole, &limit).is_err(), "more than may be read");
    }
}
