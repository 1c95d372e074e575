//! Chooses the frame that shows each phase of a row of steps.

use crate::edits::Edits;
use crate::keys::walk::{NEAR, WalkStep, bounds};
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
        let forbidden = self.forbidden(&frames);
        let mut from = 0;
        for (step, instants) in row {
            let to = from + instants.len();
            step.frames = frames[from..=to].to_vec();
            step.forbidden = forbidden[from..=to].to_vec();
            step.is_corrected = self.corrects(step);
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

    /// Whether a person corrects the step that shows these frames. Such a step keeps the keys found in it.
    fn corrects(&self, step: &WalkStep) -> bool {
        let Edits { pins, moves, frozen, only_pins, .. } = self.edits;
        let frames = &step.frames;
        let set = pins.iter().map(|pin| pin.frame);
        let set = set.chain(moves.iter().flat_map(|moved| [moved.from, moved.to]));
        let is_forbidden = frames.iter().any(Option::is_some) && step.allowed().next().is_none();
        // Next to the clip's ends, a sheet has no room for a genga.
        let room = NEAR * self.koma + 1.0;
        let far =
            |frame: &Frame| (self.ends.1.0 - frame.0).min(frame.0 - self.ends.0.0) as f64 > room;
        let was_there =
            frozen.is_empty() || step.allowed().filter(far).all(|frame| frozen.contains(&frame));
        let reaches = |frame: Frame| has(frames, frame) || self.takes_contact(frames, frame);
        *only_pins || !was_there || is_forbidden || set.into_iter().any(reaches)
    }

    /// Returns whether a person forbids each frame of a row. A single forbidden frame means the nearest of them alone, as
    /// phases stand as near to each other as it reaches.
    fn forbidden(&self, frames: &[Option<Frame>]) -> Vec<bool> {
        let mut are_forbidden = vec![false; frames.len()];
        for range in &self.edits.forbidden {
            let away = |frame: Option<Frame>| {
                frame.filter(|at| range.reaches(*at, self.koma)).map(|at| range.distance(at))
            };
            let nearest = frames.iter().filter_map(|frame| away(*frame)).min();
            let means = |away: usize| !range.is_one() || Some(away) == nearest;
            for (is_forbidden, frame) in are_forbidden.iter_mut().zip(frames) {
                *is_forbidden |= away(*frame).is_some_and(means);
            }
        }
        are_forbidden
    }

    /// Whether a key at a frame takes the place of a step's contact, being nearer than a koma.
    fn takes_contact(&self, frames: &[Option<Frame>], frame: Frame) -> bool {
        let [contact, _] = bounds(frames);
        contact.is_some_and(|contact| (contact.0.abs_diff(frame.0) as f64) < self.koma)
    }
}

/// Whether a frame is in the step that shows these: from its contact on, before the next.
pub(super) fn has(frames: &[Option<Frame>], frame: Frame) -> bool {
    let [from, to] = bounds(frames);
    frames.iter().any(Option::is_some)
        && from.is_none_or(|from| from <= frame)
        && to.is_none_or(|to| frame < to)
}
