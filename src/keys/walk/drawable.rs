//! Chooses the frame that shows each phase of a row of steps.

use crate::edits::Edits;
use crate::keys::walk::{NEAR, Taken, WalkStep};
use crate::keys::{Key, Origin};
use crate::time::Frame;

/// The frames that may show a phase, and a person's corrections of them.
#[derive(Debug, Clone, Copy)]
pub(in crate::keys) struct Drawable<'a> {
    /// Keys chosen before a person's corrections. A correction in one step must not change the phases of another.
    pub(in crate::keys) found: &'a [Key],
    pub(in crate::keys) edits: &'a Edits,
    /// Frames in a koma.
    pub(in crate::keys) koma: f64,
    /// The clip's first and last frame, which are no keys.
    pub(in crate::keys) ends: (Frame, Frame),
}

impl Drawable<'_> {
    /// Gives each step of a row without gaps its frames; beside it stand the instants of its phases.
    pub(super) fn draw(&self, row: &mut [(&mut WalkStep, &mut Vec<f64>)]) {
        let last = row.last().map(|(step, _)| step.next);
        let instants: Vec<f64> =
            row.iter().flat_map(|(_, instants)| instants.iter().copied()).chain(last).collect();
        let frames = self.frames(&instants);
        let taken = self.taken(&frames);
        let mut from = 0;
        for (step, instants) in row {
            let to = from + instants.len();
            step.frames = frames[from..=to].to_vec();
            step.taken = taken[from..=to].to_vec();
            step.has_no_phase = self.has_no_phase(step);
            from = to;
        }
    }

    /// Returns the frame nearest to each instant, given in koma, or a turn found within a koma of it and no nearer to
    /// another of them.
    fn frames(&self, instants: &[f64]) -> Vec<Option<Frame>> {
        let (first, last) = self.ends;
        let places: Vec<f64> = instants.iter().map(|at| first.0 as f64 + at * self.koma).collect();
        let mut before = first;
        let frame = |at: usize| {
            let nearest = places[at].round();
            let is_inside = (first.0 as f64) < nearest && nearest < last.0 as f64;
            let nearest = is_inside.then_some(Frame(nearest as usize))?;
            let turn = self.turn(&places, at).filter(|turn| before < *turn);
            before = turn.unwrap_or(nearest.max(Frame(before.0 + 1)));
            (before < last).then_some(before)
        };
        (0..places.len()).map(frame).collect()
    }

    /// Returns the turn nearest to a place, if it is within a koma of it and no nearer to the places beside it.
    fn turn(&self, places: &[f64], at: usize) -> Option<Frame> {
        let off = |frame: Frame, place: f64| (frame.0 as f64 - place).abs();
        let own = |frame: Frame| off(frame, places[at]);
        let turns = self.found.iter().filter(|key| key.origin == Origin::Turn);
        let turn = turns.map(|key| key.frame).min_by(|a, b| own(*a).total_cmp(&own(*b)))?;
        let mut beside = [at.wrapping_sub(1), at + 1].into_iter().filter_map(|at| places.get(at));
        let is_own = own(turn) <= self.koma && beside.all(|place| own(turn) <= off(turn, *place));
        is_own.then_some(turn)
    }

    /// Whether no phase of a step is left. Such a step keeps the keys found in it.
    fn has_no_phase(&self, step: &WalkStep) -> bool {
        let Edits { frozen, only_pins, .. } = self.edits;
        let is_taken = step.frames.iter().any(Option::is_some) && step.shown().next().is_none();
        // Next to the clip's ends, a sheet has no room for a genga.
        let room = NEAR * self.koma + 1.0;
        let far =
            |frame: &Frame| (self.ends.1.0 - frame.0).min(frame.0 - self.ends.0.0) as f64 > room;
        let was_there =
            frozen.is_empty() || step.shown().filter(far).all(|frame| frozen.contains(&frame));
        *only_pins || !was_there || is_taken
    }

    /// Returns what a correction puts in the place of each frame of a row, if one takes it away.
    fn taken(&self, frames: &[Option<Frame>]) -> Vec<Option<Taken>> {
        let Edits { pins, moves, forbidden, .. } = self.edits;
        let mut taken = vec![None; frames.len()];
        for range in forbidden {
            let reached = |at: Frame| range.reaches(at, self.koma).then(|| range.distance(at));
            let near = Near::new(frames, reached);
            // A single frame means the nearest phase alone: they stand as near to each other as it reaches.
            let meant = if range.is_one() { near.nearest().into_iter().collect() } else { near.0 };
            meant.iter().for_each(|(at, _)| taken[*at] = Some(Taken::Gone));
        }
        let within = |place: Frame, most: f64| {
            move |at: Frame| Some(at.0.abs_diff(place.0)).filter(|far| (*far as f64) < most)
        };
        for moved in moves {
            let near = Near::new(frames, within(moved.from, self.koma));
            near.nearest().iter().for_each(|(at, _)| taken[*at] = Some(Taken::Gone));
        }
        let set = pins.iter().map(|pin| pin.frame).chain(moves.iter().map(|moved| moved.to));
        for set in set {
            let own = Near::new(frames, within(set, self.koma));
            match own.nearest() {
                Some((own, _)) => taken[own] = Some(Taken::By(set)),
                None => {
                    let near = Near::new(frames, within(set, NEAR * self.koma));
                    near.0.iter().for_each(|(at, _)| taken[*at] = Some(Taken::Gone));
                }
            }
        }
        taken
    }
}

/// Phases near a place: their places in the row, and how many frames they are away.
struct Near(Vec<(usize, usize)>);

impl Near {
    fn new(frames: &[Option<Frame>], away: impl Fn(Frame) -> Option<usize>) -> Self {
        let near = frames.iter().enumerate();
        Self(near.filter_map(|(at, frame)| Some((at, frame.and_then(&away)?))).collect())
    }

    fn nearest(&self) -> Option<(usize, usize)> {
        self.0.iter().copied().min_by_key(|(_, far)| *far)
    }
}
