//! Files and streams: `-` is stdin or stdout, and a file is written beside its place and then renamed,
//! so that nobody ever finds half of one. What is no file, a pipe or a device, is written into.

use std::fmt::Display;
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::{NamedTempFile, TempPath};

use super::failure::Failure;
use super::paths::{self, is_stream, named};
use crate::error::Error;
use crate::plot;

/// All bytes of a file, or of stdin for `-`.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = if is_stream(path) {
        let mut bytes = Vec::new();
        io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        fs::read(path)
    };
    bytes.map_err(|source| failed(path, source))
}

/// The text of the file that `--option` names, as `parse` reads it. Whatever is wrong with it is said of the option.
pub(super) fn parsed<T>(
    option: &str,
    path: &Path,
    parse: impl FnOnce(&str) -> Result<T, Error>,
) -> Result<T, Failure> {
    let wrong = |reason: &dyn Display| {
        Failure::AskedWrongly(format!("--{option}: {}: {reason}", named(path).display()))
    };
    let text = String::from_utf8(read(path)?).map_err(|_| wrong(&"is not UTF-8"))?;
    parse(&text).map_err(|error| wrong(&error))
}

/// An error that concerns a file, which its message then names.
pub(super) fn fault_of(path: &Path) -> impl Fn(Error) -> Failure {
    move |error| Failure::of_file(&named(path), error)
}

/// Writes a file whole or not at all, or to stdout for `-`.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_stream(path) {
        return to_stdout(bytes);
    }
    if is_device(path) {
        return fs::write(path, bytes).map_err(|source| failed(path, source));
    }
    let path = &behind_link(path);
    take_place(written_beside(path, bytes)?, path)
}

/// Writes data as JSON, as [`write`] does.
pub(super) fn write_json(path: &Path, data: &impl Serialize) -> Result<(), Failure> {
    write(path, json(&path.display(), data)?.as_bytes())
}

/// Data as JSON; `name` is what the file is called.
pub(super) fn json(name: &impl Display, data: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(data)
        .map_err(|error| Failure::CouldNot(format!("{name}: {error}")))?;
    Ok(text + "\n")
}

/// A picture as an SVG or, for a name that ends in `.png`, a PNG.
pub(super) fn write_picture(path: &Path, svg: &str) -> Result<(), Failure> {
    match paths::ending(path).as_deref() {
        Some("png") => write(path, &plot::png_from_svg(svg, 2.0)?),
        _ => write(path, svg.as_bytes()),
    }
}

/// Whether a path is a device or a pipe, which takes what is written and must not be replaced by a file.
fn is_device(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|about| !about.is_file() && !about.is_dir())
}

/// The file that a link leads to, so that the link stays; the path itself when it is none.
fn behind_link(path: &Path) -> PathBuf {
    let is_link = fs::symlink_metadata(path).is_ok_and(|about| about.is_symlink());
    let target = is_link.then(|| fs::canonicalize(path).ok()).flatten();
    target.unwrap_or_else(|| path.to_owned())
}

/// Files for a folder, each written beside its place as soon as it is made, so that none waits in
/// memory or stays open; they take their places together, so that a full disk leaves what was there
/// before.
pub(super) struct Bundle<'a> {
    folder: &'a Path,
    written: Vec<(TempPath, PathBuf)>,
    /// Folders that were made for it; what stays empty goes again.
    made: Vec<PathBuf>,
}

impl<'a> Bundle<'a> {
    /// Makes the folder.
    pub(super) fn begin(folder: &'a Path) -> Result<Self, Failure> {
        if folder.exists() && !folder.is_dir() {
            let message = format!("{}: is a file, not a folder", folder.display());
            return Err(Failure::CouldNot(message));
        }
        let mut bundle = Self { folder, written: Vec::new(), made: Vec::new() };
        bundle.make(folder)?;
        Ok(bundle)
    }

    /// The folder.
    pub(super) fn folder(&self) -> &Path {
        self.folder
    }

    /// Writes a file beside its place. Its name may have folders in it, with `/`.
    pub(super) fn add(&mut self, name: &str, text: impl AsRef<[u8]>) -> Result<(), Error> {
        let path = behind_link(&self.folder.join(name));
        if let Some(folder) = path.parent() {
            self.make(folder)?;
        }
        let file = written_beside(&path, text.as_ref())?;
        self.written.push((file.into_temp_path(), path));
        Ok(())
    }

    /// Puts all files into their places.
    pub(super) fn finish(mut self) -> Result<(), Failure> {
        let place = |(file, path): (TempPath, PathBuf)| {
            file.persist(&path).map_err(|error| io_error(&path, error.error))
        };
        Ok(std::mem::take(&mut self.written).into_iter().try_for_each(place)?)
    }

