//! The animated preview: source beside result, or two versions of a take, as a GIF.
//!
//! The format is GIF rather than APNG, because every mail, chat and office program plays it, while many show
//! only the first picture of an APNG. It also compresses a few plain colours well. A GIF cannot express 1/24
//! s, since its times are hundredths of a second. A koma therefore lasts 4 or 5 hundredths: every koma begins
//! within half a hundredth of its time, and nothing drifts.
//!
//! The settings exist in every build.

#[cfg(feature = "pictures")]
mod ahead;
#[cfg(feature = "pictures")]
mod backdrop;
#[cfg(feature = "pictures")]
mod draw;
#[cfg(feature = "pictures")]
mod movie;
#[cfg(feature = "pictures")]
mod palette;
#[cfg(feature = "pictures")]
mod scene;

use serde::{Deserialize, Serialize};

use crate::figure::FigureBody;
use crate::shared;
use genga::error::Error;
use genga::knob::{Knobs, knobs};
use genga::motion::Camera;

/// An animated preview (プレビュー): what stands side by side at 24 koma a second, as a GIF that repeats.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Preview {
    /// Camera of the figures; default auto. It follows a body that goes far.
    pub camera: Camera,
    /// How figures are drawn; default mannequin. Set by `figures.body`, for all pictures.
    #[serde(skip)]
    pub body: FigureBody,
    /// Width in px, 320 to 1920; default 640.
    pub width: u32,
    /// Height in px, 200 to 1080; default 340.
    pub height: u32,
    /// Maximum number of koma, counted from the first, 1 to 10000; default 480, 20 seconds.
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
    // A picture of each koma is held in memory.
    most: shared::MOST.at_most(10_000.0),
    ..body
});

impl Preview {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size cannot be drawn or the number of koma is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }
}
