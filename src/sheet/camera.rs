//! Camera work (カメラワーク), the CAMERA column of the sheet.

use serde::{Deserialize, Serialize};

use super::{Sheet, SpokenLine, is_default};
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
    /// Whether it is a guess from the motion of the file's camera, and no person's word.
    #[serde(rename = "guess", default, skip_serializing_if = "is_default")]
    pub is_guess: bool,
}

impl CameraWork {
    /// Returns the instruction as a line without a speaker, which takes the same place in its column.
    pub fn line(&self) -> SpokenLine {
        let Self { begin, koma, words, .. } = self.clone();
        SpokenLine { begin, koma, speaker: String::new(), words }
    }

    /// Creates a person's instruction that has the koma and the words of a line.
    pub fn from_line(line: SpokenLine) -> Self {
        Self { begin: line.begin, koma: line.koma, words: line.words, is_guess: false }
    }

    /// Returns the koma after its last one.
    pub fn past(&self) -> usize {
        self.begin.saturating_add(self.koma)
    }

    /// Adds guesses to a person's instructions. On koma where a person says something, a guess is left out.
    pub fn with_guesses(own: Vec<Self>, guesses: Vec<Self>) -> Vec<Self> {
        let mut work = own.clone();
        for guess in guesses {
            let mut from = guess.begin;
            let over = own.iter().filter(|own| own.begin < guess.past() && own.past() > from);
            let ends = over.map(|own| (own.begin, own.past())).collect::<Vec<_>>();
            for (begin, past) in ends.into_iter().chain([(guess.past(), guess.past())]) {
                if begin >= from + LEAST {
                    work.push(Self { begin: from, koma: begin - from, ..guess.clone() });
                }
                from = from.max(past);
            }
        }
        work.sort_by_key(|work| work.begin);
        work
    }
}

/// Fewest koma of a guess between a person's instructions: on fewer, nobody follows a camera.
const LEAST: usize = 3;

impl Sheet {
    /// Checks that all camera work has koma and words, lies within the cut, and is sorted by its first koma.
    pub(super) fn check_camera(&self) -> Result<(), Error> {
        let length = self.cut_length();
        for CameraWork { begin, koma, words, .. } in &self.camera {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn work(begin: usize, past: usize, words: &str, is_guess: bool) -> CameraWork {
        CameraWork { begin, koma: past - begin, words: words.into(), is_guess }
    }

    #[test]
    fn a_person_s_word_wins_where_a_guess_lies_too() {
        let own = vec![work(10, 20, "FIX", false), work(22, 30, "T.B", false)];
        let guesses = vec![work(0, 40, "PAN", true), work(50, 60, "T.U", true)];
        let all = CameraWork::with_guesses(own.clone(), guesses);
        let koma: Vec<_> = all.iter().map(|work| (work.begin, work.past(), &*work.words)).collect();
        let expected = [(0, 10, "PAN"), (10, 20, "FIX"), (22, 30, "T.B"), (30, 40, "PAN")];
        assert_eq!(koma[..4], expected, "two koma between the person's are too few");
        assert_eq!(koma[4], (50, 60, "T.U"));
        assert_eq!(CameraWork::with_guesses(own.clone(), vec![work(12, 28, "PAN", true)]), own);
    }
}
