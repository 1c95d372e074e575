//! A person's corrections. They are anchored to source frames, so that they survive a recompute.

mod camera;
mod forbidden;
mod hold;
mod layer;
mod marks;
mod over;
mod rounds;
mod speech;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::sheet::is_default;
use crate::slate::Slate;
use crate::time::Frame;

pub use camera::CameraCue;
pub use forbidden::Forbidden;
pub use hold::Hold;
pub use layer::{LayerEdits, layer_of};
pub use marks::{Move, Pin};
pub(crate) use rounds::Rounds;
pub use speech::Speech;

/// A person's corrections to the computed sheet.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Edits {
    /// Frames that are always keys.
    pub pins: Vec<Pin>,
    /// Frames at which no key may be found. The ban extends two koma around them and includes the ends of rests. Pins
    /// and moved keys stay.
    pub forbidden: Vec<Forbidden>,
    /// Keys found near one frame and drawn at another instead.
    #[serde(skip_serializing_if = "is_default")]
    pub moves: Vec<Move>,
    /// Drawings held longer or shorter than computed.
    #[serde(skip_serializing_if = "is_default")]
    pub holds: Vec<Hold>,
    /// Whether pins and moved keys are the only keys. Default: no.
    #[serde(skip_serializing_if = "is_default")]
    pub only_pins: bool,
    /// Whether every key is chosen anew around the corrections (選び直す). Default: no; each correction changes only its
    /// own neighbourhood.
    #[serde(skip_serializing_if = "is_default")]
    pub again: bool,
    /// Key frames of an earlier sheet that are kept (凍結). No others are found, whatever the settings. Pins, moves and
    /// forbidden frames correct these keys. Empty: keys are found as usual.
    #[serde(skip_serializing_if = "is_default")]
    pub frozen: Vec<Frame>,
    /// Frames at which actions (動作) begin, in place of the computed ones. Empty: actions are found.
    #[serde(skip_serializing_if = "is_default")]
    pub splits: Vec<Frame>,
    /// Spoken lines (セリフ) for the S column. They change no drawing.
    #[serde(skip_serializing_if = "is_default")]
    pub speech: Vec<Speech>,
    /// Camera work (カメラワーク) for the CAMERA column. It changes no drawing.
    #[serde(skip_serializing_if = "is_default")]
    pub camera: Vec<CameraCue>,
    /// The koma of the cut, from 1, on which the first drawing stands. Default: the first; later ones leave blank koma
    /// (カラ) before it.
    #[serde(skip_serializing_if = "is_default")]
    pub at: Option<usize>,
    /// Number of koma of the cut (尺). Default: it ends with the drawings; a longer one leaves blank koma after them.
    #[serde(skip_serializing_if = "is_default")]
    pub length: Option<usize>,
    /// Names and numbers of the cut, over those of the file name.
    #[serde(skip_serializing_if = "is_default")]
    pub slate: Slate,
    /// Corrections of single layers by name; all other corrections apply to every layer.
    #[serde(skip_serializing_if = "layer::say_nothing")]
    pub layers: BTreeMap<String, LayerEdits>,
}

impl Edits {
    /// Whether there are no corrections.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Checks the corrections against the frames of a clip.
    ///
    /// # Errors
    /// [`Error::Edits`] when a frame lies outside `first..=last` (a forbidden range: lies outside entirely), is both
    /// pinned and forbidden, is both pinned and moved, or is moved twice or onto itself; when a weight is not in [0,
    /// 1); when a drawing is held twice or for no koma; when only pins may be keys and there are none; when an action
    /// is to begin outside the clip or at the first frame, which begins one anyway; and when a spoken line lies outside
    /// or has no words.
    ///
    /// ```
    /// use genga::edits::{Edits, Pin};
    /// use genga::time::Frame;
    ///
    /// let edits = Edits { pins: vec![Pin::parse("42:contact@0.5")?], ..Edits::default() };
    /// edits.validate(Frame(0), Frame(91))?;
    /// let error = edits.validate(Frame(0), Frame(41)).unwrap_err();
    /// assert!(error.to_string().contains("pinned frame 42 is not in the clip"));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn validate(&self, first: Frame, last: Frame) -> Result<(), Error> {
        let clip = Frames { first, last };
        self.check(clip)?;
        self.layers.keys().try_for_each(|name| self.of_layer(name).check(clip))?;
        if self.only_pins && !self.have_pins() {
            return wrong("pins are to be the only keys, and there is no pin: pin a frame");
        }
        if self.again && self.freeze() {
            return wrong(
                "keys are frozen and to be chosen again at once: take one of the two back",
            );
        }
        Ok(())
    }

    fn have_pins(&self) -> bool {
        let of_layer = |edits: &LayerEdits| !(edits.pins.is_empty() && edits.moves.is_empty());
        let of_all = !(self.pins.is_empty() && self.moves.is_empty());
        of_all || self.layers.values().any(of_layer)
    }

    /// Whether any layer keeps keys of an earlier sheet.
    pub fn freeze(&self) -> bool {
        let is_frozen = |own: &LayerEdits| !own.frozen.is_empty();
        !self.frozen.is_empty() || self.layers.values().any(is_frozen)
    }

    fn check(&self, clip: Frames) -> Result<(), Error> {
        self.pins.iter().try_for_each(|pin| self.check_pin(pin, clip))?;
        self.forbidden.iter().try_for_each(|forbidden| check_forbidden(*forbidden, clip))?;
        for (at, moved) in self.moves.iter().enumerate() {
            self.check_move(moved, &self.moves[..at], clip)?;
        }
        for (at, hold) in self.holds.iter().enumerate() {
            check_hold(*hold, &self.holds[..at], clip)?;
        }
        if let Some(outside) = self.frozen.iter().find(|frame| !clip.has(**frame)) {
            return wrong(format!(
                "frozen frame {outside} is not in the clip, which has frames {clip}"
            ));
        }
        self.slate.validate()?;
        self.splits.iter().try_for_each(|split| check_split(*split, clip))?;
        self.camera.iter().try_for_each(|cue| check_cue(cue, clip))?;
        self.speech.iter().try_for_each(|line| check_speech(line, clip))
    }

    fn check_pin(&self, pin: &Pin, clip: Frames) -> Result<(), Error> {
        let frame = pin.frame;
        if !clip.has(frame) {
            wrong(format!("pinned frame {frame} is not in the clip, which has frames {clip}"))
        } else if self.forbids(frame) {
            wrong(format!("frame {frame} is pinned and forbidden at once"))
        } else {
            check_weight("pinned", pin)
        }
    }

    fn check_move(&self, moved: &Move, before: &[Move], clip: Frames) -> Result<(), Error> {
        let Move { from, to, .. } = *moved;
        if let Some(outside) = [from, to].into_iter().find(|frame| !clip.has(*frame)) {
            wrong(format!(
                "frame {outside} of the move {from}:{to} is not in the clip, which has frames {clip}"
            ))
        } else if from == to {
            wrong(format!("the key at frame {from} is moved to where it is; to keep it, pin it"))
        } else if before.iter().any(|other| other.from == from) {
            wrong(format!("the key at frame {from} is moved twice: move it once"))
        } else if self.pins.iter().any(|pin| pin.frame == from) {
            wrong(format!("frame {from} is pinned and moved at once: pin {to} instead"))
        } else if self.forbids(to) {
            wrong(format!("frame {to} is forbidden, and a key is moved there"))
        } else {
            check_weight("moved-to", &moved.pin())
        }
    }

    /// Whether this very frame is forbidden. A pin within a forbidden range is an allowed exception.
    fn forbids(&self, frame: Frame) -> bool {
        self.forbidden.contains(&Forbidden::one(frame))
    }
}

