//! Files and streams: `-` is stdin or stdout, and a file is written beside its place and then renamed,
//! so that nobody ever finds half of one. What is no file, a pipe or a device, is written into.

use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use super::failure::Failure;
use super::paths::{self, is_stream, named};
use super::staging::{self, Staging};
use super::stop;
use crate::error::Error;
use crate::motion::StreamLimit;
use crate::plain::shown_lines;
use crate::plot;
use serde::Serialize;

/// All bytes of a file, or of stdin for `-`.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    read_up_to(StreamLimit::default(), path)
}

/// The same, of a pipe or a device up to a limit.
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

/// Writes data as JSON, as [`write`] does.
pub(super) fn write_json(path: &Path, data: &impl Serialize) -> Result<(), Failure> {
    write(path, json(&path.display(), data)?.as_bytes())
}

/// Data as JSON; `name` is what the file is called.
fn json(name: &impl Display, data: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(data)
        .map_err(|error| Failure::CouldNot(format!("{name}: {error}")))?;
    Ok(text + "\n")
}

/// A picture as an SVG or, for a name that ends in `.png` or `.pdf`, a PNG or a PDF.
pub(super) fn write_picture(path: &Path, svg: &str) -> Result<(), Failure> {
    match paths::ending(path).as_deref() {
        Some("png") => write(path, &plot::png_from_svg(svg, 2.0)?),
        #[cfg(feature = "pdf")]
        Some("pdf") => write(path, &plot::pdf_from_svg(svg)?),
        _ => write(path, svg.as_bytes()),
    }
}

/// Whether a path is a device or a pipe, which takes what is written and must not be replaced by a file.
fn is_device(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|about| !about.is_file() && !about.is_dir())
}

/// What keeps a file from being written; nothing where it can be.
fn check_place(folder: &Path, path: &Path) -> Result<(), Failure> {
    if !folder.is_dir() {
        return Err(failed(folder, io::Error::other("there is no such folder")));
    }
    if path.is_dir() {
        return Err(failed(path, io::Error::other("is a folder")));
    }
    Ok(())
}

/// Writes a page for people to stdout: nothing that a file says is hidden in it.
pub(super) fn page_to_stdout(page: &str) -> Result<(), Failure> {
    to_stdout(shown_lines(page).as_bytes())
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
