//! What is spoken (セリフ), in the S column of the sheet.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::Sheet;
use crate::error::Error;

/// A spoken line (セリフ), of the S column.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a spoken line {\"begin\", \"koma\", \"words\"}")]
pub struct SpokenLine {
    /// The koma on which it begins, from 0.
    pub begin: usize,
    /// For how many koma it is heard, at least 1.
    pub koma: usize,
    /// Who speaks; empty where that is not said.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub speaker: String,
    /// What is said.
    pub words: String,
}

/// Who says what, as it is written in the language of the words: `Ken: no`, アキ「えい！」.
impl fmt::Display for SpokenLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { speaker, words, .. } = self;
        let is_latin = words.chars().all(|letter| (letter as u32) < 0x2e80);
        match (speaker.is_empty(), is_latin) {
            (true, true) => write!(f, "{words}"),
            (false, true) => write!(f, "{speaker}: {words}"),
            (_, false) => write!(f, "{speaker}「{words}」"),
        }
    }
}

impl SpokenLine {
    /// The koma after its last.
    pub fn past(&self) -> usize {
        self.begin.saturating_add(self.koma)
    }

    /// For each of some lines the column it stands in, from 0: those that are heard at once stand side by side.
    /// The lines are in the order in which they begin.
    ///
    /// ```
    /// use genga::sheet::SpokenLine;
    ///
    /// let line = |begin, koma| SpokenLine { begin, koma, speaker: "".into(), words: "a".into() };
    /// assert_eq!(SpokenLine::side_by_side(&[line(0, 9), line(4, 9), line(9, 2)]), [0, 1, 0]);
    /// ```
    pub fn side_by_side(lines: &[Self]) -> Vec<usize> {
        let mut free: Vec<usize> = Vec::new();
        let place = |line: &Self| {
            let at = free.iter().position(|koma| *koma <= line.begin).unwrap_or(free.len());
            match free.get_mut(at) {
                Some(koma) => *koma = line.past(),
                None => free.push(line.past()),
            }
            at
        };
        lines.iter().map(place).collect()
    }
}

impl Sheet {
    /// Checks what is spoken on it.
    pub(super) fn check_lines(&self) -> Result<(), Error> {
        let length = self.length();
        for line in &self.lines {
            let (words, begin) = (&line.words, line.begin);
            if line.koma == 0 || words.trim().is_empty() {
                return Err(Error::sheet(format!(
                    "the line \"{words}\" on koma {begin} has no koma or no words; leave it out"
                )));
            }
            if line.past() > length {
                return Err(Error::sheet(format!(
                    "the line \"{words}\" ends on koma {}, and the sheet has {length}; shorten it",
                    line.past()
                )));
            }
        }
        match self.lines.windows(2).find(|pair| pair[0].begin > pair[1].begin) {
            Some(pair) => Err(Error::sheet(format!(
                "the line \"{}\" begins before the one in front of it; sort them by begin",
                pair[1].words
            ))),
            None => Ok(()),
        }
    }

    /// The same with lines of a sheet of another length: what lies beyond this one is cut off.
    pub(crate) fn with_lines(mut self, lines: &[SpokenLine]) -> Self {
        let length = self.length();
        let heard = lines.iter().filter(|line| line.begin < length);
        let cut = |line: &SpokenLine| SpokenLine {
            koma: line.koma.min(length - line.begin),
            ..line.clone()
        };
        self.lines = heard.map(cut).collect();
        self
    }
}
