//! The steps by which a clip comes to the table (段階).

use super::words::Words;

/// What is done before a clip can be shown. In a browser the page stands still for as long as one of them takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// The file is read.
    Read,
    /// What no body did is taken out of it.
    Clean,
    /// The figure, the floor and the views of it are made.
    Look,
    /// Speeds are measured.
    Measure,
    /// They are smoothed and searched for turns.
    Turn,
    /// All that moves in the body is followed.
    Follow,
    /// The turns of the body as a whole are found.
    TurnBody,
    /// What is lost between poses is summed up.
    Compare,
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
    pub(super) const ALL: [Self; 12] = [
        Self::Read,
        Self::Clean,
        Self::Look,
        Self::Measure,
        Self::Turn,
        Self::Follow,
        Self::TurnBody,
        Self::Compare,
        Self::Choose,
        Self::Split,
        Self::Time,
        Self::Lay,
    ];

    /// What it is called.
    pub(super) fn words(self, words: Words) -> &'static str {
        match self {
            Self::Read => words.say("reading", "読み込み中"),
            Self::Clean => words.say("cleaning", "計測ミスを除去中"),
            Self::Look => words.say("making the figure", "人物を組み立て中"),
            Self::Measure => words.say("measuring", "速さを測定中"),
            Self::Turn => words.say("finding turns", "部位の変わり目を検出中"),
            Self::Follow => words.say("following the body", "全身の動きを追跡中"),
            Self::TurnBody => words.say("finding turns of the body", "全身の変わり目を検出中"),
            Self::Compare => words.say("comparing poses", "ポーズを比較中"),
            Self::Choose => words.say("choosing genga", "原画を選択中"),
            Self::Split => words.say("splitting into actions", "動作に分割中"),
            Self::Time => words.say("timing", "タイミング調整中"),
            Self::Lay => words.say("laying cels", "セルを重ね合わせ中"),
        }
    }
}
