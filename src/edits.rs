//! A person's corrections. They are anchored to source frames, so that a recompute keeps them.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::time::Frame;

/// What a person wants in spite of what was found.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Edits {
    /// Frames that are keys whatever is found.
    pub pins: Vec<Pin>,
    /// Frames near which no key may be found: one nearer than a koma goes.
    pub forbidden: Vec<Frame>,
}

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

impl Edits {
    /// Whether there is nothing to correct.
    pub fn is_empty(&self) -> bool {
        self.pins.is_empty() && self.forbidden.is_empty()
    }

    /// Checks the corrections against the frames of a clip.
    ///
    /// # Errors
    /// [`Error::Edits`] when a pin lies outside `first..=last`, is forbidden at the same time, or
    /// has a weight that is not in [0, 1).
    pub fn validate(&self, first: Frame, last: Frame) -> Result<(), Error> {
        for pin in &self.pins {
            let frame = pin.frame;
            let wrong = if frame < first || frame > last {
                format!(
                    "pinned frame {frame} is not in the clip, which has frames {first} to {last}"
                )
            } else if self.forbidden.contains(&frame) {
                format!("frame {frame} is pinned and forbidden at once")
            } else if pin.weight.is_some_and(|weight| !(0.0..1.0).contains(&weight)) {
                format!("the weight of pinned frame {frame} must be at least 0 and below 1")
            } else {
                continue;
            };
            return Err(Error::Edits { message: wrong });
        }
        Ok(())
    }
}

impl Pin {
    /// A pin from `150` or `150:left-wrist-top`.
    ///
    /// # Errors
    /// [`Error::Edits`] when the part before the colon is not a frame number.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let (frame, name) = text.split_once(':').map_or((text, None), |(f, n)| (f, Some(n)));
        let frame = frame.trim().parse().map(Frame).map_err(|_| Error::Edits {
            message: format!("expected a frame number or frame:name, found \"{text}\""),
        })?;
        let name = name.map(str::trim).filter(|name| !name.is_empty()).map(String::from);
        Ok(Self { frame, name, weight: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pin_must_lie_in_the_clip_and_not_be_forbidden() {
        let edits = |text: &str, forbidden: &[usize], weight| Edits {
            pins: vec![Pin { weight, ..Pin::parse(text).unwrap() }],
            forbidden: forbidden.iter().copied().map(Frame).collect(),
        };
        let check = |edits: Edits| edits.validate(Frame(5), Frame(9)).is_ok();
        assert!(check(edits("5", &[], None)) && check(edits("9", &[8], Some(0.0))));
        assert!(!check(edits("4", &[], None)));
        assert!(!check(edits("10", &[], None)));
        assert!(!check(edits("7", &[7], None)));
        assert!(!check(edits("7", &[], Some(1.0))));
        assert!(!check(edits("7", &[], Some(-0.1))));
    }

    #[test]
    fn a_pin_is_written_as_frame_and_name() {
        let pin = Pin::parse("150: left-wrist-top").unwrap();
        assert_eq!((pin.frame, pin.name.as_deref()), (Frame(150), Some("left-wrist-top")));
        assert_eq!(Pin::parse("12").unwrap().name, None);
        assert_eq!(Pin::parse("12: ").unwrap().name, None, "an empty name is none");
        assert!(Pin::parse("twelve").is_err());
    }
}
