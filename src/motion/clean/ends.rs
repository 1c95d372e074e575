//! Finds a jump at an end of a clip: steps that the motion beside them does not explain.

use crate::motion::Clip;
use crate::time::Frame;

/// Length of the motion against which a jump is compared, in seconds.
const FOLLOWING: f64 = 0.25;

/// Fewest steps needed to judge the motion, at any frame rate.
const FEWEST_FOLLOWING: usize = 4;

/// A step belongs to the jump while it exceeds this many times the median of the steps after it.
const TAIL: f64 = 3.0;

/// Most still steps allowed before the jump.
pub(super) const MOST_HELD: usize = 10;

/// Number of steps against which a jump is compared.
pub(super) fn following(clip: &Clip) -> usize {
    ((FOLLOWING * clip.rate().fps()).round() as usize).max(FEWEST_FOLLOWING)
}

/// The end of a clip from which steps are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Front,
    Back,
}

impl End {
    /// The frame `steps` steps inward from this end.
    pub(super) fn frame(self, clip: &Clip, steps: usize) -> Frame {
        match self {
            Self::Front => Frame(clip.first().0 + steps),
            Self::Back => Frame(clip.last().0 - steps),
        }
    }

    /// The first and last frame of the stretch from this end to `steps` steps inward.
    pub(super) fn span(self, clip: &Clip, steps: usize) -> (Frame, Frame) {
        let (outer, inner) = (self.frame(clip, 0), self.frame(clip, steps));
        (outer.min(inner), outer.max(inner))
    }
}

/// A jump: the first steps from an end that move anything and are larger than the steps after them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Jump {
    /// The first step of the jump and its last.
    pub(super) begin: usize,
    pub(super) end: usize,
    /// The largest of the steps that follow the jump.
    pub(super) largest_after: f64,
}

impl Jump {
    /// Finds the jump in the sizes of steps, outermost first. A step above `still` moves. Up to `tail`
    /// steps after the first may belong to the jump. Returns `None` if too few steps follow, or if they
    /// stand still.
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

/// Up to `count` steps that follow `step`.
fn after(steps: &[f64], step: usize, count: usize) -> &[f64] {
    let begin = (step + 1).min(steps.len());
    &steps[begin..(begin + count).min(steps.len())]
}

/// The median, or infinity if there are no steps, so that no step exceeds it.
fn median(steps: &[f64]) -> f64 {
    let mut steps = steps.to_vec();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied().unwrap_or(f64::INFINITY)
}
