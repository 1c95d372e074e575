//! Drawings whose time on screen a person decides.

use serde::{Deserialize, Serialize};

use super::marks::frame_of;
use crate::error::Error;
use crate::time::Frame;

/// The number of koma that a drawing stays (止め), whatever was left out around it. It applies to the drawing that shows
/// the frame nearest to `frame`, within two koma; if there is none, nothing is held.
///
/// Genga stay on their koma: a hold ends at the next genga at the latest, and removes the inbetweens it covers. After a
/// hold that shortens a drawing, an omitted drawing comes back, or else the next inbetween begins earlier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hold {
    /// The source frame of the drawing.
    pub frame: Frame,
    /// Koma on screen, 1 or more.
    pub koma: usize,
}

impl Hold {
    /// Parses a hold: `42:4` keeps the drawing of frame 42 for 4 koma.
    ///
    /// # Errors
    /// [`Error::Edits`] when one of the two is not a whole number.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let expected = "FRAME:KOMA, two whole numbers";
        let (frame, koma) = text.split_once(':').unwrap_or((text, ""));
        let frame = frame_of(frame, expected, text)?;
        let message = || format!("expected {expected}, found \"{text}\"");
        let koma = koma.trim().parse().map_err(|_| Error::Edits { message: message() })?;
        Ok(Self { frame, koma })
    }
}
