//! A running ffmpeg: starts it, feeds it, collects its error messages and makes sure it ends.

use std::ffi::OsStr;
use std::fs;
use std::io::{Read, Seek, Write};
use std::process::{Child, Command, Stdio};

use genga::error::Error;

/// Installation advice, appended to errors.
const WAY_OUT: &str = "install it (Debian: apt install ffmpeg; macOS: brew install ffmpeg; Windows: winget install \
    ffmpeg), or say where it is with --with mp4.ffmpeg=PATH";

/// Checks that ffmpeg can be run.
pub(super) fn check(program: &str) -> Result<(), Error> {
    let mut asked = Command::new(program);
    asked.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    match asked.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(unusable(&format!("\"{program}\" ended with {status}"))),
        Err(error) => Err(unusable(&format!("\"{program}\" could not be run ({error})"))),
    }
}

/// Whether ffmpeg was built with an encoder.
pub(super) fn encodes_with(program: &str, encoder: &str) -> bool {
    let mut asked = Command::new(program);
    asked.args(["-hide_banner", "-encoders"]).stdin(Stdio::null()).stderr(Stdio::null());
    let listed = asked.output().map(|output| output.stdout).unwrap_or_default();
    // A row is flags, name, description.
    let listed = String::from_utf8_lossy(&listed);
    listed.lines().any(|row| row.split_whitespace().nth(1) == Some(encoder))
}

fn unusable(what: &str) -> Error {
    Error::setting("mp4.ffmpeg", format!("a video needs ffmpeg, and {what}: {WAY_OUT}"))
}

/// A running ffmpeg process, killed on drop.
pub(super) struct Ffmpeg {
    child: Child,
    /// Its stderr. A file rather than a pipe, because a pipe could fill up while ffmpeg waits for pictures.
    said: fs::File,
    /// Its product, named in errors.
    makes: &'static str,
}

impl Ffmpeg {
    /// Starts ffmpeg with the given arguments. `makes` names its product; pictures come through its stdin if `is_fed`.
    pub(super) fn begin<'a>(
        program: &str,
        (makes, is_fed): (&'static str, bool),
        args: impl IntoIterator<Item = &'a OsStr>,
    ) -> Result<Self, Error> {
        let failed = |error| failed(makes, error);
        let said = tempfile::tempfile().map_err(failed)?;
        let child = Command::new(program)
            .args(["-y", "-nostdin", "-loglevel", "error"])
            .args(args)
            .stdin(if is_fed { Stdio::piped() } else { Stdio::null() })
            .stdout(Stdio::null())
            .stderr(said.try_clone().map_err(failed)?)
            .spawn()
            .map_err(|error| unusable(&format!("\"{program}\" could not be run ({error})")))?;
        Ok(Self { child, said, makes })
    }

    /// Writes bytes to its stdin.
    pub(super) fn feed(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let pipe = self.child.stdin.as_mut().expect("it is fed until the end");
        match pipe.write_all(bytes) {
            Ok(()) => Ok(()),
            // Its own message says why it takes no more.
            Err(error) => Err(self.complaint().unwrap_or_else(|| failed(self.makes, error))),
        }
    }

    /// Closes its stdin and waits until it exits.
    pub(super) fn finish(mut self) -> Result<(), Error> {
        drop(self.child.stdin.take());
        let status = self.child.wait().map_err(|error| failed(self.makes, error))?;
        if status.success() {
            return Ok(());
        }
        let makes = self.makes;
        let other = || failed(makes, std::io::Error::other(format!("ffmpeg ended with {status}")));
        Err(self.complaint().unwrap_or_else(other))
    }

    /// An error with the first line that it printed; `None` if it printed nothing.
    fn complaint(&mut self) -> Option<Error> {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
        let mut words = String::new();
        self.said.rewind().ok()?;
        self.said.read_to_string(&mut words).ok()?;
        let line = words.lines().find(|line| !line.trim().is_empty())?;
        Some(failed(self.makes, std::io::Error::other(format!("ffmpeg says: {line}"))))
    }
}

impl Drop for Ffmpeg {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub(super) fn failed(what: &'static str, error: std::io::Error) -> Error {
    Error::Encoding { what, source: error.into() }
}
