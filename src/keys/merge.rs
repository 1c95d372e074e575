//! From the turns of joints to candidates of the layer: the turns of the body, or union, vote and sum of theirs.

use crate::keys::peaks::strongest_apart;
use crate::keys::vote::Poll;
use crate::keys::{AtContacts, BodyTurns, Candidate, Candidates, Choose, Fill, Merge, Wall, sum};
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
    /// The turns of the body.
    pub body: &'a BodyTurns,
    /// Frames on which feet and hands of the layer come down or leave (接地), in order; none where that does
    /// not count.
    pub contacts: &'a [Frame],
}

impl Choose {
    /// Whether what may be a key hangs on the turns of single joints.
    pub(crate) fn hears_joints(&self) -> bool {
        self.merge != Merge::Body || self.contacts == AtContacts::Candidates
    }

    /// What may be a key of the layer, and its walls.
    pub fn candidates(&self, joints: &JointTurns<'_>) -> Candidates {
        if !self.hears_joints() {
            return self.moments(joints.body, joints.apart);
        }
        let mut all = match self.merge {
            Merge::Body => self.all_moments(joints.body, joints.apart),
            Merge::Union | Merge::Vote | Merge::Sum => self.merged(joints),
        };
        if self.contacts == AtContacts::Candidates {
            add_contacts(&mut all.keys, &self.poll(joints), joints);
        }
        let filtered = joints.filtered;
        self.admitted(all, (filtered.first, filtered.frames()), joints.apart)
    }

    /// The same where the turns of single joints have no say.
    pub(crate) fn moments(&self, body: &BodyTurns, apart: f64) -> Candidates {
        let all = self.all_moments(body, apart);
        self.admitted(all, (body.first, body.evidence.len()), apart)
    }

    fn all_moments(&self, body: &BodyTurns, apart: f64) -> Candidates {
        Candidates { keys: moments(body, apart, self.fill), walls: body.walls.clone() }
    }

    /// Those that stand within the clip and are strong enough: on the first and the last koma the clip's ends are shown,
    /// and no other drawing.
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

    /// What the joints say together.
    fn merged(&self, joints: &JointTurns<'_>) -> Candidates {
        let poll = self.poll(joints);
        let found = |kind| {
            let votes = || poll.count(joints.turns, kind);
            match self.merge {
                Merge::Sum => summed(joints, kind),
                Merge::Vote => poll.elected(&votes()),
                Merge::Union | Merge::Body => poll.named(joints.turns, kind, &votes()),
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

/// Adds the ends of contacts that no candidate is nearer to than a koma, with the vote there.
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

/// The turns of the body and, to fill what lies between them, every koma. What is nearer to a turn than a koma is that
/// turn, drawn beside its peak.
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
