//! A jump at an end of a clip: steps that no motion beside them explains.

use crate::motion::Clip;
use crate::time::Frame;

/// Seconds of motion that a jump is held against.
const FOLLOWING: f64 = 0.25;

/// Fewer steps than this say nothing about the motion, at whatever rate.
const FEWEST_FOLLOWING: usize = 4;

/// A step belongs to the jump while it is so many times the median of the steps that follow it.
const TAIL: f64 = 3.0;

/// So many frames may stay as they are before the jump.
pub(super) const MOST_HELD: usize = 10;

/// How many steps of a clip a jump is held against.
pub(super) fn following(clip: &Clip) -> usize {
    ((FOLLOWING * clip.rate().fps()).round() as usize).max(FEWEST_FOLLOWING)
}

/// From which end a clip is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Front,
    Back,
}

impl End {
    /// The frame so many steps from this end.
    pub(super) fn frame(self, clip: &Clip, steps: usize) -> Frame {
        match self {
            Self::Front => Frame(clip.first().0 + steps),
            Self::Back => Frame(clip.last().0 - steps),
        }
    }

    /// First and last of the frames from this end to so many steps from it.
    pub(super) fn span(self, clip: &Clip, steps: usize) -> (Frame, Frame) {
        let (outer, inner) = (self.frame(clip, 0), self.frame(clip, steps));
        (outer.min(inner), outer.max(inner))
    }
}

/// The first steps from an end that move anything, as far as they are larger than what follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Jump {
    /// Its first step and its last.
    pub(super) begin: usize,
    pub(super) end: usize,
    /// The largest of the steps that follow it.
    pub(super) largest_after: f64,
}

impl Jump {
    /// Finds the jump in the sizes of steps, the outermost first; none where too few steps follow, or where
    /// what follows stands still. A step above `still` moves. Up to `tail` steps behind the first may
    /// belong to the jump.
    pub(super) fn find(steps: &[f64], still: f64, tail: usize, following: usize) -> Option<Self> {
        let begin = steps.iter().take(MOST_HELD + 1).position(|step| *step > still)?;
        let is_far = |step: &usize| steps[*step] > TAIL * median(after(steps, *step, following));
        let end = (begin + 1..steps.len()).take(tail).take_while(is_far).last().unwrap_or(begin);
        let after = after(steps, end, following);
        let is_told = after.len() >= FEWEST_FOLLOWING.max(following / 2) && median(after) > still;
        let largest_after = after.iter().copied().fold(0.0, f64::max);
        is_told.then_some(Self { begin, end, largest_after })
    }
}

/// Up to `count` steps behind one.
fn after(steps: &[f64], step: usize, count: usize) -> &[f64] {
    let begin = (step + 1).min(steps.len());
    &steps[begin..(begin + count).min(steps.len())]
}

/// Infinite where there is none, so that nothing is far from it.
fn median(steps: &[f64]) -> f64 {
    let mut steps = steps.to_vec();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied().unwrap_or(f64::INFINITY)
}
