//! The pictures through ffmpeg.

use std::ffi::OsStr;
use std::fs;

use super::Mp4;
use super::ffmpeg::{self, Ffmpeg};
use crate::deliver::{Cut, Sink};
use crate::error::{Error, Warning};
use crate::plot::{FigureBody, Preview};

/// What is made.
const MADE: &str = "the video";

impl Mp4 {
    /// Whether there is an ffmpeg, before any work.
    pub(in crate::deliver) fn notes(&self) -> Result<Vec<Warning>, Error> {
        ffmpeg::check(&self.ffmpeg).map(|()| Vec::new())
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
            |picture| packer.ffmpeg.feed(picture),
        )?;
        put(&cut.file("CUT.mp4"), &packer.finish()?)
    }
}

fn failed(error: std::io::Error) -> Error {
    ffmpeg::failed(MADE, error)
}

/// An ffmpeg that packs.
struct Packer {
    ffmpeg: Ffmpeg,
    /// Where the video grows: a player wants its table in front, which is known last.
    film: tempfile::NamedTempFile,
}

impl Packer {
    fn begin(mp4: &Mp4, koma_rate: f64) -> Result<Self, Error> {
        let film = tempfile::Builder::new().suffix(".mp4").tempfile().map_err(failed)?;
        let (size, rate) = (format!("{}x{}", mp4.width, mp4.height), koma_rate.to_string());
        let raw = ["-f", "rawvideo", "-pix_fmt", "rgba", "-video_size", &size, "-framerate", &rate];
        // Usual players know no other order of colours.
        let packed = ["-i", "pipe:0", "-pix_fmt", "yuv420p", "-movflags", "+faststart"];
        // One thread and no word of itself: same input, same bytes.
        let same = ["-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"];
        let words = raw.into_iter().chain(packed).chain(same).map(OsStr::new);
        let args = words.chain([film.path().as_os_str()]);
        let ffmpeg = Ffmpeg::begin(&mp4.ffmpeg, (MADE, true), args)?;
        Ok(Self { ffmpeg, film })
    }

    /// The packed video.
    fn finish(self) -> Result<Vec<u8>, Error> {
        self.ffmpeg.finish()?;
        let film = fs::read(self.film.path()).map_err(failed)?;
        if film.is_empty() {
            Err(failed(std::io::Error::other("ffmpeg made none")))
        } else {
            Ok(film)
        }
    }
}
