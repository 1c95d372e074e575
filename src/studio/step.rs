//! The steps by which a clip comes to the table (段階).

use super::words::Words;

/// What is done before a clip can be shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// The file is read.
    Read,
    /// Speeds are measured, smoothed and searched for turns.
    Measure,
    /// Genga are chosen.
    Choose,
    /// Drawings are put between them and left out.
    Time,
}

impl Step {
    /// In the order in which they are taken.
    pub(super) const ALL: [Self; 4] = [Self::Read, Self::Measure, Self::Choose, Self::Time];

    /// What it is called.
    pub(super) fn words(self, words: Words) -> &'static str {
        match self {
            Self::Read => words.say("reading", "読み込み中"),
            Self::Measure => words.say("measuring", "速さを測定中"),
            Self::Choose => words.say("choosing genga", "原画を選択中"),
            Self::Time => words.say("timing", "タイミング調整中"),
        }
    }
}
