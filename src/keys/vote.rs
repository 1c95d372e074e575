//! Lets joints vote for a layer's keys: each turn of a joint speaks for the frames around it.

use crate::keys::peaks::{peaks, strongest_apart};
use crate::signal::{Turn, TurnKind};
use crate::time::Frame;

/// The frames of a vote, and the weight of each joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Poll<'a> {
    /// The first frame of the clip.
    pub(super) first: Frame,
    /// Number of frames of the clip.
    pub(super) frames: usize,
    /// One weight a joint, at least 0.
    pub(super) weights: &'a [f64],
    /// Reach of a vote, in frames.
    pub(super) reach: f64,
    /// The least distance of two keys, in frames.
    pub(super) apart: f64,
}

impl Poll<'_> {
    /// Counts the vote on each frame as a share of all weight, 0 to 1. Every joint with any turn adds its weight times
    /// the triangular kernel 1 − distance/reach to its nearest turn, so that no joint counts twice at one time.
    pub(super) fn count(&self, turns: &[Vec<Turn>], kind: TurnKind) -> Vec<f64> {
        let mut votes = vec![0.0; self.frames];
        let mut all_weight = 0.0;
        let mut rows = Vec::new();
        let kernel = self.kernel();
        for (turns, weight) in turns.iter().zip(self.weights) {
            rows.clear();
            rows.extend(
                turns.iter().filter(|turn| turn.kind == kind).map(|turn| self.row(turn.frame)),
            );
            if !turns.is_empty() {
                all_weight += weight;
            }
            self.speak(&rows, *weight, &kernel, &mut votes);
        }
        if all_weight > 0.0 {
            votes.iter_mut().for_each(|vote| *vote /= all_weight);
        }
        votes
    }

    /// Returns the vote of a turn at each distance, from 0 on.
    fn kernel(&self) -> Vec<f64> {
        let carries = (self.reach.ceil() as usize).min(self.frames);
        let says = |distance: usize| (1.0 - distance as f64 / self.reach).max(0.0);
        std::iter::once(1.0).chain((1..=carries).map(says)).collect()
    }

    /// Adds one joint's votes; `rows` are its turns in order.
    fn speak(&self, rows: &[usize], weight: f64, kernel: &[f64], votes: &mut [f64]) {
        let mut from = 0;
        let carries = kernel.len() - 1;
        for (turn, &row) in rows.iter().enumerate() {
            // Frames up to half way to the next turn are nearest to this one.
            let past = rows.get(turn + 1).map_or(self.frames, |next| (row + next) / 2 + 1);
            let begin = from.max(row.saturating_sub(carries));
            let end = past.min(row + carries + 1).min(self.frames);
            let (before, after) = votes[begin..end].split_at_mut(row - begin);
            for (vote, says) in before.iter_mut().rev().zip(&kernel[1..]) {
                *vote += weight * says;
            }
            for (vote, says) in after.iter_mut().zip(kernel) {
                *vote += weight * says;
            }
            from = past;
        }
    }

    /// Finds the local maxima of a vote, at least `apart` from each other, with their share.
    pub(super) fn elected(&self, votes: &[f64]) -> Vec<(Frame, f64)> {
        // A sum of shares is exact to about 1e-16 a joint; that must not break up a plateau.
        let found = peaks(votes, 1e-12).into_iter().map(|row| (row, votes[row])).collect();
        self.frames_of(strongest_apart(found, self.apart))
    }

    /// Returns the frames at which any joint has a turn, at least `apart` from each other.
    pub(super) fn named(
        &self,
        turns: &[Vec<Turn>],
        kind: TurnKind,
        votes: &[f64],
    ) -> Vec<(Frame, f64)> {
        let mut named = vec![false; self.frames];
        for turn in turns.iter().flatten().filter(|turn| turn.kind == kind) {
            named[self.row(turn.frame)] = true;
        }
        let rows = (0..self.frames).filter(|row| named[*row]);
        let found = rows.map(|row| (row, votes[row])).collect();
        self.frames_of(strongest_apart(found, self.apart))
    }

    fn frames_of(&self, rows: Vec<(usize, f64)>) -> Vec<(Frame, f64)> {
        rows.into_iter()
            .filter(|(_, strength)| *strength > 0.0)
            .map(|(row, strength)| (Frame(self.first.0 + row), strength))
            .collect()
    }

    fn row(&self, frame: Frame) -> usize {
        frame.0 - self.first.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turns(frames: &[&[usize]]) -> Vec<Vec<Turn>> {
        let turn =
            |frame: &usize| Turn { frame: Frame(*frame), kind: TurnKind::Key, confirmed_for: 9 };
        frames.iter().map(|joint| joint.iter().map(turn).collect()).collect()
    }

    fn poll(weights: &[f64]) -> Poll<'_> {
        Poll { first: Frame(100), frames: 60, weights, reach: 4.0, apart: 5.0 }
    }

    #[test]
    fn a_joint_counts_once_at_a_time_and_by_its_weight() {
        let votes = poll(&[1.0, 3.0]).count(&turns(&[&[110, 112], &[130]]), TurnKind::Key);
        assert_eq!(votes[10], 0.25);
        assert_eq!(votes[11], 0.25 * 0.75, "the nearer turn alone speaks");
        assert_eq!(votes[30], 0.75);
        assert_eq!(votes[33], 0.75 * 0.25);
        assert_eq!((votes[34], votes[26], votes[14]), (0.0, 0.0, 0.25 * 0.5));
    }

    #[test]
    fn the_vote_equals_a_brute_force_count() {
        let turns = turns(&[&[101, 104, 105, 120], &[], &[118, 121, 158], &[159]]);
        let weights = [0.3, 1.0, 0.7, 0.2];
        let poll = poll(&weights);
        let votes = poll.count(&turns, TurnKind::Key);
        for (at, vote) in votes.iter().enumerate() {
            let kernel = |turn: &Turn| 1.0 - (turn.frame.0 as f64 - 100.0 - at as f64).abs() / 4.0;
            let says = |joint: &Vec<Turn>| joint.iter().map(kernel).fold(0.0, f64::max);
            let slow: f64 =
                turns.iter().zip(weights).map(|(joint, weight)| weight * says(joint)).sum();
            assert!((vote - slow / 1.2).abs() < 1e-15, "frame {at}: {vote} {}", slow / 1.2);
        }
    }

    #[test]
    fn joints_that_agree_elect_the_middle_between_them() {
        let poll = poll(&[1.0, 1.0]);
        let votes = poll.count(&turns(&[&[120], &[124]]), TurnKind::Key);
        assert_eq!(poll.elected(&votes), [(Frame(122), 0.5)]);
        let named = poll.named(&turns(&[&[120], &[124]]), TurnKind::Key, &votes);
        assert_eq!(named, [(Frame(120), 0.5)], "a koma apart or not at all, the earlier of equals");
    }

    #[test]
    fn nobody_turns_and_nobody_is_elected() {
        let poll = poll(&[1.0]);
        let votes = poll.count(&turns(&[&[]]), TurnKind::Key);
        assert_eq!(votes, [0.0; 60]);
        assert!(poll.elected(&votes).is_empty());
        let keys = turns(&[&[120]]);
        assert_eq!(poll.count(&keys, TurnKind::Wall), [0.0; 60], "a key is no vote for a wall");
    }
}
