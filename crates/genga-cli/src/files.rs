//! Reads and writes files and streams. `-` is stdin or stdout. A file is written beside its target and then renamed, so
//! that nobody ever sees half of one. Pipes and devices are written to directly.

use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use super::console::Words;
use super::failure::Failure;
use super::paths::{self, is_stream, named};
use super::staging::{self, Staging};
use super::stop;
use genga::error::Error;
use genga::motion::StreamLimit;
use genga::sanitize::shown_lines;
use genga_files::Manifest;

use serde::Serialize;

/// Reads all bytes of a file, or of stdin for `-`.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    read_up_to(StreamLimit::default(), path)
}

/// Reads all bytes of a file; a pipe or a device only up to a limit.
pub(super) fn read_up_to(limit: StreamLimit, path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = if is_stream(path) {
        limit.read(io::stdin().lock())
    } else if is_device(path) {
        File::open(path).and_then(|device| limit.read(device))
    } else {
        fs::read(path)
    };
    bytes.map_err(|source| failed(path, source))
}

/// Returns the digest of a file's bytes.
pub(super) fn digest(path: &Path) -> Result<String, Failure> {
    read(path).map(|bytes| Manifest::digest(&bytes))
}

/// Reads and parses the text file that `--option` names. Errors name the option.
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

/// Returns a function that adds a file's path to an error.
pub(super) fn fault_of(path: &Path) -> impl Fn(Error) -> Failure {
    move |error| Failure::of_file(&named(path), error)
}

/// Writes a whole file or none, or to stdout for `-`.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_stream(path) {
        return to_stdout(bytes);
    }
    if is_device(path) {
        return fs::write(path, bytes).map_err(|source| failed(path, source));
    }
    let path = &staging::behind_link(path);
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    check_place(folder, path)?;
    let put = || {
        let staging = Staging::within(folder)?;
        let staged = staging.place("file");
        stop::undisturbed(|| {
            fs::write(&staged, bytes)?;
            fs::rename(staged, path)
        })
    };
    put().map_err(|source| failed(path, source))
}

/// Writes data as JSON with [`write`].
pub(super) fn write_json(path: &Path, data: &impl Serialize) -> Result<(), Failure> {
    write(path, json(&path.display(), data)?.as_bytes())
}

/// Serializes data as JSON; `name` is the file's name for messages.
fn json(name: &impl Display, data: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(data)
        .map_err(|error| Failure::CouldNot(format!("{name}: {error}")))?;
    Ok(text + "\n")
}

/// Writes a picture as SVG, or as PNG or PDF if the name ends in `.png` or `.pdf`, and says if these have no letters.
pub(super) fn write_picture(path: &Path, svg: &str, words: &Words) -> Result<(), Failure> {
    #[cfg(feature = "pictures")]
    if matches!(paths::ending(path).as_deref(), Some("png" | "pdf")) {
        genga_plot::font_note().iter().for_each(|note| words.warn(note));
    }
    #[cfg(not(feature = "pictures"))]
    let _ = words;
    match paths::ending(path).as_deref() {
        #[cfg(feature = "pictures")]
        Some("png") => write(path, &genga_plot::png_from_svg(svg, 2.0)?),
        #[cfg(feature = "pdf")]
        Some("pdf") => write(path, &genga_plot::pdf_from_svg(svg)?),
        _ => write(path, svg.as_bytes()),
    }
}

/// Whether a path is a device or a pipe, which must be written to and not replaced by a file.
fn is_device(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|about| !about.is_file() && !about.is_dir())
}

/// Fails if a file cannot be written there.
fn check_place(folder: &Path, path: &Path) -> Result<(), Failure> {
    if !folder.is_dir() {
        return Err(failed(folder, io::Error::other("there is no such folder; make it first")));
    }
    if path.is_dir() {
        return Err(failed(path, io::ErrorKind::IsADirectory.into()));
    }
    Ok(())
}

/// Writes a page for people to stdout, with control characters of file contents made visible.
pub(super) fn page_to_stdout(page: &str) -> Result<(), Failure> {
    to_stdout(shown_lines(page).as_bytes())
}

/// Writes data to stdout. A closed pipe ends the program quietly.
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