    fn make(&mut self, folder: &Path) -> Result<(), Error> {
        let missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
        self.made.extend(folder.ancestors().take_while(missing).map(Path::to_owned));
        fs::create_dir_all(folder).map_err(|source| io_error(folder, source))
    }
}

/// What was begun and not finished leaves nothing, no empty folder either.
impl Drop for Bundle<'_> {
    fn drop(&mut self) {
        self.written.clear();
        self.made.sort();
        // The deepest first; one that somebody else has put something into stays.
        self.made.iter().rev().for_each(|folder| drop(fs::remove_dir(folder)));
    }
}

/// A file of those bytes beside a path. It goes when it is dropped.
fn written_beside(path: &Path, bytes: &[u8]) -> Result<NamedTempFile, Error> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(io_error(folder, io::Error::other("there is no such folder")));
    }
    if path.is_dir() {
        return Err(io_error(path, io::Error::other("is a folder")));
    }
    let write = || {
        let mut file = like_any_other(&mut tempfile::Builder::new()).tempfile_in(folder)?;
        file.write_all(bytes)?;
        Ok(file)
    };
    write().map_err(|source| io_error(path, source))
}

/// A temporary file is private; what a person asked for is as readable as any file they make.
#[cfg(unix)]
fn like_any_other<'a, 'b, 'c>(
    builder: &'c mut tempfile::Builder<'a, 'b>,
) -> &'c mut tempfile::Builder<'a, 'b> {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(fs::Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn like_any_other<'a, 'b, 'c>(
    builder: &'c mut tempfile::Builder<'a, 'b>,
) -> &'c mut tempfile::Builder<'a, 'b> {
    builder
}

fn take_place(file: NamedTempFile, path: &Path) -> Result<(), Failure> {
    file.persist(path).map(drop).map_err(|error| failed(path, error.error))
}

/// Writes data to stdout; a closed pipe ends the program quietly.
pub(super) fn to_stdout(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(bytes).and_then(|()| stdout.flush()).map_err(|source| match source.kind() {
        io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
        _ => failed(Path::new("stdout"), source),
    })
}

fn failed(path: &Path, source: io::Error) -> Failure {
    io_error(path, source).into()
}

fn io_error(path: &Path, source: io::Error) -> Error {
    Error::Io { path: named(path), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn more_files_than_can_be_open_take_their_places_together() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("a/b");
        let mut bundle = Bundle::begin(&folder).unwrap();
        bundle.add("sheet.json", "{}").unwrap();
        for number in 0..3000 {
            bundle.add(&format!("images/A_{number:04}.png"), [number as u8]).unwrap();
        }
        assert!(!folder.join("sheet.json").exists(), "not before all are made");
        bundle.finish().unwrap();
        assert_eq!(names(&folder), ["images", "sheet.json"]);
        assert_eq!(names(&folder.join("images")).len(), 3000);
        assert_eq!(fs::read(folder.join("images/A_0007.png")).unwrap(), [7]);
    }

    #[test]
    fn what_is_not_finished_leaves_nothing_that_was_not_there() {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("taken"), "old").unwrap();
        let folder = place.path().join("a/b");
        let mut bundle = Bundle::begin(&folder).unwrap();
        bundle.add("images/A_0001.png", "new").unwrap();
        assert_eq!(names(&folder.join("images")).len(), 1, "beside its place");
        drop(bundle);
        assert_eq!(names(place.path()), ["taken"]);
        // A folder that was there stays, with what is in it.
        fs::create_dir_all(place.path().join("a/images")).unwrap();
        fs::write(place.path().join("a/sheet.json"), "old").unwrap();
        let folder = place.path().join("a");
        let mut bundle = Bundle::begin(&folder).unwrap();
        bundle.add("sheet.json", "new").unwrap();
        bundle.add("images/A_0001.png", "new").unwrap();
        assert!(bundle.add("sheet.json/A_0001.png", "new").is_err(), "a file stands there");
        assert!(bundle.add("images", "new").is_err(), "a folder stands there");
        drop(bundle);
        assert_eq!(names(&folder), ["images", "sheet.json"]);
        assert_eq!(names(&folder.join("images")), [""; 0]);
        assert_eq!(fs::read(folder.join("sheet.json")).unwrap(), b"old");
        assert!(Bundle::begin(&place.path().join("taken")).is_err());
        assert!(Bundle::begin(&place.path().join("taken/under")).is_err());
        assert_eq!(names(place.path()), ["a", "taken"]);
    }
}
