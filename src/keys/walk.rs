//! Gaits that walk (歩き): gives every step of a gait the same phases, each with a genga.

mod drawable;
mod instants;

pub(super) use drawable::Drawable;

use crate::edits::Edits;
use crate::keys::walk::instants::{Instants, walk};
use crate::keys::{Key, Origin};
use crate::knob::choices;
use crate::motion::Gait;
use crate::time::Frame;

/// Koma that each phase needs: less leaves no room for a drawing on twos.
const ROOM: f64 = 2.0;

/// Distance from the bounds of a gait, or from a phase, within which found keys give way, in koma: two genga would not
/// fit.
const NEAR: f64 = 2.0;

/// How the genga of the steps of a gait are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtGaits {
    /// The same phases at the same times in every step.
    #[default]
    Steps,
    /// By what they save, like all other keys.
    Off,
}

choices!(AtGaits { Steps: "steps", Off: "off" });

/// A phase of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// A foot comes down (接地).
    Contact,
    /// The body is lowest (沈み); half-way to the passing if it is lowest at the contact.
    Down,
    /// The other foot passes (すれ違い).
    Passing,
    /// The body is highest (伸び); half-way to the next contact if it is highest at the passing.
    Up,
}

/// A gait on the sheet: steps with the same phases.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    /// The phases that have a genga in each step, in order. The contact is the first.
    pub phases: Vec<Phase>,
    /// Instant of each phase, 0 to 1 of the way from contact to contact: the median of all steps.
    pub shares: Vec<f64>,
    /// Length of a step in koma: the median of all steps.
    pub koma: f64,
    /// Its steps.
    pub steps: Vec<WalkStep>,
}

/// A step on the sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkStep {
    /// Time at which its foot comes down, in koma from the sheet's first; below 0 if the clip begins within the step.
    pub contact: f64,
    /// Time at which the other foot comes down.
    pub next: f64,
    /// Frame that shows each phase and, last, the next contact; `None` if it lies outside the clip.
    pub frames: Vec<Option<Frame>>,
    /// What becomes of each of these frames, if a correction takes it away. The other phases stay.
    pub taken: Vec<Option<Taken>>,
    /// Whether corrections leave none of its phases. Then it keeps the keys found in it.
    pub has_no_phase: bool,
}

/// What becomes of a phase that a correction takes away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Taken {
    /// A person forbids it, moves it away, or sets a key near it: an inbetween takes its place.
    Gone,
    /// A person sets a key at this frame, within a koma of it: that takes its place and its koma.
    By(Frame),
}

impl Walk {
    /// Returns the steps that have phases.
    pub fn regular(&self) -> impl Iterator<Item = &WalkStep> {
        self.steps.iter().filter(|step| !step.has_no_phase)
    }
}

impl Phase {
    /// Returns its word in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::Down => "down",
            Self::Passing => "passing",
            Self::Up => "up",
        }
    }

    /// Returns the phases that have room in steps of so many koma, in which the other foot passes at a share of the way
    /// from contact to contact. A phase without room would push the next one off its time.
    fn with_room(koma: f64, passing: f64) -> Vec<Self> {
        let koma = koma.round();
        let passing = (passing * koma).round();
        let holds_two = |koma: f64| koma >= 2.0 * ROOM;
        let phases = [
            (Self::Contact, true),
            (Self::Down, holds_two(passing)),
            (Self::Passing, holds_two(koma)),
            (Self::Up, holds_two(koma - passing)),
        ];
        phases.into_iter().filter(|(_, is_drawn)| *is_drawn).map(|(phase, _)| phase).collect()
    }
}

/// The gaits as drawn.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Walks(pub(super) Vec<Walk>);

impl Walks {
    /// Finds the gaits of a layer on its sheet.
    pub(super) fn new(gaits: &[Gait], drawable: Drawable<'_>) -> Self {
        let mut walks: Vec<(Walk, Instants)> = gaits.iter().map(walk).collect();
        let mut steps: Vec<_> = walks
            .iter_mut()
            .flat_map(|(walk, instants)| walk.steps.iter_mut().zip(instants))
            .collect();
        // Two steps that share a contact share its frame, even if they belong to two gaits.
        for row in steps.chunk_by_mut(|(step, _), (after, _)| step.next == after.contact) {
            drawable.draw(row);
        }
        Self(walks.into_iter().map(|(walk, _)| walk).collect())
    }

