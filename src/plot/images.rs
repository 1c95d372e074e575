//! Numbered images: a drawing each, to draw over. The settings are there in every build.

#[cfg(feature = "pictures")]
mod draw;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, knob, knobs};
use crate::motion::Camera;
use crate::plot::figure::FigureBody;
use crate::plot::shared;

/// Numbered images (連番画像): `A_0001.png` and so on, a figure a drawing, as a guide to draw over.
///
/// The number is the drawing's in the CELL column. All images have one camera, one frame and one scale,
/// so that drawings fit on each other and a way that is gone is kept.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NumberedImages {
    /// From where it is seen; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. The setting `figures.body` is that of all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Width in px, 64 to 8192; default 1280.
    pub width: u32,
    /// Height in px, 64 to 8192; default 720.
    pub height: u32,
    /// Without paper behind the figure; default no.
    pub transparent: bool,
    /// Register marks (トンボ) in the corners, the safe area, the floor and the number; default no.
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
    transparent: knob("透明", "No paper behind the figure.", "人物の後ろに紙を描かない。"),
    marks: knob(
        "トンボ",
        "Register marks, safe area, floor and number.",
        "トンボ、安全フレーム、床、番号を描く。"
    ),
    ..body
});

impl NumberedImages {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }
}
