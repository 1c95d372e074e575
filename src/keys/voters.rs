//! Which joints speak for a key, and what each one's word is worth.

use crate::motion::{Clip, JointId};
use crate::signal::{Turn, TurnKind};
use crate::time::Frame;

/// The weight of each joint: how far its rotation carries, the largest set to 1, so that fingers
/// cannot outvote an arm.
pub fn weights(clip: &Clip) -> Vec<f64> {
    let mut weights = clip.skeleton().reaches();
    let largest = weights.iter().copied().fold(0.0, f64::max);
    if largest > 0.0 {
        weights.iter_mut().for_each(|weight| *weight /= largest);
    } else {
        weights.fill(1.0);
    }
    weights
}

/// The joints that have a key turn of their own within `reach` frames, the heaviest first.
pub(super) fn voters(
    turns: &[Vec<Turn>],
    weights: &[f64],
    frame: Frame,
    reach: f64,
) -> Vec<JointId> {
    let near =
        |turn: &Turn| turn.kind == TurnKind::Key && (turn.frame.0.abs_diff(frame.0) as f64) < reach;
    let from = Frame(frame.0.saturating_sub(reach.ceil() as usize));
    let speaks = |turns: &Vec<Turn>| {
        let begin = turns.partition_point(|turn| turn.frame < from);
        turns[begin..]
            .iter()
            .take_while(|turn| turn.frame.0 <= frame.0.saturating_add(reach as usize))
            .any(near)
    };
    let joints = turns.iter().enumerate().filter(|(_, turns)| speaks(turns));
    let mut voters: Vec<JointId> = joints.map(|(joint, _)| JointId(joint)).collect();
    voters.sort_by(|a, b| weights[b.0].total_cmp(&weights[a.0]));
    voters
}