    /// Returns the gaits of which some steps have their phases.
    pub(super) fn into_regular(self) -> Vec<Walk> {
        self.0.into_iter().filter(|walk| walk.regular().next().is_some()).collect()
    }

    /// Adds phases that a person moves to the keys, if no other key is near. They were on the sheet before.
    pub(super) fn give(&self, keys: &mut Vec<Key>, edits: &Edits, apart: f64) {
        let steps = self.0.iter().flat_map(|walk| &walk.steps);
        let phases: Vec<Frame> = steps.flat_map(|step| &step.frames).flatten().copied().collect();
        for moved in &edits.moves {
            let near = |frame: &Frame| (frame.0.abs_diff(moved.from.0) as f64) < apart;
            let phase = phases.iter().filter(|frame| near(frame));
            let phase = phase.min_by_key(|frame| frame.0.abs_diff(moved.from.0));
            if let Some(phase) = phase.filter(|_| !keys.iter().any(|key| near(&key.frame))) {
                keys.push(Key { origin: Origin::Step, ..Key::set(*phase) });
            }
        }
        keys.sort_by_key(|key| key.frame);
    }

    /// Replaces the keys in regular steps by the steps' phases, which are `found` keys where a turn shows them. Keys
    /// that a person set stay, and phases nearer to a key than a koma (`apart` frames) are dropped. A frozen phase is a
    /// phase again.
    pub(super) fn lay(&self, keys: &mut Vec<Key>, found: &[Key], edits: &Edits, apart: f64) {
        let steps = || self.0.iter().flat_map(Walk::regular);
        let turn = |frame: Frame| {
            found.iter().find(|key| key.origin == Origin::Turn && key.frame == frame)
        };
        let is_within = |frame: Frame| steps().any(|step| step.covers(frame, NEAR * apart));
        let is_frozen_phase = |key: &Key| {
            let is_pin = edits.pins.iter().any(|pin| pin.frame == key.frame);
            let is_phase = |step: &WalkStep| step.frames.contains(&Some(key.frame));
            key.origin == Origin::Pinned && !is_pin && steps().any(is_phase)
        };
        keys.retain(|key| match key.origin.is_set() {
            true => !is_frozen_phase(key),
            false => !is_within(key.frame),
        });
        let mut frames: Vec<Frame> = steps().flat_map(WalkStep::shown).collect();
        frames.sort_unstable();
        frames.dedup();
        let is_free =
            |frame: &Frame| !keys.iter().any(|key| (key.frame.0.abs_diff(frame.0) as f64) < apart);
        frames.retain(is_free);
        let key = |frame: Frame| match turn(frame) {
            Some(turn) => Key { origin: Origin::Step, ..turn.clone() },
            None => Key { origin: Origin::Step, strength: 0.0, ..Key::set(frame) },
        };
        keys.extend(frames.into_iter().map(key));
        keys.sort_by_key(|key| key.frame);
    }
}

impl WalkStep {
    /// Returns the frames that genga show.
    fn shown(&self) -> impl Iterator<Item = Frame> {
        let frames = self.frames.iter().zip(&self.taken);
        frames.filter_map(|(frame, taken)| frame.filter(|_| taken.is_none()))
    }

    /// Whether a frame is in the step, or nearer to it than `near` frames.
    fn covers(&self, frame: Frame, near: f64) -> bool {
        let [from, to] = bounds(&self.frames);
        // A step that shows nothing of the clip covers nothing of it.
        if self.frames.iter().all(Option::is_none) {
            return false;
        }
        let is_past = |end: Frame, frame: Frame| (end.0 as f64 - frame.0 as f64) < near;
        from.is_none_or(|from| is_past(from, frame)) && to.is_none_or(|to| is_past(frame, to))
    }
}

/// Returns the frames of a step's two contacts.
fn bounds(frames: &[Option<Frame>]) -> [Option<Frame>; 2] {
    [frames.first().copied().flatten(), frames.last().copied().flatten()]
}

#[cfg(test)]
mod tests;
