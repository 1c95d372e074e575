//! From the turns of joints to candidates of the layer: every moment, union, vote or sum.

use crate::keys::chords::STEP;
use crate::keys::peaks::strongest_apart;
use crate::keys::vote::Poll;
use crate::keys::{AtContacts, Candidate, Candidates, Choose, Merge, Rank, Wall, sum};
use crate::signal::{Signals, Turn, TurnFinder, TurnKind};
use crate::time::Frame;

/// What is known of the joints when they are merged.
#[derive(Debug, Clone, Copy)]
pub struct JointTurns<'a> {
    /// The smoothed speeds.
    pub filtered: &'a Signals,
    /// Their turns, one list a joint.
    pub turns: &'a [Vec<Turn>],
    /// What finds turns: `sum` looks for those of the whole layer.
    pub finder: &'a TurnFinder,
    /// The delay of the filter, in frames.
    pub delay: f64,
    /// One value a joint, at least 0: see [`weights`](crate::keys::weights).
    pub weights: &'a [f64],
    /// The least distance of two keys, in frames: one koma.
    pub apart: f64,
    /// Frames on which feet and hands of the layer come down or leave (接地), in order; none where that does
    /// not count.
    pub contacts: &'a [Frame],
}

impl Choose {
    /// What the joints say together.
    pub fn candidates(&self, joints: &JointTurns<'_>) -> Candidates {
        let filtered = joints.filtered;
        let poll = self.poll(joints);
        let elected = |kind| poll.elected(&poll.count(joints.turns, kind));
        let named = |kind| poll.named(joints.turns, kind, &poll.count(joints.turns, kind));
        let merged = |kind| match (self.merge, kind) {
            (Merge::Every, TurnKind::Key) if self.rank == Rank::Price => every(&poll, joints),
            (Merge::Sum, _) => summed(joints, kind),
            (Merge::Vote, _) => elected(kind),
            (Merge::Union | Merge::Every, _) => named(kind),
        };
        // On the first and the last koma the clip's ends are shown, and no other drawing.
        let koma = |row: usize| row as f64 / joints.apart;
        let last = (koma(filtered.frames().saturating_sub(1)) + 1e-9).floor();
        let inside = |frame: Frame| {
            let koma = (koma(frame.0 - filtered.first.0) + 0.5).floor();
            0.0 < koma && koma < last
        };
        let mut keys = merged(TurnKind::Key);
        if self.contacts == AtContacts::Candidates {
            add_contacts(&mut keys, &poll, joints);
        }
        Candidates {
            keys: keys
                .into_iter()
                .filter(|(frame, strength)| inside(*frame) && *strength >= self.min_strength)
                .map(|(frame, strength)| Candidate { frame, strength })
                .collect(),
            walls: merged(TurnKind::Wall)
                .into_iter()
                .map(|(frame, strength)| Wall { frame, strength })
                .collect(),
        }
    }

    fn poll<'a>(&self, joints: &JointTurns<'a>) -> Poll<'a> {
        let filtered = joints.filtered;
        Poll {
            first: filtered.first,
            frames: filtered.frames(),
            weights: joints.weights,
            reach: self.reach.frames(filtered.rate),
            apart: joints.apart,
        }
    }
}

/// Adds the ends of contacts that no candidate is nearer to than a koma, with the vote there.
fn add_contacts(keys: &mut Vec<(Frame, f64)>, poll: &Poll<'_>, joints: &JointTurns<'_>) {
    let votes = poll.count(joints.turns, TurnKind::Key);
    for &frame in joints.contacts {
        if !is_taken(keys, |(other, _)| *other, frame, joints.apart) {
            let at = keys.partition_point(|(other, _)| *other < frame);
            keys.insert(at, (frame, votes[frame.0 - poll.first.0]));
        }
    }
}

/// Whether one of some moments, in the order of their frames, is nearer to a frame than `apart`.
pub(super) fn is_taken<T>(
    moments: &[T],
    frame_of: impl Fn(&T) -> Frame,
    frame: Frame,
    apart: f64,
) -> bool {
    let after = moments.partition_point(|moment| frame_of(moment) < frame);
    let mut beside = moments[after.saturating_sub(1)..].iter().take(2);
    beside.any(|moment| (frame_of(moment).0.abs_diff(frame.0) as f64) < apart)
}

/// The frames nearest to each half koma, with the vote there.
fn every(poll: &Poll<'_>, joints: &JointTurns<'_>) -> Vec<(Frame, f64)> {
    let votes = poll.count(joints.turns, TurnKind::Key);
    let row = |instant: usize| (instant as f64 * STEP * joints.apart).round() as usize;
    let mut rows: Vec<usize> = (0..).map(row).take_while(|row| *row < votes.len()).collect();
    rows.dedup();
    rows.into_iter().map(|row| (Frame(poll.first.0 + row), votes[row])).collect()
}

/// The turns of the layer's mean speed, with their prominence.
fn summed(joints: &JointTurns<'_>, kind: TurnKind) -> Vec<(Frame, f64)> {
    let mean = sum::mean_speed(joints.filtered, joints.weights);
    let turns = joints.finder.find(&mean, joints.delay).pop().unwrap_or_default();
    let margin = (joints.delay.round() as usize).min(mean.frames()) + 1;
    let mut found = sum::prominences(&mean, &turns, kind, margin);
    found.retain(|(_, strength)| *strength > 0.0);
    let rows = found.into_iter().map(|(frame, strength)| (frame.0, strength)).collect();
    let apart = strongest_apart(rows, joints.apart);
    apart.into_iter().map(|(frame, strength)| (Frame(frame), strength)).collect()
}
