//! The animated preview: source beside result as a GIF.
//!
//! A GIF, and not an APNG, because every mail, chat and office program plays it, where many show of an
//! APNG the first picture alone; few plain colours are also what its packing is good at. What a GIF cannot
//! is 1/24 s: its times are hundredths. A koma is 4 or 5 of them here, so that every koma begins within
//! half a hundredth of its time and nothing drifts. The settings are there in every build.

#[cfg(feature = "pictures")]
mod draw;
#[cfg(feature = "pictures")]
mod movie;
#[cfg(feature = "pictures")]
mod palette;
#[cfg(feature = "pictures")]
mod scene;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, knobs};
use crate::motion::Camera;
use crate::plot::figure::FigureBody;
use crate::plot::shared;

/// An animated preview (プレビュー): source beside result at 24 koma a second, as a GIF that repeats.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Preview {
    /// From where it is seen; default auto. It goes along with a body that goes far.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. The setting `figures.body` is that of all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Width in px, 320 to 1920; default 640.
    pub width: u32,
    /// Height in px, 200 to 1080; default 340.
    pub height: u32,
    /// Koma at most, from the first on, 1 to 10000; default 480, 20 seconds.
    pub most: usize,
}

impl Default for Preview {
    fn default() -> Self {
        Self {
            camera: Camera::Auto,
            body: FigureBody::default(),
            width: 640,
            height: 340,
            most: 480,
        }
    }
}

knobs!(preview::Preview {
    camera: shared::CAMERA,
    width: shared::WIDTH.at_least(320.0).at_most(1920.0),
    height: shared::HEIGHT.at_least(200.0).at_most(1080.0),
    // A picture of each waits in memory.
    most: shared::MOST.at_most(10_000.0),
    ..body
});

impl Preview {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn or no koma.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }
}
