//! How long a drawing stays on screen when a person decides it.

use serde::{Deserialize, Serialize};

use super::marks::frame_of;
use crate::error::Error;
use crate::time::Frame;

/// How many koma a drawing stays (止め), whatever was left out round it. The drawing that shows the frame
/// nearest to `frame`, nearer than two koma, has it; where there is none, nothing is held.
///
/// Genga stay on their koma: a hold ends at the next one at the latest, and inbetweens that it covers go. From one
/// that is shorter than it was, a drawing that was left out there comes back, else the next inbetween begins earlier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hold {
    /// The source frame that it shows.
    pub frame: Frame,
    /// Koma on screen, 1 or more.
    pub koma: usize,
}

impl Hold {
    /// A hold from `42:4`: the drawing of frame 42 stays for 4 koma.
    ///
    /// # Errors
    /// [`Error::Edits`] when one of the two is no whole number.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let expected = "FRAME:KOMA, two whole numbers";
        let (frame, koma) = text.split_once(':').unwrap_or((text, ""));
        let frame = frame_of(frame, expected, text)?;
        let message = || format!("expected {expected}, found \"{text}\"");
        let koma = koma.trim().parse().map_err(|_| Error::Edits { message: message() })?;
        Ok(Self { frame, koma })
    }
}
