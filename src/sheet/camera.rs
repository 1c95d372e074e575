//! Camera work (カメラワーク), the CAMERA column of the sheet.

use serde::{Deserialize, Serialize};

use super::{Sheet, SpokenLine};
use crate::error::Error;

/// An instruction for the camera in the CAMERA column, such as `PAN` or `T.U`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "camera work {\"begin\", \"koma\", \"words\"}")]
pub struct CameraWork {
    /// First koma of the cut, counted from 0.
    pub begin: usize,
    /// Duration in koma, at least 1.
    pub koma: usize,
    /// The instruction.
    pub words: String,
}

impl CameraWork {
    /// Returns the instruction as a line without a speaker, which takes the same place in its column.
    pub fn line(&self) -> SpokenLine {
        let Self { begin, koma, words } = self.clone();
        SpokenLine { begin, koma, speaker: String::new(), words }
    }

    /// Creates an instruction that has the koma and the words of a line.
    pub fn from_line(line: SpokenLine) -> Self {
        Self { begin: line.begin, koma: line.koma, words: line.words }
    }
}

impl Sheet {
    /// Checks that all camera work has koma and words, lies within the cut, and is sorted by its first koma.
    pub(super) fn check_camera(&self) -> Result<(), Error> {
        let length = self.cut_length();
        for CameraWork { begin, koma, words } in &self.camera {
            if *koma == 0 || words.trim().is_empty() {
                return Err(Error::sheet(format!(
                    "the camera work \"{words}\" on koma {} has no koma or no words; leave it out",
                    begin + 1
                )));
            }
            if begin.saturating_add(*koma) > length {
                return Err(Error::sheet(format!(
                    "the camera work \"{words}\" ends after the cut, which has {length} koma; shorten it"
                )));
            }
        }
        match self.camera.is_sorted_by_key(|work| work.begin) {
            true => Ok(()),
            false => Err(Error::sheet("the camera work is not sorted by begin; sort it")),
        }
    }
}
