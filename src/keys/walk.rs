//! Gaits that walk (歩き): gives every step of a gait the same phases, each with a genga.

use crate::edits::Edits;
use crate::keys::{Key, Origin};
use crate::knob::choices;
use crate::maths::median;
use crate::motion::{Gait, Step};
use crate::time::Frame;

/// Koma that each phase needs: less leaves no room for a drawing on twos.
const ROOM: f64 = 2.0;

/// Distance from the bounds of a gait, or from a phase, within which found keys give way, in koma: two genga would not
/// fit.
const NEAR: f64 = 2.0;

/// Least distance of two phases in koma; nearer ones are one.
const ONE: f64 = 1.0;

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
    /// Whether a person corrects it. Then it has the keys that were found, and not its phases.
    pub is_corrected: bool,
}

impl Walk {
    /// Returns the steps that have their phases: those that no person corrects.
    pub fn regular(&self) -> impl Iterator<Item = &WalkStep> {
        self.steps.iter().filter(|step| !step.is_corrected)
    }
}

impl Phase {
    /// Number of phases.
    pub const MOST: usize = 4;

    /// Returns its word in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::Down => "down",
            Self::Passing => "passing",
            Self::Up => "up",
        }
    }

    /// Returns the phases that fit into steps of so many koma.
    fn with_room(koma: f64) -> &'static [Self] {
        match koma {
            koma if koma >= 4.0 * ROOM => &[Self::Contact, Self::Down, Self::Passing, Self::Up],
            koma if koma >= 2.0 * ROOM => &[Self::Contact, Self::Passing],
            _ => &[Self::Contact],
        }
    }
}

/// The keys chosen in a clip, and a person's corrections of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Choosable<'a> {
    pub(super) keys: &'a [Key],
    pub(super) edits: &'a Edits,
    /// Frames in a koma.
    pub(super) koma: f64,
    /// The clip's first and last frame, which are no keys.
    pub(super) ends: (Frame, Frame),
}

/// The gaits as drawn.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Walks(pub(super) Vec<Walk>);

impl Walks {
    /// Finds the gaits of a layer on its sheet.
    pub(super) fn new(gaits: &[Gait], chosen: Choosable<'_>) -> Self {
        Self(gaits.iter().map(|gait| chosen.walk(gait)).collect())
    }

    /// Returns the gaits of which some steps have their phases.
    pub(super) fn into_regular(self) -> Vec<Walk> {
        self.0.into_iter().filter(|walk| walk.regular().next().is_some()).collect()
    }

    /// Adds phases that a person moves to the keys, if no other key is near. They were on the sheet before.
    pub(super) fn give(&self, keys: &mut Vec<Key>, edits: &Edits, apart: f64) {
        let steps = self.0.iter().flat_map(|walk| &walk.steps).filter(|step| step.is_corrected);
        let corrected: Vec<Frame> =
            steps.flat_map(|step| &step.frames).flatten().copied().collect();
        for moved in &edits.moves {
            let near = |frame: &Frame| (frame.0.abs_diff(moved.from.0) as f64) < apart;
            let phase = corrected.iter().filter(|frame| near(frame));
            let phase = phase.min_by_key(|frame| frame.0.abs_diff(moved.from.0));
            if let Some(phase) = phase.filter(|_| !keys.iter().any(|key| near(&key.frame))) {
                keys.push(Key { origin: Origin::Step, ..Key::set(*phase) });
            }
        }
        keys.sort_by_key(|key| key.frame);
    }

    /// Replaces the keys found in regular steps by the steps' phases. Keys that a person set stay, and phases nearer to
    /// a key than a koma (`apart` frames) are dropped.
    pub(super) fn lay(&self, keys: &mut Vec<Key>, apart: f64) {
        let steps = || self.0.iter().flat_map(Walk::regular);
        let turns: Vec<Key> =
            keys.iter().filter(|key| key.origin == Origin::Turn).cloned().collect();
        let is_within = |frame: Frame| steps().any(|step| step.covers(frame, NEAR * apart));
        keys.retain(|key| key.origin.is_set() || !is_within(key.frame));
        let mut frames: Vec<Frame> =
            steps().flat_map(|step| &step.frames).copied().flatten().collect();
        frames.sort_unstable();
        frames.dedup();
        let is_free =
            |frame: &Frame| !keys.iter().any(|key| (key.frame.0.abs_diff(frame.0) as f64) < apart);
        frames.retain(is_free);
        let key = |frame: Frame| match turns.iter().find(|turn| turn.frame == frame) {
            Some(turn) => Key { origin: Origin::Step, ..turn.clone() },
            None => Key { origin: Origin::Step, strength: 0.0, ..Key::set(frame) },
        };
        keys.extend(frames.into_iter().map(key));
        keys.sort_by_key(|key| key.frame);
    }
}

