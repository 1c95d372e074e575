//! Merges the turns of joints into candidates of the layer: the turns of the body, or a union or a vote.

use crate::keys::vote::Poll;
use crate::keys::{AtContacts, BodyTurns, Candidate, Candidates, Choose, Fill, Merge, Wall};
use crate::signal::{Signals, Turn, TurnKind};
use crate::time::Frame;

/// The joints' data that are merged.
#[derive(Debug, Clone, Copy)]
pub struct JointTurns<'a> {
    /// The smoothed speeds.
    pub filtered: &'a Signals,
    /// Their turns, one list a joint.
    pub turns: &'a [Vec<Turn>],
    /// One weight a joint, at least 0: see [`weights`](crate::keys::weights).
    pub weights: &'a [f64],
    /// The least distance of two keys, in frames: one koma.
    pub apart: f64,
    /// The turns of the body.
    pub body: &'a BodyTurns,
    /// Frames on which feet and hands of the layer come down or leave (接地), in order; empty if contacts do not count.
    pub contacts: &'a [Frame],
}

impl Choose {
    /// Whether the candidates depend on the turns of single joints.
    pub(crate) fn hears_joints(&self) -> bool {
        self.merge != Merge::Body || self.contacts == AtContacts::Candidates
    }

    /// Returns the key candidates of the layer, and its walls.
    pub fn candidates(&self, joints: &JointTurns<'_>) -> Candidates {
        if !self.hears_joints() {
            return self.moments(joints.body, joints.apart);
        }
        let mut all = match self.merge {
            Merge::Body => self.all_moments(joints.body, joints.apart),
            Merge::Union | Merge::Vote => self.merged(joints),
        };
        if self.contacts == AtContacts::Candidates {
            add_contacts(&mut all.keys, &self.poll(joints), joints);
        }
        let filtered = joints.filtered;
        self.admitted(all, (filtered.first, filtered.frames()), joints.apart)
    }

    /// Returns the candidates if the turns of single joints do not count.
    pub(crate) fn moments(&self, body: &BodyTurns, apart: f64) -> Candidates {
        let all = self.all_moments(body, apart);
        self.admitted(all, (body.first, body.evidence.len()), apart)
    }

    fn all_moments(&self, body: &BodyTurns, apart: f64) -> Candidates {
        Candidates { keys: moments(body, apart, self.fill), walls: body.walls.clone() }
    }

    /// Keeps the candidates that lie within the clip and are strong enough. The first and the last koma show the clip's
    /// ends, and no other drawing.
    fn admitted(
        &self,
        Candidates { mut keys, walls }: Candidates,
        (first, frames): (Frame, usize),
        apart: f64,
    ) -> Candidates {
        let koma = |row: usize| row as f64 / apart;
        let last = (koma(frames.saturating_sub(1)) + 1e-9).floor();
        keys.retain(|key| {
            let koma = (koma(key.frame.0 - first.0) + 0.5).floor();
            0.0 < koma && koma < last && key.strength >= self.min_strength
        });
        Candidates { keys, walls }
    }

    /// Merges the turns of the joints.
    fn merged(&self, joints: &JointTurns<'_>) -> Candidates {
        let poll = self.poll(joints);
        let found = |kind| {
            let votes = poll.count(joints.turns, kind);
            match self.merge {
                Merge::Vote => poll.elected(&votes),
                Merge::Union | Merge::Body => poll.named(joints.turns, kind, &votes),
            }
        };
        let key = |(frame, strength)| Candidate { frame, strength, is_turn: true };
        let wall = |(frame, strength)| Wall { frame, strength };
        Candidates {
            keys: found(TurnKind::Key).into_iter().map(key).collect(),
            walls: found(TurnKind::Wall).into_iter().map(wall).collect(),
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

/// Adds the ends of contacts that are at least a koma from every candidate, with the vote there.
fn add_contacts(keys: &mut Vec<Candidate>, poll: &Poll<'_>, joints: &JointTurns<'_>) {
    let votes = poll.count(joints.turns, TurnKind::Key);
    for &frame in joints.contacts {
        if !is_taken(keys, |other| other.frame, frame, joints.apart) {
            let at = keys.partition_point(|other| other.frame < frame);
            let strength = votes[frame.0 - poll.first.0];
            keys.insert(at, Candidate { frame, strength, is_turn: true });
        }
    }
}

/// Whether one of some moments, sorted by frame, is nearer to a frame than `apart`.
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

/// Returns the turns of the body and, to fill the time between them, every koma. A koma nearer to a turn than `apart`
/// is that turn, drawn beside its peak.
fn moments(body: &BodyTurns, apart: f64, fill: Fill) -> Vec<Candidate> {
    let BodyTurns { first, turns, evidence, .. } = body;
    let past = first.0 + evidence.len();
    let koma = |at: usize| Frame(first.0 + (at as f64 * apart).round() as usize);
    let grid = (0..).map(koma).take_while(|frame| fill == Fill::On && frame.0 < past);
    let mut frames: Vec<Frame> = grid.chain(turns.iter().copied()).collect();
    frames.sort_unstable();
    frames.dedup();
    let candidate = |frame: Frame| Candidate {
        frame,
        strength: evidence[frame.0 - first.0],
        is_turn: is_taken(turns, |turn| *turn, frame, apart),
    };
    frames.into_iter().map(candidate).collect()
}
