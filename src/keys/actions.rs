//! Actions (動作): the single movements of a long take, which an animator times one by one. They are no cuts (カット): a cut
//! is what the camera takes in one go, and may show several actions.

mod changes;
mod division;
mod finder;
mod lulls;

use serde::{Deserialize, Serialize};

use crate::motion::Clip;
use crate::time::{Clock, Frame};

pub use finder::ActionFinder;

/// The actions of a take: spans of frames that cover it, each frame once.
#[derive(Debug, Clone, PartialEq)]
pub struct Actions {
    first: Frame,
    past: Frame,
    /// Sorted by frame, no frame twice.
    splits: Vec<Split>,
}

/// An action (動作) of a take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Action {
    /// Its first source frame.
    pub from: Frame,
    /// The source frame after its last.
    pub past: Frame,
    /// Why it begins there; `None` for the first, which begins with the clip.
    pub why: Option<SplitReason>,
}

/// The boundary between one action and the next (区切り).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Split {
    /// The first source frame of the later action.
    pub frame: Frame,
    /// Why the take is split there.
    pub why: SplitReason,
}

/// Why a take is split at a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SplitReason {
    /// The middle of a rest (止め).
    Rest,
    /// The body is slower than before and after (緩み).
    Lull,
    /// Other parts of the body take over the movement (動きの変化).
    Change,
    /// A person asked for it (指定).
    Asked,
}

impl SplitReason {
    /// Returns its word in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Lull => "lull",
            Self::Change => "change",
            Self::Asked => "asked",
        }
    }
}

impl Actions {
    /// Splits a clip at frames inside it, in any order; of two splits at one frame the first counts.
    pub(super) fn split(clip: &Clip, mut splits: Vec<Split>) -> Self {
        splits.sort_by_key(|split| split.frame);
        splits.dedup_by_key(|split| split.frame);
        Self { first: clip.first(), past: Frame(clip.first().0 + clip.len()), splits }
    }

    /// Takes a whole clip as one action.
    pub(crate) fn whole(clip: &Clip) -> Self {
        Self::split(clip, Vec::new())
    }

    /// Returns the splits between the actions.
    pub fn splits(&self) -> &[Split] {
        &self.splits
    }

    /// Returns the actions in order; an unsplit take has a single one.
    pub fn iter(&self) -> impl Iterator<Item = Action> {
        let starts = self.splits.iter().map(|split| (split.frame, Some(split.why)));
        let pasts = self.splits.iter().map(|split| split.frame).chain([self.past]);
        let action = |((from, why), past)| Action { from, past, why };
        [(self.first, None)].into_iter().chain(starts).zip(pasts).map(action)
    }

    /// Returns the koma on which each action after the first begins: the nearest to its frame.
    pub fn koma(&self, clock: Clock) -> Vec<usize> {
        self.splits.iter().map(|split| clock.koma_from_frame(split.frame)).collect()
    }
}

#[cfg(test)]
mod tests;
