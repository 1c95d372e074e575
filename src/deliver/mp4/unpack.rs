//! A video into pictures, through ffmpeg.

use std::ffi::{OsStr, OsString};
use std::path::Path;

use super::Mp4;
use super::ffmpeg::Ffmpeg;
use crate::error::Error;

/// Pictures a second that a video is taken apart into: as many as a sheet has koma.
const RATE: usize = 24;
/// Seconds that are taken at the most: the disk has an end.
const SECONDS: usize = 600;

impl Mp4 {
    /// Pictures that [`Mp4::take_apart`] makes at the most.
    pub const MOST_PICTURES: usize = RATE * SECONDS;

    /// Takes a video apart into JPEG pictures of a folder, `000001.jpg` and on: 24 a second whatever the video has, of its
    /// first ten minutes, none wider or higher than `within`.
    ///
    /// # Errors
    /// [`Error::Setting`] where there is no ffmpeg, with how to come by it, and [`Error::Encoding`] with what it says.
    pub fn take_apart(
        &self,
        video: &Path,
        folder: &Path,
        within: (usize, usize),
    ) -> Result<(), Error> {
        // A name with a colon would be taken for a protocol.
        let mut input = OsString::from("file:");
        input.push(video);
        let (wide, high) = within;
        let filter = format!(
            "fps={RATE},scale=w='min({wide},iw)':h='min({high},ih)':force_original_aspect_ratio=decrease"
        );
        let seconds = SECONDS.to_string();
        let pictures = folder.join("%06d.jpg");
        let words = ["-t", &seconds, "-an", "-sn", "-vf", &filter, "-q:v", "3"].map(OsStr::new);
        let args =
            [OsStr::new("-i"), &input].into_iter().chain(words).chain([pictures.as_os_str()]);
        Ffmpeg::begin(&self.ffmpeg, ("the pictures of a video", false), args)?.finish()
    }
}
