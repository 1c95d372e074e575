//! Keys that a person sets.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::time::Frame;

/// A key set by a person. It survives everything.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    /// The source frame, numbered as in the file.
    pub frame: Frame,
    /// A name for the drawing, such as `left-wrist-top`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its own spacing weight, 0 ≤ w < 1; the recipe's where none is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

/// A key that is drawn elsewhere than it was found. The chosen key nearest to `from`, nearer than a koma,
/// stands at `to` instead and survives everything. Where there is none, nothing is moved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Move {
    /// The source frame where it is found.
    pub from: Frame,
    /// The source frame that it shows instead.
    pub to: Frame,
    /// A name for the drawing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its own spacing weight, as of a [`Pin`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

impl Pin {
    /// A pin from `150`, `150:left-wrist-top`, `150@0.5` or `150:left-wrist-top@0.5`: what stands behind
    /// an @ is the spacing weight.
    ///
    /// # Errors
    /// [`Error::Edits`] when the part in front is not a frame number or that behind is no number.
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
    /// A move from `41:42`, and a name and a weight behind it as in [`Pin::parse`]: `41:42:contact@0.5`.
    ///
    /// # Errors
    /// [`Error::Edits`] when one of the two is not a frame number, and those of [`Pin::parse`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        let expected = "FROM:TO, two frame numbers";
        let (from, to) = text.split_once(':').unwrap_or((text, ""));
        let from = frame_of(from, expected, text)?;
        let number = to.split([':', '@']).next().unwrap_or_default();
        frame_of(number, expected, text)?;
        let Pin { frame: to, name, weight } = Pin::parse(to)?;
        Ok(Self { from, to, name, weight })
    }

    /// The key where it is drawn.
    pub fn pin(&self) -> Pin {
        Pin { frame: self.to, name: self.name.clone(), weight: self.weight }
    }
}

/// A frame's number; `expected` says what `whole` should have been.
pub(super) fn frame_of(text: &str, expected: &str, whole: &str) -> Result<Frame, Error> {
    let message = || format!("expected {expected}, found \"{whole}\"");
    text.trim().parse().map(Frame).map_err(|_| Error::Edits { message: message() })
}

/// A weight is a number here; whether it is one that spacing takes is asked with all the others.
fn weight_of(text: &str, whole: &str) -> Result<f64, Error> {
    let message = || {
        format!(
            "expected a spacing weight, 0 to below 1, behind the @ of \"{whole}\"; a name with an @ goes into \
             a recipe file"
        )
    };
    text.trim().parse().map_err(|_| Error::Edits { message: message() })
}