fn check_forbidden(forbidden: Forbidden, clip: Frames) -> Result<(), Error> {
    let Forbidden { from, past } = forbidden;
    if from >= past {
        return wrong(format!("the forbidden range {forbidden} has no frame in it"));
    }
    if from > clip.last || past <= clip.first {
        let be = if forbidden.is_one() { "frame" } else { "range" };
        return wrong(format!(
            "forbidden {be} {forbidden} is not in the clip, which has frames {clip}"
        ));
    }
    Ok(())
}

fn check_hold(hold: Hold, before: &[Hold], clip: Frames) -> Result<(), Error> {
    let Hold { frame, koma } = hold;
    if !clip.has(frame) {
        wrong(format!("held frame {frame} is not in the clip, which has frames {clip}"))
    } else if koma == 0 {
        wrong(format!("the drawing of frame {frame} is held for 0 koma: 1 at the least"))
    } else if before.iter().any(|other| other.frame == frame) {
        wrong(format!("the drawing of frame {frame} is held twice: hold it once"))
    } else {
        Ok(())
    }
}

fn check_split(split: Frame, clip: Frames) -> Result<(), Error> {
    if split == clip.first {
        return wrong(format!(
            "an action begins at frame {split} anyway, the clip's first: leave it out"
        ));
    }
    if !clip.has(split) {
        return wrong(format!(
            "frame {split}, with which an action is to begin, is not in the clip, which has frames {clip}"
        ));
    }
    Ok(())
}

fn check_speech(line: &Speech, clip: Frames) -> Result<(), Error> {
    if let Some(fault) = line.fault() {
        return wrong(fault);
    }
    let Speech { from, past, .. } = *line;
    if from > clip.last || past <= clip.first {
        return wrong(format!(
            "the line {from}..{past} is not in the clip, which has frames {clip}"
        ));
    }
    Ok(())
}

fn check_cue(cue: &CameraCue, clip: Frames) -> Result<(), Error> {
    if let Some(fault) = cue.fault() {
        return wrong(fault);
    }
    let [from, past] = cue.frames;
    if from > clip.last || past <= clip.first {
        let text = &cue.text;
        return wrong(format!(
            "the camera work \"{text}\" is not in the clip, which has frames {clip}"
        ));
    }
    Ok(())
}

fn check_weight(what: &str, pin: &Pin) -> Result<(), Error> {
    let frame = pin.frame;
    match pin.weight.is_some_and(|weight| !(0.0..1.0).contains(&weight)) {
        false => Ok(()),
        true => wrong(format!("the weight of {what} frame {frame} must be at least 0 and below 1")),
    }
}

fn wrong(message: impl Into<String>) -> Result<(), Error> {
    Err(Error::Edits { message: message.into() })
}

/// The frames of a clip, including the last.
#[derive(Debug, Clone, Copy)]
struct Frames {
    first: Frame,
    last: Frame,
}

impl Frames {
    fn has(self, frame: Frame) -> bool {
        (self.first..=self.last).contains(&frame)
    }
}

impl std::fmt::Display for Frames {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} to {}", self.first, self.last)
    }
}

#[cfg(test)]
mod tests;
