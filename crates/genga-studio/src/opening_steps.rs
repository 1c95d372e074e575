//! The steps of opening a clip (段階).

use super::words::Words;

/// A step before a clip can be shown. In a browser the page is blocked while a step runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// Reads the file.
    Read,
    /// Removes capture errors: movement that no body made.
    Clean,
    /// Builds the figure, the floor and their views.
    Look,
    /// Measures speeds.
    Measure,
    /// Smooths speeds and finds their turns.
    Turn,
    /// Follows how the body as a whole moves.
    Follow,
    /// Finds the turns of the body as a whole.
    TurnBody,
    /// Sums up how much is lost between any two poses.
    Compare,
    /// Chooses genga.
    Choose,
    /// Splits the take into its actions.
    Split,
    /// Puts inbetweens between the genga, and leaves some out.
    Time,
    /// Lays the columns on one another.
    Lay,
}

impl Step {
    /// All steps in order.
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

    /// Label of the step.
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
