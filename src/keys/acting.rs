//! Small acting (小芝居): single parts of a body that act while the body as a whole is quiet.
//!
//! A nod, a gaze or a fist hardly moves any joint, so by its positions the body is at rest. Each part is therefore
//! measured on its own scale: how far it turns against its carrier. While a part acts, the body does not rest, and the
//! part's turn counts as movement. The part then speaks for the body, because no other part moves.

mod parts;
#[cfg(test)]
mod tests;

use std::ops::{Range, RangeInclusive};

use glam::{DQuat, DVec3};

use crate::keys::stillness::{LEAST, SMOOTH, runs, smoothed, steps};
use crate::maths;
use crate::motion::clip::lane_poser::{LanePose, LanePoser};
use crate::motion::lanes::LANES;
use crate::motion::{Build, Clip};
use crate::time::{Clock, Frame};

pub(super) use parts::Part;
use parts::{SPAN, parts};

/// Speed below which a body is quiet, in % of body height a second: by its positions alone it would be at rest.
const QUIET: f64 = 15.0;

/// Speed from which a part may act, in % of body height a second: the head of a person who just stands turns at up to
/// 14°/s.
const SLOW: f64 = 4.0;

/// Numbers that describe how a part is turned.
pub(super) const COLUMNS: usize = 3;

/// The parts that act at some time, and when.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Acting {
    acts: Vec<Act>,
    /// Times of the instants in the clip.
    clock: Option<Clock>,
    /// Whether no movement is large enough to be acting and the body is quiet all the time. The little that its parts
    /// do is then all there is.
    is_slight: bool,
}

/// A part that acts.
#[derive(Debug, Clone, PartialEq)]
struct Act {
    part: Part,
    stretches: Vec<Stretch>,
}

/// A period in which a part acts.
#[derive(Debug, Clone, PartialEq)]
struct Stretch {
    /// The first instant.
    from: usize,
    /// How it is turned at each instant, in % of body height.
    ways: Vec<DVec3>,
}

impl Acting {
    /// Finds acting while the body is quiet. `speeds` are those of its positions into each instant of a clock from the
    /// second on, in the world or on a screen. `own` is the weight of each joint.
    pub(super) fn new(
        clip: &Clip,
        build: &Build,
        clock: Clock,
        (own, is_world): (&[f64], bool),
        speeds: &[f64],
    ) -> Self {
        let (quiet, instants) = (quiet(speeds, clock.koma_rate), speeds.len() + 1);
        let parts = if quiet.is_empty() { Vec::new() } else { parts(build, own, is_world) };
        let mut acts: Vec<Act> =
            parts.into_iter().map(|part| Act { part, stretches: Vec::new() }).collect();
        let mut poser = LanePoser::new(clip);
        for run in &quiet {
            let is_cut = [run.start > 0, run.end < instants];
            let ways = ways(&mut poser, &acts, clock, run.clone(), instants);
            for (act, ways) in acts.iter_mut().zip(ways) {
                act.take(run.start, &ways, when(&ways, clock.koma_rate, is_cut));
            }
        }
        let is_quiet = quiet.first().is_some_and(|run| run.len() == instants);
        let is_slight = is_quiet && acts.iter().all(|act| act.stretches.is_empty());
        if is_slight {
            let ways = ways(&mut poser, &acts, clock, 0..instants, instants);
            for (act, ways) in acts.iter_mut().zip(ways).filter(|(_, ways)| reach(ways) > 0.0) {
                act.stretches.push(Stretch { from: 0, ways });
            }
        }
        acts.retain(|act| !act.stretches.is_empty());
        Self { acts, clock: Some(clock), is_slight }
    }

    /// Number of parts that act.
    pub(super) fn len(&self) -> usize {
        self.acts.len()
    }

    /// Whether no movement is large enough to be acting, so that the little there is counts as all there is.
    pub(super) fn is_slight(&self) -> bool {
        self.is_slight
    }

    /// Whether any part acts between an instant and the next.
    pub(super) fn goes_on(&self, instant: usize) -> bool {
        let mut stretches = self.acts.iter().flat_map(|act| &act.stretches);
        !self.is_slight && stretches.any(|own| own.from <= instant && instant < own.last())
    }

    /// Writes how each part is turned into the last columns of some rows, one row an instant. Turns outside its acting
    /// are left out.
    pub(super) fn write(&self, rows: &mut [f64], columns: usize) {
        let (first, instants) = (columns - COLUMNS * self.len(), rows.len() / columns);
        for (act, own) in self.acts.iter().zip((first..).step_by(COLUMNS)) {
            let mut put = |instants: Range<usize>, way: DVec3| {
                for instant in instants {
                    rows[instant * columns + own..][..COLUMNS].copy_from_slice(&way.to_array());
                }
            };
            let (mut way, mut held) = (DVec3::ZERO, 0);
            for Stretch { from, ways } in &act.stretches {
                put(held..*from, way);
                for (instant, own) in (*from..).zip(ways) {
                    put(instant..instant + 1, way + (*own - ways[0]));
                }
                way += ways[ways.len() - 1] - ways[0];
                held = from + ways.len();
            }
            put(held..instants, way);
        }
    }

    /// Returns the parts, each with its stretches from first to last frame.
    pub(super) fn parts(&self) -> impl Iterator<Item = (&Part, Vec<RangeInclusive<Frame>>)> {
        let frames = |own: &Stretch| {
            let frame = |at| self.clock.map_or(Frame(0), |clock| clock.frame_from_koma(at));
            frame(own.from)..=frame(own.last())
        };
        self.acts.iter().map(move |act| (&act.part, act.stretches.iter().map(frames).collect()))
    }
}

