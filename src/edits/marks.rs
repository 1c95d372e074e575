//! Keys set or moved by a person.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::time::Frame;

/// A key set by a person. No later stage removes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    /// The source frame, numbered as in the file.
    pub frame: Frame,
    /// A name for the drawing, such as `left-wrist-top`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its own spacing weight, 0 ≤ w < 1; default: the recipe's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

/// A key drawn elsewhere than it was found. The chosen key nearest to `from`, within a koma, stands at `to` instead,
/// and no later stage removes it. If there is none, nothing is moved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Move {
    /// The source frame at which the key is found.
    pub from: Frame,
    /// The source frame that the key shows instead.
    pub to: Frame,
    /// A name for the drawing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its own spacing weight, as in [`Pin`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

impl Pin {
    /// Parses `150`, `150:left-wrist-top`, `150@0.5` or `150:left-wrist-top@0.5`; the number after `@` is the spacing
    /// weight.
    ///
    /// # Errors
    /// [`Error::Edits`] when the frame or the weight is not a number.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let (place, weight) = text.rsplit_once('@').map_or((text, None), |(p, w)| (p, Some(w)));
        let (frame, name) = place.split_once(':').map_or((place, None), |(f, n)| (f, Some(n)));
        let frame = frame_of(frame, "FRAME, FRAME:NAME or FRAME:NAME@WEIGHT", text)?;
        let name = name.map(str::trim).filter(|name| !name.is_empty()).map(String::from);
        let weight = weight.map(|weight| weight_of(weight, text)).transpose()?;
        Ok(Self { frame, name, weight })
    }
}

impl Move {
    /// Parses `41:42`, optionally followed by a name and a weight as in [`Pin::parse`]: `41:42:contact@0.5`.
    ///
    /// # Errors
    /// [`Error::Edits`] when one of the two is not a frame number. Otherwise as for [`Pin::parse`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        let expected = "FROM:TO, two frame numbers";
        let (from, to) = text.split_once(':').unwrap_or((text, ""));
        let from = frame_of(from, expected, text)?;
        let number = to.split([':', '@']).next().unwrap_or_default();
        frame_of(number, expected, text)?;
        let Pin { frame: to, name, weight } = Pin::parse(to)?;
        Ok(Self { from, to, name, weight })
    }

    /// Returns the key at the place where it is drawn.
    pub fn pin(&self) -> Pin {
        Pin { frame: self.to, name: self.name.clone(), weight: self.weight }
    }
}

/// Parses a frame number; the error says that `whole` should have been `expected`.
pub(super) fn frame_of(text: &str, expected: &str, whole: &str) -> Result<Frame, Error> {
    let message = || format!("expected {expected}, found \"{whole}\"");
    text.trim().parse().map(Frame).map_err(|_| Error::Edits { message: message() })
}

/// Parses a weight; its range is validated later with all others.
fn weight_of(text: &str, whole: &str) -> Result<f64, Error> {
    let message = || {
        format!(
            "expected a spacing weight, 0 to below 1, behind the @ of \"{whole}\"; a name with an @ goes into \
             a recipe file"
        )
    };
    text.trim().parse().map_err(|_| Error::Edits { message: message() })
}
