//! Splits a video into pictures with ffmpeg.

use std::ffi::{OsStr, OsString};
use std::path::Path;

use super::Mp4;
use super::ffmpeg::Ffmpeg;
use genga::error::Error;

/// Pictures per second taken from a video: the koma rate of a sheet.
const RATE: usize = 24;
/// Maximum number of seconds taken from a video, which bounds the disk space.
const SECONDS: usize = 600;

impl Mp4 {
    /// Maximum number of pictures that [`Mp4::take_apart`] makes.
    pub const MOST_PICTURES: usize = RATE * SECONDS;

    /// Splits a video into JPEG pictures in a folder, named `000001.jpg` and on. It takes 24 per second, whatever the
    /// video's rate, of the first ten minutes. No picture is wider or higher than `within`.
    ///
    /// # Errors
    /// [`Error::Setting`] with installation advice if there is no ffmpeg; [`Error::Encoding`] with ffmpeg's message.
    pub fn take_apart(
        &self,
        video: &Path,
        folder: &Path,
        within: (usize, usize),
    ) -> Result<(), Error> {
        // Without `file:`, a name with a colon would be taken for a protocol.
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
