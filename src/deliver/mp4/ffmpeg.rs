//! The system's ffmpeg at work: how it is begun, what it says, and that it ends.

use std::ffi::OsStr;
use std::fs;
use std::io::{Read, Seek, Write};
use std::process::{Child, Command, Stdio};

use crate::error::Error;

/// How one comes by ffmpeg.
const WAY_OUT: &str = "install it (Debian: apt install ffmpeg; macOS: brew install ffmpeg; Windows: winget install \
    ffmpeg), or say where it is with --with mp4.ffmpeg=PATH";

/// Whether there is an ffmpeg.
pub(super) fn check(program: &str) -> Result<(), Error> {
    let mut asked = Command::new(program);
    asked.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    match asked.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(unusable(&format!("\"{program}\" ended with {status}"))),
        Err(error) => Err(unusable(&format!("\"{program}\" could not be run ({error})"))),
    }
}

fn unusable(what: &str) -> Error {
    Error::setting("mp4.ffmpeg", format!("a video needs ffmpeg, and {what}: {WAY_OUT}"))
}

/// An ffmpeg at work. It ends with what drops this.
pub(super) struct Ffmpeg {
    child: Child,
    /// A file, and no pipe, which could fill up while ffmpeg waits for pictures.
    said: fs::File,
    /// What it makes, in words.
    makes: &'static str,
}

impl Ffmpeg {
    /// Begins what makes something, with what it is to do; pictures come by its pipe where it is fed.
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

    /// Gives it some bytes.
    pub(super) fn feed(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let pipe = self.child.stdin.as_mut().expect("it is fed until the end");
        match pipe.write_all(bytes) {
            Ok(()) => Ok(()),
            // It says itself why it takes no more.
            Err(error) => Err(self.complaint().unwrap_or_else(|| failed(self.makes, error))),
        }
    }

    /// Waits until it is done.
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

    /// The first line that it said.
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