impl Act {
    /// Adds the stretches of `ways` in which the part acts. The first of `ways` is at the instant `first`.
    fn take(&mut self, first: usize, ways: &[DVec3], when: Vec<Range<usize>>) {
        let stretch =
            |own: Range<usize>| Stretch { from: first + own.start, ways: ways[own].to_vec() };
        self.stretches.extend(when.into_iter().map(stretch));
    }
}

impl Stretch {
    /// The last instant.
    fn last(&self) -> usize {
        self.from + self.ways.len() - 1
    }
}

/// Finds the stretches of instants in which a body is quiet.
fn quiet(speeds: &[f64], instants_a_second: f64) -> Vec<Range<usize>> {
    let speeds = smoothed(speeds, steps(SMOOTH, instants_a_second));
    let mut quiet = runs(speeds.len(), |at| speeds[at] < QUIET);
    quiet.retain(|run| run.len() >= steps(LEAST, instants_a_second));
    // Speeds belong to steps: a run of steps spans one instant more.
    quiet.into_iter().map(|run| run.start..run.end + 1).collect()
}

/// Computes how each part is turned against its carrier at the instants of a run, relative to the first of them. It
/// sums the turns of the part's joints in the axes of the carrier, which do not depend on the rig.
fn ways(
    poser: &mut LanePoser<'_>,
    acts: &[Act],
    clock: Clock,
    run: Range<usize>,
    instants: usize,
) -> Vec<Vec<DVec3>> {
    let mut ways: Vec<Vec<DVec3>> = vec![Vec::with_capacity(run.len()); acts.len()];
    let mut first: Vec<Vec<[DQuat; 2]>> = Vec::new();
    for block in run.start / LANES..run.end.div_ceil(LANES) {
        poser.koma(clock, block, instants);
        let pose = poser.stand();
        for lane in (0..LANES).filter(|lane| run.contains(&(LANES * block + lane))) {
            if first.is_empty() {
                first = acts.iter().map(|act| bends(pose, lane, &act.part).collect()).collect();
            }
            for ((act, first), ways) in acts.iter().zip(&first).zip(&mut ways) {
                let turns = bends(pose, lane, &act.part).zip(first);
                let turns = turns
                    .map(|([_, now], [carried, first])| *carried * vector(now * first.conjugate()));
                ways.push(act.part.worth * turns.sum::<DVec3>());
            }
        }
    }
    ways
}

/// Returns, for each joint of a part, how the joint before is turned against the carrier, and the joint against that.
fn bends(pose: &LanePose, lane: usize, part: &Part) -> impl Iterator<Item = [DQuat; 2]> {
    let back = move |joint: usize| pose.rotations[joint].lane(lane).conjugate();
    let rotation = move |joint: usize| pose.rotations[joint].lane(lane);
    part.chain.windows(2).map(move |pair| {
        [back(part.chain[0]) * rotation(pair[0]), back(pair[0]) * rotation(pair[1])]
    })
}

/// Converts a rotation to its axis times its angle in radians, the short way.
fn vector(turn: DQuat) -> DVec3 {
    let (axis, sine) = (turn.xyz(), turn.xyz().length());
    let angle = 2.0 * maths::atan2(sine, turn.w.abs()).copysign(turn.w);
    if sine > 0.0 { axis * (angle / sine) } else { DVec3::ZERO }
}

/// Finds when a part acts: it turns faster than a part that is held, and far enough. A short stop between two movements
/// belongs to the act. Where the quiet is cut off, movement that settles or sets out with the body is part of the
/// body's movement.
fn when(ways: &[DVec3], instants_a_second: f64, [comes, goes]: [bool; 2]) -> Vec<Range<usize>> {
    // Measured over a whole koma: trembling within a koma is no movement.
    let speed = |at: usize| {
        let before = at.saturating_sub(2);
        instants_a_second * ways[before].distance(ways[at]) / (at - before) as f64
    };
    let speeds: Vec<f64> = (1..ways.len()).map(speed).collect();
    let speeds = smoothed(&speeds, steps(SMOOTH, instants_a_second));
    let is_fast = |speed: &&f64| **speed >= 2.0 * SLOW;
    let come = speeds.iter().take_while(is_fast).count() * usize::from(comes);
    let go = speeds.iter().rev().take_while(is_fast).count() * usize::from(goes);
    let may_act = |at: usize| (come..speeds.len().saturating_sub(go)).contains(&at);
    let mut acts: Vec<Range<usize>> = Vec::new();
    for run in runs(speeds.len(), |at| may_act(at) && speeds[at] >= SLOW) {
        // The speed of a step joins one instant more.
        let end = run.end + 1;
        match acts.last_mut() {
            Some(last) if run.start + 1 - last.end < steps(LEAST, instants_a_second) => {
                last.end = end
            }
            _ => acts.push(run.start..end),
        }
    }
    acts.retain(|act| reach(&ways[act.clone()]) >= SPAN);
    acts
}

/// Returns how far something goes: from the point furthest from its begin to the point furthest from there.
fn reach(ways: &[DVec3]) -> f64 {
    let furthest = |from: DVec3| {
        let far = |a: &&DVec3, b: &&DVec3| from.distance(**a).total_cmp(&from.distance(**b));
        ways.iter().max_by(far).copied().unwrap_or(from)
    };
    let far = furthest(ways[0]);
    far.distance(furthest(far))
}
