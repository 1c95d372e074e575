//! Encodes the preview's pictures as a video through ffmpeg.

use std::ffi::OsStr;
use std::fs;

use super::Mp4;
use super::ffmpeg::{self, Ffmpeg};
use genga::error::{Error, Warning};
use genga_plot::{FigureBody, Preview, SideBySide};

/// The product, as named in errors.
const MADE: &str = "the video";

/// Flat colours gain little from a slow search: x264 takes half the time, and its file is 3 % larger.
const FAST: [&str; 4] = ["-c:v", "libx264", "-preset", "veryfast"];

impl Mp4 {
    /// Checks before any work is done that ffmpeg is there, and says if there is no font.
    pub(crate) fn notes(&self) -> Result<Vec<Warning>, Error> {
        ffmpeg::check(&self.ffmpeg).map(|()| genga_plot::font_note().into_iter().collect())
    }

    /// Draws the pictures of what stands side by side, and encodes them as a video.
    pub(crate) fn encode(
        &self,
        body: FigureBody,
        cut: &str,
        shown: &SideBySide<'_>,
    ) -> Result<Vec<u8>, Error> {
        self.validate()?;
        let mut packer = Packer::begin(self, shown.koma_rate())?;
        let (camera, width, height) = (self.camera, self.width, self.height);
        Preview { camera, body, width, height, ..Preview::default() }.play(
            cut,
            shown,
            |picture| packer.ffmpeg.feed(picture),
        )?;
        packer.finish()
    }
}

fn failed(error: std::io::Error) -> Error {
    ffmpeg::failed(MADE, error)
}

/// An ffmpeg that encodes a video.
struct Packer {
    ffmpeg: Ffmpeg,
    /// The growing video. It must be seekable, because `+faststart` finally moves the index to the front.
    film: tempfile::NamedTempFile,
}

impl Packer {
    fn begin(mp4: &Mp4, koma_rate: f64) -> Result<Self, Error> {
        let film = tempfile::Builder::new().suffix(".mp4").tempfile().map_err(failed)?;
        let (size, rate) = (format!("{}x{}", mp4.width, mp4.height), koma_rate.to_string());
        let raw = ["-f", "rawvideo", "-pix_fmt", "rgba", "-video_size", &size, "-framerate", &rate];
        // Common players support no other pixel format.
        let packed = ["-i", "pipe:0", "-pix_fmt", "yuv420p", "-movflags", "+faststart"];
        // A fixed number of threads and no version tags, so that the same input gives the same bytes on any machine.
        let same = ["-threads", "2", "-fflags", "+bitexact", "-flags:v", "+bitexact"];
        let fast = if ffmpeg::encodes_with(&mp4.ffmpeg, "libx264") { &FAST[..] } else { &[] };
        let words = raw.into_iter().chain(packed).chain(same).chain(fast.iter().copied());
        let words = words.map(OsStr::new);
        let args = words.chain([film.path().as_os_str()]);
        let ffmpeg = Ffmpeg::begin(&mp4.ffmpeg, (MADE, true), args)?;
        Ok(Self { ffmpeg, film })
    }

    /// Waits for ffmpeg and returns the video.
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
