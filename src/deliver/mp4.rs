//! Source beside result as a video, which the system's ffmpeg packs. The settings are there in every build.

#[cfg(feature = "cli")]
mod ffmpeg;
#[cfg(feature = "cli")]
mod pack;
#[cfg(feature = "cli")]
#[cfg(test)]
mod tests;
#[cfg(feature = "cli")]
mod unpack;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, knob, knobs};
use crate::plot::Camera;

/// A video (動画ファイル): what the preview shows, larger and of the whole sheet.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mp4 {
    /// From where it is seen; default auto.
    pub camera: Camera,
    /// Width in px, 320 to 1920, an even number; default 1280.
    pub width: u32,
    /// Height in px, 200 to 1080, an even number; default 720.
    pub height: u32,
    /// The program that packs it: a name to look for, or a path; default `ffmpeg`.
    pub ffmpeg: String,
}

impl Default for Mp4 {
    fn default() -> Self {
        Self { camera: Camera::Auto, width: 1280, height: 720, ffmpeg: "ffmpeg".into() }
    }
}

knobs!(mp4::Mp4 {
    camera: knob("カメラ", "From where it is seen.", "どこから見るか。"),
    width: knob("幅", "How wide the picture is.", "画面の幅。")
        .unit("px")
        .at_least(320.0)
        .at_most(1920.0),
    height: knob("高さ", "How high the picture is.", "画面の高さ。")
        .unit("px")
        .at_least(200.0)
        .at_most(1080.0),
    ffmpeg: knob(
        "ffmpeg",
        "The program that packs the video, by name or path.",
        "動画をまとめるプログラム。名前またはパス。",
    )
    .unit("words"),
});

impl Mp4 {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn, or that no usual player shows.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()?;
        for (name, px) in [("mp4.width", self.width), ("mp4.height", self.height)] {
            if px % 2 == 1 {
                let message = format!(
                    "videos have even sides; expected {} or {}, found {px}",
                    px - 1,
                    px + 1
                );
                return Err(Error::setting(name, message));
            }
        }
        Ok(())
    }
}
