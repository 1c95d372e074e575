//! The pictures through ffmpeg.

use std::fs;
use std::io::{Read, Seek, Write};
use std::process::{Child, Command, Stdio};

use super::Mp4;
use crate::deliver::{Cut, Sink};
use crate::error::{Error, Warning};
use crate::plot::{FigureBody, Preview};

/// How one comes by ffmpeg.
const WAY_OUT: &str = "install it (Debian: apt install ffmpeg; macOS: brew install ffmpeg; Windows: winget install \
    ffmpeg), or say where it is with --with mp4.ffmpeg=PATH";

impl Mp4 {
    /// Whether there is an ffmpeg, before any work.
    pub(in crate::deliver) fn notes(&self) -> Result<Vec<Warning>, Error> {
        let mut asked = Command::new(&self.ffmpeg);
        asked.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        match asked.status() {
            Ok(status) if status.success() => Ok(Vec::new()),
            Ok(status) => Err(self.unusable(&format!("\"{}\" ended with {status}", self.ffmpeg))),
            Err(error) => {
                Err(self.unusable(&format!("\"{}\" could not be run ({error})", self.ffmpeg)))
            }
        }
    }

    /// Draws the pictures and has them packed.
    pub(in crate::deliver) fn write(
        &self,
        body: FigureBody,
        cut: &Cut<'_>,
        put: &mut Sink<'_>,
    ) -> Result<(), Error> {
        self.validate()?;
        let mut packer = Packer::begin(self, cut.sheet.clock.koma_rate)?;
        let (camera, width, height) = (self.camera, self.width, self.height);
        Preview { camera, body, width, height, ..Preview::default() }.play(
            cut.name,
            cut.clip,
            cut.sheet,
            |picture| packer.show(picture),
        )?;
        put(&cut.file("CUT.mp4"), &packer.finish()?)
    }

    fn unusable(&self, what: &str) -> Error {
        Error::setting("mp4.ffmpeg", format!("a video needs ffmpeg, and {what}: {WAY_OUT}"))
    }
}

/// An ffmpeg at work. It ends with what drops this.
struct Packer {
    child: Child,
    /// Where the video grows: a player wants its table in front, which is known last.
    film: tempfile::NamedTempFile,
    /// A file, and no pipe, which could fill up while ffmpeg waits for pictures.
    said: fs::File,
}

impl Packer {
    fn begin(mp4: &Mp4, koma_rate: f64) -> Result<Self, Error> {
        let film = tempfile::Builder::new().suffix(".mp4").tempfile().map_err(failed)?;
        let said = tempfile::tempfile().map_err(failed)?;
        let child = Command::new(&mp4.ffmpeg)
            .args(["-y", "-nostdin", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgba"])
            .args(["-video_size", &format!("{}x{}", mp4.width, mp4.height)])
            .args(["-framerate", &koma_rate.to_string(), "-i", "pipe:0"])
            // Usual players know no other order of colours.
            .args(["-pix_fmt", "yuv420p", "-movflags", "+faststart"])
            // One thread and no word of itself: same input, same bytes.
            .args(["-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"])
            .arg(film.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(said.try_clone().map_err(failed)?)
            .spawn()
            .map_err(|error| {
                mp4.unusable(&format!("\"{}\" could not be run ({error})", mp4.ffmpeg))
            })?;
        Ok(Self { child, film, said })
    }

    fn show(&mut self, picture: &[u8]) -> Result<(), Error> {
        let pipe = self.child.stdin.as_mut().expect("it is piped until the end");
        match pipe.write_all(picture) {
            Ok(()) => Ok(()),
            // It says itself why it takes no more.
            Err(error) => Err(self.complaint().unwrap_or_else(|| failed(error))),
        }
    }

    /// The packed video.
    fn finish(mut self) -> Result<Vec<u8>, Error> {
        drop(self.child.stdin.take());
        let status = self.child.wait().map_err(failed)?;
        if !status.success() {
            let other = || failed(std::io::Error::other(format!("ffmpeg ended with {status}")));
            return Err(self.complaint().unwrap_or_else(other));
        }
        let film = fs::read(self.film.path()).map_err(failed)?;
        if film.is_empty() {
            Err(failed(std::io::Error::other("ffmpeg made none")))
        } else {
            Ok(film)
        }
    }

    /// The first line that ffmpeg said.
    fn complaint(&mut self) -> Option<Error> {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
        let mut words = String::new();
        self.said.rewind().ok()?;
        self.said.read_to_string(&mut words).ok()?;
        let line = words.lines().find(|line| !line.trim().is_empty())?;
        Some(failed(std::io::Error::other(format!("ffmpeg says: {line}"))))
    }
}

impl Drop for Packer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn failed(error: std::io::Error) -> Error {
    Error::Encoding { what: "the video", source: error.into() }
}
