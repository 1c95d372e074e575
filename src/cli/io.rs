//! Files and streams: `-` is stdin or stdout, and a file is written beside its place and then renamed,
//! so that nobody ever finds half of one.

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::failure::Failure;
use crate::error::Error;

/// Whether a path means stdin or stdout.
pub(super) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

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

/// Writes a file whole or not at all, or to stdout for `-`.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_stream(path) {
        return to_stdout(bytes);
    }
    take_place(written_beside(path, bytes)?, path)
}

/// Makes a folder and writes files into it: all of them beside their places first, so that a full disk
/// leaves what was there before.
pub(super) fn write_all(folder: &Path, files: &[(&str, Vec<u8>)]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|source| failed(folder, source))?;
    let written: Vec<(NamedTempFile, PathBuf)> = files
        .iter()
        .map(|(name, bytes)| {
            let path = folder.join(name);
            Ok((written_beside(&path, bytes)?, path))
        })
        .collect::<Result<_, Failure>>()?;
    written.into_iter().try_for_each(|(file, path)| take_place(file, &path))
}

/// A file of those bytes beside a path. It goes when it is dropped.
fn written_beside(path: &Path, bytes: &[u8]) -> Result<NamedTempFile, Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let write = || {
        let mut file = NamedTempFile::new_in(folder.unwrap_or(Path::new(".")))?;
        file.write_all(bytes)?;
        open_to_all(&file)?;
        Ok(file)
    };
    write().map_err(|source| failed(path, source))
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

/// The name a clip is called by: its file name without the ending.
pub(super) fn stem(path: &Path) -> String {
    if is_stream(path) {
        return "stdin".into();
    }
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

fn failed(path: &Path, source: io::Error) -> Failure {
    let path = if is_stream(path) { PathBuf::from("stdin") } else { path.to_owned() };
    Error::Io { path, source }.into()
}

/// A temporary file is private; what a person asked for is readable as any file they make.
#[cfg(unix)]
fn open_to_all(file: &NamedTempFile) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn open_to_all(_: &NamedTempFile) -> io::Result<()> {
    Ok(())
}
