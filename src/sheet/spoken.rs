//! Spoken lines (セリフ), the S column of the sheet.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::Sheet;
use crate::error::Error;

/// A spoken line (セリフ) in the S column.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a spoken line {\"begin\", \"koma\", \"words\"}")]
pub struct SpokenLine {
    /// First koma, counted from 0.
    pub begin: usize,
    /// Duration in koma, at least 1.
    pub koma: usize,
    /// Name of the speaker; empty if unknown.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub speaker: String,
    /// The spoken text.
    pub words: String,
}

/// Formats speaker and text in the style of the text's language: `Ken: no`, アキ「えい！」.
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
    /// Returns the koma after the last one of the line.
    pub fn past(&self) -> usize {
        self.begin.saturating_add(self.koma)
    }

    /// Assigns each line a column, counted from 0, so that simultaneous lines are side by side. The lines must be
    /// sorted by their first koma.
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
    /// Checks that each line has koma and text, ends within the sheet, and begins no earlier than the line before.
    pub(super) fn check_lines(&self) -> Result<(), Error> {
        let length = self.cut_length();
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

    /// Replaces the lines of the sheet, cutting off whatever lies beyond its end.
    pub fn with_lines(mut self, lines: &[SpokenLine]) -> Self {
        let length = self.cut_length();
        let heard = lines.iter().filter(|line| line.begin < length);
        let cut = |line: &SpokenLine| SpokenLine {
            koma: line.koma.min(length - line.begin),
            ..line.clone()
        };
        self.lines = heard.map(cut).collect();
        self
    }
}
