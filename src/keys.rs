//! **Choose** (選ぶ): chooses the keys (原画) and walls (壁) of a layer from its turns.
//!
//! The filter, the sign pattern and the persistence find the turns of the body ([`BodyTurns`]). A key at a turn is
//! cheap, a key between turns is dear. [`Choose`] takes the set of keys that loses least at these prices. For studies
//! the joints may pick instead: they vote, their speeds are added, or any joint's turn is a candidate.

mod acting;
mod actions;
mod alike;
mod body;
mod bridge;
mod cheapest;
mod choose;
mod chords;
mod contact;
mod correct;
mod cycle;
mod drawn_body;
mod layers;
mod local_corrections;
mod matching;
mod merge;
mod peaks;
mod points;
mod postures;
mod reconstruction;
mod reference;
mod rest;
mod selection;
mod stillness;
mod vote;
mod voters;
mod walk;
mod weights;

use std::ops::RangeInclusive;

use crate::edits::Forbidden;
use crate::motion::JointId;
use crate::sheet::Reason;
use crate::time::Frame;

pub use actions::{Action, ActionFinder, Actions, Split, SplitReason};
pub use alike::Alike;
pub use body::BodyTurns;
pub(crate) use body::{BodySpeeds, LayerMotion, Tracks, drawn};
pub use bridge::Bridge;
pub(crate) use choose::Picks;
pub use choose::{Choose, Fill, Judges, Merge, Rank};
pub use chords::Chords;
pub use contact::AtContacts;
pub(crate) use contact::contact_ends;
pub use cycle::{Cycle, IS_CYCLE};
pub use drawn_body::DrawnBody;
pub(crate) use layers::LayerClip;
pub use layers::{LayerJoints, Layers, NamedLayer};
pub(crate) use local_corrections::{Chosen, Word};
pub use matching::Matching;
pub use merge::JointTurns;
pub use reconstruction::Reconstruction;
pub use reconstruction::with_ends;
pub use reference::Reference;
pub use rest::AtRests;
pub(crate) use rest::{rest_frames, rests};
pub(crate) use selection::{Choice, Picked};
pub use voters::weights;
pub use walk::{AtGaits, Phase, Taken, Walk, WalkStep};
pub use weights::JointWeights;

/// A key (原画) of a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// The source frame it shows.
    pub frame: Frame,
    /// Strength of the turn, 0 to 1: for votes the share of all weight.
    pub strength: f64,
    /// The error it saves, in % of body height: what its neighbours would lose without it, spread over an eighth of a
    /// second. Infinite for keys that must stay.
    pub price: f64,
    /// Joints with a turn of their own here.
    pub voters: Vec<JointId>,
    /// Spacing weight, if a person gave one.
    pub weight: Option<f64>,
    /// Name, if a person gave one.
    pub name: Option<String>,
    /// Origin of the key.
    pub origin: Origin,
}

impl Key {
    /// Creates a key that a person wants at a frame, without a name.
    pub fn set(frame: Frame) -> Self {
        let (voters, weight, name) = (Vec::new(), None, None);
        let (strength, price) = (1.0, f64::INFINITY);
        Self { frame, strength, price, voters, weight, name, origin: Origin::Pinned }
    }

    /// The frame before a person moved it.
    pub fn unmoved(&self) -> Frame {
        match self.origin {
            Origin::Moved { from } => from,
            _ => self.frame,
        }
    }
}

/// The origin of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A turn of the body (変わり目).
    Turn,
    /// Not a turn, but the body would go astray without it (補い).
    Fill,
    /// The begin or the end of a rest (止め), kept whatever it saves.
    Rest,
    /// The begin or the end of a contact (接地), kept whatever it saves.
    Contact,
    /// A phase of a step in a gait (歩み), kept whatever it saves.
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
    /// Returns the reason that the sheet gives for its drawing.
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

    /// Whether the key was found in the motion and may be left out.
    pub fn is_found(self) -> bool {
        matches!(self, Self::Turn | Self::Fill)
    }

    /// Whether a person placed the key at exactly this frame.
    pub fn is_set(self) -> bool {
        matches!(self, Self::Pinned | Self::Moved { .. })
    }
}

/// A wall (壁フレーム) of a layer: where it stops accelerating between two keys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// The source frame.
    pub frame: Frame,
    /// Strength of the wall, in the measure of the keys.
    pub strength: f64,
}

/// The key candidates of a layer, not yet priced, and its walls.
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
    /// Strength of the turn, 0 to 1; the joints' combined strength if they pick.
    pub strength: f64,
    /// Whether it is a turn; otherwise it fills the time between turns.
    pub is_turn: bool,
}

/// The keys and walls of a layer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LayerKeys {
    /// Keys by frame, found ones at least a koma apart. The clip's ends are not included.
    pub keys: Vec<Key>,
    /// The keys that would be there without corrections, or of the frozen ones. Phases of gaits are among them.
    pub without_corrections: Vec<Key>,
    /// Walls by frame.
    pub walls: Vec<Wall>,
    /// Rests (止め) from first to last frame, both included. A rest that touches an end of the clip begins or ends there.
    /// Two rests may overlap.
    pub rests: Vec<RangeInclusive<Frame>>,
    /// Whether a key holds to the sheet's end while the body stays still there; otherwise the end gets its own drawing.
    pub holds_end: bool,
    /// Gaits (歩き) whose steps have the same phases.
    pub gaits: Vec<Walk>,
    /// Number of keys that were worth a drawing but dropped, because there were too many a second.
    pub over_limit: usize,
}

impl LayerKeys {
    /// Returns the frames of the keys that a ban takes away, `koma` frames a koma. Beside a forbidden phase of a step others
    /// stay, however near, and so does what a person sets.
    pub fn taken_by(&self, ban: Forbidden, koma: f64) -> impl Iterator<Item = Frame> {
        let is_there = |frame: Frame| self.keys.iter().any(|key| key.frame == frame);
        let reached = self
            .without_corrections
            .iter()
            .map(|key| key.frame)
            .filter(move |at| ban.reaches(*at, koma));
        reached.filter(move |at| !is_there(*at))
    }
}

#[cfg(test)]
mod tests;
