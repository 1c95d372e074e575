//! The numbered images: one per drawing, to draw over. The settings exist in every build.

#[cfg(feature = "images")]
mod draw;
#[cfg(feature = "images")]
mod gap;

#[cfg(feature = "images")]
pub use draw::ColumnPictures;
#[cfg(feature = "images")]
pub use gap::CelGap;

use serde::{Deserialize, Serialize};

use crate::figure::FigureBody;
use crate::shared;
use genga::error::Error;
use genga::knob::{Knobs, knob, knobs};
use genga::motion::Camera;

/// Numbered images (連番画像): `A_0001.png` and so on, one figure per drawing, as a guide to draw over.
///
/// The number is the drawing's number in the CELL column. All images have one camera, one frame and one
/// scale, so that they fit on each other and movement through the world is kept.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NumberedImages {
    /// Camera of the figures; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. Set by `figures.body`, for all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Width in px, 64 to 8192; default 1280.
    pub width: u32,
    /// Height in px, 64 to 8192; default 720.
    pub height: u32,
    /// Whether the paper behind the figure is left out; default no.
    pub transparent: bool,
    /// Whether register marks (トンボ) in the corners, the safe area, the floor and the number are drawn;
    /// default no.
    pub marks: bool,
}

impl Default for NumberedImages {
    fn default() -> Self {
        Self {
            camera: Camera::Auto,
            body: FigureBody::default(),
            width: 1280,
            height: 720,
            transparent: false,
            marks: false,
        }
    }
}

knobs!(images::NumberedImages {
    camera: shared::CAMERA,
    width: shared::WIDTH.at_least(64.0).at_most(8192.0),
    height: shared::HEIGHT.at_least(64.0).at_most(8192.0),
    transparent: knob(
        "透明",
        "Whether the background is transparent, without paper.",
        "背景を透明にし、紙を描かないか。",
    ),
    marks: knob(
        "トンボ",
        "Whether register marks, safe area, floor and number are drawn.",
        "トンボ、安全フレーム、床、番号を描くか。"
    ),
    ..body
});

impl NumberedImages {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size cannot be drawn.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }
}
