//! Provides the input of a reader: the bytes of a file, and access to the files beside it.

use std::borrow::Cow;
use std::fs::File;
use std::path::{Component, Path, PathBuf};

use super::Options;
use genga::error::{Error, Place};
use genga::motion::StreamLimit;

/// A motion file in memory, and its path.
#[derive(Debug, Clone, Copy)]
pub struct Given<'a> {
    /// All bytes of the file.
    pub bytes: &'a [u8],
    /// The path of the file; `None` for bytes from memory or a pipe.
    pub path: Option<&'a Path>,
}

impl Given<'_> {
    /// Finds a file to which this one refers. Only a regular file in the same folder or below it counts, wherever links
    /// lead: a clip from a stranger must neither hang on a pipe nor read what lies elsewhere.
    ///
    /// # Errors
    /// [`Error::Motion`] at `place`, which names the file, if there is none.
    pub fn find_beside(&self, name: &str, place: &Place) -> Result<PathBuf, Error> {
        let wrong = |reason: String| Error::Motion { place: place.clone(), message: reason };
        let shown = shortened(name, NAME);
        let Some(folder) = self.path.and_then(Path::parent) else {
            let reason = format!("it needs {shown} beside it: give it as a file, not as a stream");
            return Err(wrong(reason));
        };
        let outside = || wrong(format!("{shown:?} is no file in its folder or below it"));
        let below = |part| matches!(part, Component::Normal(_) | Component::CurDir);
        if name.is_empty() || !Path::new(name).components().all(below) {
            return Err(outside());
        }
        let real = |path: &Path| {
            let missing = |error| wrong(format!("it needs {shown} beside it: {error}"));
            path.canonicalize().map_err(missing)
        };
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let path = real(&folder.join(name))?;
        if !path.starts_with(real(folder)?) {
            return Err(outside());
        }
        if !path.is_file() {
            return Err(wrong(format!("it needs {shown} beside it, which is no regular file")));
        }
        Ok(path)
    }

    /// Reads a file to which this one refers, as [`Given::find_beside`] finds it.
    ///
    /// # Errors
    /// [`Error::Motion`] at `place`, which names the file, if it cannot be read.
    pub fn beside(&self, name: &str, place: Place, options: &Options) -> Result<Vec<u8>, Error> {
        read_beside(&self.find_beside(name, &place)?, place, options.stream)
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

/// Reads a file that was found beside another.
///
/// # Errors
/// [`Error::Motion`] at `place` if it cannot be read, or is larger than the limit.
pub(crate) fn read_beside(path: &Path, place: Place, limit: StreamLimit) -> Result<Vec<u8>, Error> {
    let read = File::open(path).and_then(|file| limit.read(file));
    read.map_err(|error| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Error::Motion {
            place,
            message: format!("it needs {} beside it: {error}", shortened(&name, NAME)),
        }
    })
}

/// Most letters of a name from a file in a message.
const NAME: usize = 80;

/// Cuts a text from a file off after `most` letters.
pub(crate) fn shortened(text: &str, most: usize) -> Cow<'_, str> {
    match text.char_indices().nth(most) {
        Some((end, _)) => Cow::Owned(format!("{}…", &text[..end])),
        None => Cow::Borrowed(text),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_neighbour_is_a_plain_file_and_its_name_is_short_in_messages() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        fs::create_dir_all(at("a/folder")).unwrap();
        fs::write(at("secret"), "secret").unwrap();
        fs::write(at("a/walk.gltf"), "{}").unwrap();
        let path = at("a/walk.gltf");
        let given = Given { bytes: b"", path: Some(&path) };
        let refused = |name: &str| {
            given.beside(name, Place::Whole, &Options::default()).unwrap_err().to_string()
        };
        assert!(refused("folder").contains("no regular file"));
        let long = "x".repeat(50_000);
        assert!(refused(&long).len() < 400, "{}", refused(&long));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(at("secret"), at("a/link.bin")).unwrap();
            assert!(refused("link.bin").contains("no file in its folder"));
            std::os::unix::fs::symlink(at("a/walk.gltf"), at("a/inside.bin")).unwrap();
            assert!(given.find_beside("inside.bin", &Place::Whole).is_ok());
            std::os::unix::fs::symlink("/dev/zero", at("a/zero.bin")).unwrap();
            assert!(refused("zero.bin").contains("no file in its folder"));
            let pipe = std::os::unix::net::UnixListener::bind(at("a/pipe.bin")).unwrap();
            assert!(refused("pipe.bin").contains("no regular file"));
            drop(pipe);
        }
    }

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
