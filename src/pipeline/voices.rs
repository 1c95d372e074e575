//! Who of the joints has a say in a layer's keys, and how much it counts.

use super::moving::Moving;
use super::stage::Of;
use crate::keys::{self, BodyTurns, JointTurns, LayerClip};
use crate::motion::Clip;
use crate::recipe::Recipe;
use crate::signal::{Signals, Turn, TurnFinder};
use crate::time::Frame;

/// How much each joint counts when keys are chosen.
#[derive(Debug)]
pub(super) struct Voices {
    /// What a person says of each joint times what hangs on it: the weight of its vote.
    pub(super) weights: Vec<f64>,
    /// The turns without those of joints that have no say; none where all have.
    turns: Option<Vec<Vec<Turn>>>,
}

impl Voices {
    pub(super) fn of(clip: &Clip, motion: &LayerClip, turns: &[Vec<Turn>]) -> Self {
        let (weights, own) = (keys::weights(clip), &motion.heard);
        let weights = weights.iter().zip(own).map(|(by_bones, own)| by_bones * own).collect();
        let heard = |(turns, own): (&Vec<Turn>, &f64)| {
            if *own > 0.0 { turns.clone() } else { Vec::new() }
        };
        let some_are_mute = own.contains(&0.0);
        let turns = some_are_mute.then(|| turns.iter().zip(own).map(heard).collect());
        Self { weights, turns }
    }

    /// The turns of those that have a say, of all turns.
    pub(super) fn turns<'a>(&'a self, all: &'a [Vec<Turn>]) -> &'a [Vec<Turn>] {
        self.turns.as_deref().unwrap_or(all)
    }
}

/// What finds turns, the delay of the filter and the least distance of two keys, both in frames.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Finding {
    pub(super) finder: TurnFinder,
    pub(super) delay: f64,
    pub(super) apart: f64,
}

impl Finding {
    pub(super) fn of(moving: &Moving<'_>, recipe: &Recipe) -> Self {
        Self {
            finder: recipe.turns.clone(),
            delay: recipe.filter.delay(moving.clip.rate()),
            apart: moving.apart(recipe),
        }
    }
}

/// What is known of the joints once their turns are found: smoothed speeds, turns, who has a say, turns as a
/// whole, and contacts.
pub(super) type Known<'a> = (
    Of<'a, Signals>,
    Of<'a, Vec<Vec<Turn>>>,
    Of<'a, Voices>,
    Of<'a, BodyTurns>,
    Of<'a, Vec<Frame>>,
);

/// The same for those who find candidates.
pub(super) fn joints<'a>(known: Known<'a>, finding: &'a Finding) -> JointTurns<'a> {
    let (filtered, turns, voices, body, contacts) = known;
    let Finding { finder, delay, apart } = finding;
    JointTurns {
        filtered: filtered.value(),
        turns: voices.value().turns(turns.value()),
        finder,
        delay: *delay,
        weights: &voices.value().weights,
        apart: *apart,
        contacts: contacts.value(),
        body: body.value(),
    }
}
