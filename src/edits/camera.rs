//! A person's camera work (カメラワーク) for the CAMERA column, anchored to source frames.

use serde::{Deserialize, Serialize};

use super::Speech;
use crate::sheet::CameraWork;
use crate::time::{Clock, Frame};

/// An instruction for the camera over some source frames.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraCue {
    /// The first source frame, and the one after the last.
    pub frames: [Frame; 2],
    /// The instruction, such as `PAN`.
    pub text: String,
}

impl CameraCue {
    /// Returns the koma on which the instruction stands; `None` for an empty sheet.
    pub fn on_sheet(&self, clock: Clock, last: Frame, length: usize) -> Option<CameraWork> {
        self.speech().on_sheet(clock, last, length).map(CameraWork::from_line)
    }

    /// The same as a spoken line, which stands on the same koma.
    pub(crate) fn speech(&self) -> Speech {
        let [from, past] = self.frames;
        Speech { from, past, speaker: String::new(), words: self.text.clone() }
    }

    /// Describes what is wrong with the cue, if anything.
    pub(super) fn fault(&self) -> Option<String> {
        self.speech().fault().map(|fault| fault.replacen("the line", "the camera work", 1))
    }
}
