//! **Choose** (選ぶ): from the turns of joints to the keys (原画) and walls (壁) of a layer.
//!
//! The filter, the sign pattern and the persistence pick the turns of the body ([`BodyTurns`]). They are cheap; what lies
//! between them is dear. [`Choose`] takes the set that loses least at that price. For studies joints may pick instead: they
//! vote, their speeds are added, or any joint's turn is a candidate.

mod acting;
mod actions;
mod alike;
mod body;
mod bridge;
mod cheapest;
mod choice;
mod choose;
mod chords;
mod contact;
mod correct;
mod drawn_body;
mod layers;
mod local;
mod matching;
mod merge;
mod peaks;
mod points;
mod postures;
mod reconstruction;
mod reference;
mod rest;
mod stillness;
mod sum;
mod vote;
mod voters;
mod walk;
mod weights;

use std::ops::RangeInclusive;

use crate::motion::JointId;
use crate::sheet::Reason;
use crate::time::Frame;

pub use actions::{Action, ActionFinder, Actions, Split, SplitReason};
pub use alike::Alike;
pub use body::BodyTurns;
pub(crate) use body::{BodySpeeds, LayerMotion, Tracks, drawn};
pub(crate) use bridge::Bridge;
pub(crate) use choice::{Choice, Picked};
pub(crate) use choose::Picks;
pub use choose::{Choose, Fill, Judges, Merge, Rank};
pub use chords::Chords;
pub use contact::AtContacts;
pub(crate) use contact::contact_ends;
pub use drawn_body::DrawnBody;
pub(crate) use layers::LayerClip;
pub use layers::{LayerJoints, Layers, NamedLayer};
pub(crate) use local::{Chosen, Word};
pub use matching::Matching;
pub use merge::JointTurns;
pub use reconstruction::Reconstruction;
pub(crate) use reconstruction::with_ends;
pub use reference::Reference;
pub use rest::AtRests;
pub(crate) use rest::{rest_frames, rests};
pub use voters::weights;
pub use walk::{AtGaits, Phase, Walk, WalkStep};
pub use weights::JointWeights;

/// A key (原画) of a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// The source frame it shows.
    pub frame: Frame,
    /// How much of a turn it is, 0 to 1; a share of all weight for votes, the prominence of its valley for `sum`.
    pub strength: f64,
    /// What it saves, in % of body height: the error that its neighbours would leave without it, spread
    /// over an eighth of a second. Infinite for keys that may not go.
    pub price: f64,
    /// Joints that have a turn of their own here.
    pub voters: Vec<JointId>,
    /// Its own spacing weight, where a person gave one.
    pub weight: Option<f64>,
    /// The name a person gave it.
    pub name: Option<String>,
    /// Where it comes from.
    pub origin: Origin,
}

impl Key {
    /// A frame that a person wants to be a key, without a name.
    pub(crate) fn set(frame: Frame) -> Self {
        let (voters, weight, name) = (Vec::new(), None, None);
        let (strength, price) = (1.0, f64::INFINITY);
        Self { frame, strength, price, voters, weight, name, origin: Origin::Pinned }
    }
}

/// Where a key comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A turn of the body (変わり目).
    Turn,
    /// No turn, but without it the body would go astray (補い).
    Fill,
    /// The begin or the end of a rest (止め): it is kept whatever it saves.
    Rest,
    /// The begin or the end of a contact (接地): it is kept whatever it saves.
    Contact,
    /// A phase of a step in a gait (歩み): it is kept whatever it saves.
    Step,
    /// Set by a person; it survives everything.
    Pinned,
    /// Found elsewhere and put here by a person; it survives everything.
    Moved {
        /// The source frame near which it was found.
        from: Frame,
    },
}

impl Origin {
    /// What it says of its drawing.
    pub fn reason(self) -> Reason {
        match self {
            Self::Turn => Reason::Turn,
            Self::Fill => Reason::Fill,
            Self::Rest => Reason::Rest,
            Self::Contact => Reason::Contact,
            Self::Step => Reason::Step,
            Self::Pinned | Self::Moved { .. } => Reason::Pin,
        }
    }

    /// Whether it was found in the motion and may go.
    pub fn is_found(self) -> bool {
        matches!(self, Self::Turn | Self::Fill)
    }

    /// Whether a person wants it just where it is.
    pub fn is_set(self) -> bool {
        matches!(self, Self::Pinned | Self::Moved { .. })
    }
}

/// A wall (壁フレーム) of a layer: where it stops accelerating between two keys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// The source frame.
    pub frame: Frame,
    /// How strong it is, in the measure of the keys.
    pub strength: f64,
}

/// What may be a key, before it is asked what it is worth, and the walls.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidates {
    /// Key candidates by frame.
    pub keys: Vec<Candidate>,
    /// Walls by frame.
    pub walls: Vec<Wall>,
}

/// A frame that may become a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The source frame.
    pub frame: Frame,
    /// How much of a turn it is, 0 to 1; what joints say together where they pick.
    pub strength: f64,
    /// Whether it is a turn; else it fills what lies between turns.
    pub is_turn: bool,
}

/// The keys and walls of a layer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LayerKeys {
    /// Keys by frame, found ones at least a koma apart; the clip's ends are not among them.
    pub keys: Vec<Key>,
    /// Walls by frame.
    pub walls: Vec<Wall>,
    /// Rests (止め) by the frames of their begins and ends, both included. One that touches the clip's begin or
    /// end begins or ends with it; two may overlap.
    pub rests: Vec<RangeInclusive<Frame>>,
    /// Whether a key holds up to the sheet's end where the body does: the end has a drawing of its own else.
    pub holds_end: bool,
    /// Gaits (歩き) whose steps have the same phases.
    pub gaits: Vec<Walk>,
    /// Keys that were worth a drawing and went all the same, because there were too many a second.
    pub over_limit: usize,
}

#[cfg(test)]
mod tests;
