//! Source beside result as a video, encoded by the system's ffmpeg. The settings exist in every build.

#[cfg(feature = "video")]
mod ffmpeg;
#[cfg(feature = "video")]
mod pack;
#[cfg(feature = "video")]
#[cfg(test)]
mod tests;
#[cfg(feature = "video")]
mod unpack;

use serde::{Deserialize, Serialize};

use genga::error::Error;
use genga::knob::{Knobs, knob, knobs};
use genga_plot::Camera;

/// A video (動画ファイル): the content of the preview, larger and of the whole sheet.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mp4 {
    /// Camera of the video; default auto.
    pub camera: Camera,
    /// Width in px, 320 to 1920, an even number; default 1280.
    pub width: u32,
    /// Height in px, 200 to 1080, an even number; default 720.
    pub height: u32,
    /// The ffmpeg program, as a name or a path; default `ffmpeg`.
    pub ffmpeg: String,
}

impl Default for Mp4 {
    fn default() -> Self {
        Self { camera: Camera::Auto, width: 1280, height: 720, ffmpeg: "ffmpeg".into() }
    }
}

knobs!(mp4::Mp4 {
    camera: knob("カメラ", "Camera of the figures.", "人物を見るカメラ。"),
    width: knob("幅", "Width of the video.", "画面の幅。")
        .unit("px")
        .at_least(320.0)
        .at_most(1920.0),
    height: knob("高さ", "Height of the video.", "画面の高さ。")
        .unit("px")
        .at_least(200.0)
        .at_most(1080.0),
    ffmpeg: knob(
        "ffmpeg",
        "Program that encodes the video, by name or path.",
        "動画をエンコードするプログラム。名前またはパス。",
    )
    .unit("words"),
});

impl Mp4 {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size is out of its range, or odd, which common players cannot show.
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
