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
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut file = NamedTempFile::new_in(folder.unwrap_or(Path::new(".")))
        .map_err(|source| failed(path, source))?;
    file.write_all(bytes).map_err(|source| failed(path, source))?;
    open_to_all(&file).map_err(|source| failed(path, source))?;
    file.persist(path).map_err(|error| failed(path, error.error))?;
    Ok(())
}

/// Makes a folder and writes files into it. Everything is made before the first is written.
pub(super) fn write_all(folder: &Path, files: &[(&str, Vec<u8>)]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|source| failed(folder, source))?;
    files.iter().try_for_each(|(name, bytes)| write(&folder.join(name), bytes))
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
