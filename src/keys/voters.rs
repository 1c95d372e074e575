//! Finds the joints that speak for a key, and the weight of each.

use crate::motion::{Clip, JointId, Skeleton};
use crate::signal::{Turn, TurnKind};
use crate::time::Frame;

/// Returns the weight of each joint: how far its rotation carries, the largest set to 1, so that fingers cannot outvote
/// an arm.
pub fn weights(clip: &Clip) -> Vec<f64> {
    shares(clip.skeleton())
}

/// Returns the reach of each joint of a skeleton, the largest set to 1.
pub(super) fn shares(skeleton: &Skeleton) -> Vec<f64> {
    let mut weights = skeleton.reaches();
    let largest = weights.iter().copied().fold(0.0, f64::max);
    if largest > 0.0 {
        weights.iter_mut().for_each(|weight| *weight /= largest);
    } else {
        weights.fill(1.0);
    }
    weights
}

/// Returns, for each of some frames in order, the joints that have a key turn within `reach` frames, the heaviest
/// first.
pub(super) fn voters(
    turns: &[Vec<Turn>],
    weights: &[f64],
    frames: &[Frame],
    reach: f64,
) -> Vec<Vec<JointId>> {
    let mut heaviest: Vec<usize> = (0..turns.len()).collect();
    heaviest.sort_by(|a, b| weights[*b].total_cmp(&weights[*a]));
    let mut voters = vec![Vec::new(); frames.len()];
    for joint in heaviest {
        let is_key = |turn: &&Turn| turn.kind == TurnKind::Key;
        let mut turns = turns[joint].iter().filter(is_key).map(|turn| turn.frame).peekable();
        for (frame, voters) in frames.iter().zip(&mut voters) {
            let is_far = |turn: &Frame| frame.0.saturating_sub(turn.0) as f64 >= reach;
            while turns.next_if(is_far).is_some() {}
            let is_near = |turn: &Frame| (turn.0.abs_diff(frame.0) as f64) < reach;
            if turns.peek().is_some_and(is_near) {
                voters.push(JointId(joint));
            }
        }
    }
    voters
}
