//! The steps by which a clip comes to the table (段階).

use super::words::Words;

/// What is done before a clip can be shown. In a browser the page stands still for as long as one of them takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// The file is read.
    Read,
    /// Speeds are measured.
    Measure,
    /// They are smoothed and searched for turns.
    Turn,
    /// The turns of the body as a whole are found.
    TurnBody,
    /// Genga are chosen.
    Choose,
    /// The take is split into its actions.
    Split,
    /// Drawings are put between genga and left out.
    Time,
    /// The columns are laid on one another.
    Lay,
}

impl Step {
    /// In the order in which they are taken.
    pub(super) const ALL: [Self; 8] = [
        Self::Read,
        Self::Measure,
        Self::Turn,
        Self::TurnBody,
        Self::Choose,
        Self::Split,
        Self::Time,
        Self::Lay,
    ];

    /// What it is called.
    pub(super) fn words(self, words: Words) -> &'static str {
        match self {
            Self::Read => words.say("reading", "読み込み中"),
            Self::Measure => words.say("measuring", "速さを測定中"),
            Self::Turn => words.say("finding turns", "部位の変わり目を検出中"),
            Self::TurnBody => words.say("finding turns of the body", "全身の変わり目を検出中"),
            Self::Choose => words.say("choosing genga", "原画を選択中"),
            Self::Split => words.say("splitting into actions", "動作に分割中"),
            Self::Time => words.say("timing", "タイミング調整中"),
            Self::Lay => words.say("laying cels", "セルを重ね合わせ中"),
        }
    }
}