impl Choosable<'_> {
    /// Builds a gait with the phases that fit into its steps.
    fn walk(&self, gait: &Gait) -> Walk {
        let koma = middle(gait.steps.iter().map(length));
        let phases = Phase::with_room(koma);
        let own = |step: &Step| [step.contact, step.down, step.passing, step.up];
        let [_, down, passing, up] = [0, 1, 2, 3].map(|phase| {
            koma * middle(
                gait.steps.iter().map(|step| (own(step)[phase] - step.contact) / length(step)),
            )
        });
        let is_between = |at: f64, from: f64, to: f64| from + ONE <= at && at <= to - ONE;
        let has_own = (is_between(down, 0.0, passing), is_between(up, passing, koma));
        // Any sooner, the drawing before is still on screen, and its pose is nearly the same.
        let behind =
            |at: f64, from: f64, to: f64| at.max((from + ROOM).min(f64::midpoint(from, to)));
        let instant = |step: &Step, phase: Phase| match phase {
            Phase::Contact => step.contact,
            Phase::Down if has_own.0 => behind(step.down, step.contact, step.passing),
            Phase::Down => f64::midpoint(step.contact, step.passing),
            Phase::Passing => step.passing,
            Phase::Up if has_own.1 => behind(step.up, step.passing, step.next),
            Phase::Up => f64::midpoint(step.passing, step.next),
        };
        let share = |phase: &Phase| {
            let shares =
                gait.steps.iter().map(|step| (instant(step, *phase) - step.contact) / length(step));
            middle(shares)
        };
        let step = |step: &Step| {
            let instants: Vec<f64> =
                phases.iter().map(|phase| instant(step, *phase)).chain([step.next]).collect();
            let frames = self.frames(&instants);
            let is_corrected = self.corrects(&frames);
            WalkStep { contact: step.contact, next: step.next, frames, is_corrected }
        };
        Walk {
            phases: phases.to_vec(),
            shares: phases.iter().map(share).collect(),
            koma,
            steps: gait.steps.iter().map(step).collect(),
        }
    }

    /// Returns the frame nearest to each instant, given in koma, or a turn found within a koma of it and no nearer to
    /// another of them.
    fn frames(&self, instants: &[f64]) -> Vec<Option<Frame>> {
        let koma = self.koma;
        let (first, last) = (self.ends.0.0 as f64, self.ends.1.0 as f64);
        let place = |instant: f64| first + instant * koma;
        let mut before = self.ends.0;
        let frame = |(at, instant): (usize, &f64)| {
            let own = place(*instant);
            let off = |frame: Frame| (frame.0 as f64 - own).abs();
            let is_own = |frame: &Frame| {
                let others = [at.wrapping_sub(1), at + 1].into_iter();
                let mut others = others.filter_map(|other| instants.get(other));
                others.all(|other| off(*frame) <= (frame.0 as f64 - place(*other)).abs())
            };
            let turns = self.keys.iter().filter(|key| key.origin == Origin::Turn);
            let turn = turns.map(|key| key.frame).min_by(|a, b| off(*a).total_cmp(&off(*b)));
            let is_inside = first < own.round() && own.round() < last;
            let nearest = is_inside.then(|| Frame(own.round() as usize))?;
            let turn = turn.filter(|turn| off(*turn) <= koma && before < *turn && is_own(turn));
            before = turn.unwrap_or(nearest.max(Frame(before.0 + 1)));
            (before < self.ends.1).then_some(before)
        };
        instants.iter().enumerate().map(frame).collect()
    }

    /// Whether a person corrects the step that shows these frames. Such a step keeps the keys found in it.
    fn corrects(&self, frames: &[Option<Frame>]) -> bool {
        let Edits { pins, moves, forbidden, frozen, only_pins, .. } = self.edits;
        let set = pins.iter().map(|pin| pin.frame);
        let set = set.chain(moves.iter().flat_map(|moved| [moved.from, moved.to]));
        let shown = || frames.iter().flatten();
        let is_forbidden =
            shown().any(|frame| forbidden.iter().any(|range| range.reaches(*frame, self.koma)));
        // Next to the clip's ends, a sheet has no room for a genga.
        let room = NEAR * self.koma + 1.0;
        let far =
            |frame: &&Frame| (self.ends.1.0 - frame.0).min(frame.0 - self.ends.0.0) as f64 > room;
        let was_there =
            frozen.is_empty() || shown().filter(far).all(|frame| frozen.contains(frame));
        *only_pins || !was_there || is_forbidden || set.into_iter().any(|frame| has(frames, frame))
    }
}

impl WalkStep {
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

/// Whether a frame is in the step that shows these: from its contact on, before the next.
fn has(frames: &[Option<Frame>], frame: Frame) -> bool {
    let [from, to] = bounds(frames);
    frames.iter().any(Option::is_some)
        && from.is_none_or(|from| from <= frame)
        && to.is_none_or(|to| frame < to)
}

/// Returns the frames of a step's two contacts.
fn bounds(frames: &[Option<Frame>]) -> [Option<Frame>; 2] {
    [frames.first().copied().flatten(), frames.last().copied().flatten()]
}

/// Returns the koma from contact to contact.
fn length(step: &Step) -> f64 {
    step.next - step.contact
}

/// Returns the median, 0 of no values.
fn middle(values: impl Iterator<Item = f64>) -> f64 {
    median(values).unwrap_or(0.0)
}

#[cfg(test)]
mod tests;
