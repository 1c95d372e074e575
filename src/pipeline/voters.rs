//! The joints that vote on a layer's keys, and the weight of each vote.

use super::stage::Of;
use crate::keys::{self, BodyTurns, JointTurns, LayerClip};
use crate::motion::Clip;
use crate::signal::{Signals, Turn};
use crate::time::Frame;

/// The weight of each joint when keys are chosen.
#[derive(Debug)]
pub(super) struct Voices {
    /// The weight of each joint's vote: a person's weight times the weight of the bones that hang on it.
    pub(super) weights: Vec<f64>,
    /// The turns with those of mute joints removed; `None` if all joints vote.
    turns: Option<Vec<Vec<Turn>>>,
}

impl Voices {
    pub(super) fn new(clip: &Clip, motion: &LayerClip, turns: &[Vec<Turn>]) -> Self {
        let (weights, own) = (keys::weights(clip), &motion.heard);
        let weights = weights.iter().zip(own).map(|(by_bones, own)| by_bones * own).collect();
        let heard = |(turns, own): (&Vec<Turn>, &f64)| {
            if *own > 0.0 { turns.clone() } else { Vec::new() }
        };
        let some_are_mute = own.contains(&0.0);
        let turns = some_are_mute.then(|| turns.iter().zip(own).map(heard).collect());
        Self { weights, turns }
    }

    /// Returns the turns of the joints that vote.
    pub(super) fn turns<'a>(&'a self, all: &'a [Vec<Turn>]) -> &'a [Vec<Turn>] {
        self.turns.as_deref().unwrap_or(all)
    }
}

/// Results about the joints once their turns are found: smoothed speeds, turns, voters, turns of the body as a whole,
/// and contacts.
pub(super) type Known<'a> = (
    Of<'a, Signals>,
    Of<'a, Vec<Vec<Turn>>>,
    Of<'a, Voices>,
    Of<'a, BodyTurns>,
    Of<'a, Vec<Frame>>,
);

/// Converts [`Known`] into the form that the candidate search takes. `apart` is the least distance of two keys, in frames.
pub(super) fn joints(known: Known<'_>, apart: f64) -> JointTurns<'_> {
    let (filtered, turns, voices, body, contacts) = known;
    JointTurns {
        filtered: filtered.value(),
        turns: voices.value().turns(turns.value()),
        weights: &voices.value().weights,
        apart,
        contacts: contacts.value(),
        body: body.value(),
    }
}
