//! Cycles (循環): stretches of a motion that end in the pose in which they begin, so that they can be repeated.

use glam::DVec3;

use crate::error::Warning;
use crate::keys::Reference;
use crate::motion::{Build, Clip, Gait, travellers};
use crate::time::{Frame, FrameRate, KOMA_RATE};

/// Warning code: the clip's last pose is its first, and nobody asked for a loop.
pub const IS_CYCLE: &str = "W_CYCLE";

/// Largest distance of two poses that count as one, in % of body height, and as a share of how far the body goes in
/// between.
const SAME: f64 = 2.0;
const SAME_SHARE: f64 = 0.25;

/// Largest difference of their velocities, in % of body height a second: half of what a step of a walk reaches.
const SAME_SPEED: f64 = 40.0;

/// Least way of a body that moves, in % of body height.
const MOVES: f64 = 1.0;

/// Largest distance of the ends of a stretch that is repeated when a person asks for it, in % of body height.
const REPEATABLE: f64 = 10.0;

/// Seconds of a cycle that is searched for where there is no gait.
const SECONDS: (f64, f64) = (0.4, 4.0);

/// Most cycles that a search returns.
const MOST: usize = 12;

/// Koma by which a cycle of a gait may end earlier or later than the foot comes down.
const SLACK: f64 = 1.5;

/// Koma that two cycles without a gait differ by, at either end: else they are one.
const OTHER: usize = 4;

/// A stretch of a clip, and how well its end meets its begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Its first frame.
    pub first: Frame,
    /// Its last frame, which shows the first pose again.
    pub last: Frame,
    /// Distance of the two poses with travel left out: root mean square over the body's points, in % of body height.
    pub pose: f64,
    /// Difference of the velocities at the two, in % of body height a second.
    pub speed: f64,
    /// Largest distance of a pose in between from the first, in % of body height.
    pub reach: f64,
}

impl Cycle {
    /// Measures a whole clip; `None` if it has too few frames to have a velocity at each end.
    pub fn of_clip(clip: &Clip) -> Option<Self> {
        Self::measured(clip, &Build::new(clip), &[(clip.first(), clip.last())]).pop()
    }

    /// Finds the best cycles of a clip, the closest first. Those of a gait go from the contact of a foot to its next or
    /// second next one. A clip without a gait is searched for the closest poses that are 0.4 to 4 seconds apart.
    pub fn find_all(clip: &Clip) -> Vec<Self> {
        let build = Build::new(clip);
        let mut cycles = of_gaits(clip, &build);
        if cycles.is_empty() {
            cycles = of_poses(clip, &build);
        }
        cycles.sort_by(|a, b| a.gap().total_cmp(&b.gap()).then(a.first.cmp(&b.first)));
        cycles.truncate(MOST);
        cycles
    }

    /// Returns how far the body jumps from the end to the begin within a koma, in % of body height.
    fn gap(&self) -> f64 {
        self.pose + self.speed / KOMA_RATE
    }

    /// Number of frames from the first pose to the same pose.
    pub fn frames(&self) -> usize {
        self.last.0 - self.first.0
    }

    /// Returns the time of a round in koma of 1/24 s.
    pub fn koma(&self, rate: FrameRate) -> f64 {
        self.frames() as f64 * KOMA_RATE / rate.fps()
    }

    /// Whether the last pose is the first, for all that is seen, and the body moves in between.
    pub fn is_closed(&self) -> bool {
        let moves = self.reach >= MOVES;
        moves && self.pose <= SAME.min(SAME_SHARE * self.reach) && self.speed <= SAME_SPEED
    }

    /// Whether the ends are near enough for a loop that a person asks for.
    pub fn is_repeatable(&self) -> bool {
        self.pose <= REPEATABLE
    }

    /// Returns the note that a clip can be repeated; `None` if its last pose is not the first.
    pub fn note(clip: &Clip) -> Option<Warning> {
        Self::of_clip(clip).filter(Self::is_closed)?;
        let message = "the last pose is the first: the setting loop makes a sheet that repeats";
        Some(Warning::new(IS_CYCLE, message))
    }

    /// Measures stretches of a clip. Those that are too short are left out.
    fn measured(clip: &Clip, build: &Build, stretches: &[(Frame, Frame)]) -> Vec<Self> {
        // Half a koma: a single frame of a fast capture trembles.
        let step = ((clip.rate().fps() / KOMA_RATE / 2.0).round() as usize).max(1);
        let is_long = |(first, last): &&(Frame, Frame)| last.0 > first.0 + 4 * step;
        let stretches: Vec<_> = stretches.iter().filter(is_long).copied().collect();
        let rows = |&(first, last): &(Frame, Frame)| {
            let ends = (0..3).flat_map(move |at| [first.0 + at * step, last.0 - at * step]);
            ends.chain(between(first.0, last.0))
        };
        let poses = Poses::new(clip, build, stretches.iter().flat_map(rows).collect());
        let measure = |&(first, last): &(Frame, Frame)| Self {
            first,
            last,
            pose: poses.apart(first.0, last.0),
            speed: poses.speed_apart([first.0, last.0], step, clip.rate().fps()),
            reach: between(first.0, last.0)
                .map(|frame| poses.apart(first.0, frame))
                .fold(0.0, f64::max),
        };
        stretches.iter().map(measure).collect()
    }
}

/// Returns frames spread evenly over a stretch.
fn between(first: usize, last: usize) -> impl Iterator<Item = usize> {
    const PARTS: usize = 12;
    (1..PARTS).map(move |part| first + (last - first) * part / PARTS)
}

/// The poses of some frames of a clip.
struct Poses {
    /// The frames, sorted.
    frames: Vec<usize>,
    still: Spot,
}

/// Poses that are compared where the body stands.
struct Spot {
    reference: Reference,
    /// The joint that carries the body through the room; its way is left out.
    carrier: Option<usize>,
}

impl Spot {
    fn new(clip: &Clip, reference: Reference) -> Self {
        Self { reference, carrier: travellers(clip).first().copied() }
    }

    /// Returns the distance of the poses of two koma with travel left out, in % of body height.
    fn apart(&self, a: usize, b: usize) -> f64 {
        // The points begin with the joints.
        let carrier = |koma: usize| self.reference.still(koma).nth(self.carrier.unwrap_or(0));
        let way = carrier(b).zip(carrier(a)).map_or(DVec3::ZERO, |(b, a)| b - a);
        let way = if self.carrier.is_some() { way } else { DVec3::ZERO };
        self.reference
            .way(self.reference.still(a).map(|place| place + way), self.reference.still(b))
    }
}

impl Poses {
    fn new(clip: &Clip, build: &Build, mut frames: Vec<usize>) -> Self {
        frames.sort_unstable();
        frames.dedup();
        let rows = frames.iter().flat_map(|frame| clip.row(Frame(*frame))).copied().collect();
        let skeleton = clip.skeleton().clone();
        let rows = Clip::of_finite(skeleton, clip.rate(), Frame(0), frames.len(), rows);
        let (clock, own) = (rows.clock(rows.rate().fps()), vec![1.0; rows.skeleton().len()]);
        let reference = Reference::of_build(&rows, build, clock, &own);
        Self { frames, still: Spot::new(clip, reference) }
    }

    fn row(&self, frame: usize) -> usize {
        self.frames.partition_point(|other| *other < frame)
    }

    /// Returns the positions of the body's points at a frame.
    fn at(&self, frame: usize) -> impl Iterator<Item = DVec3> {
        self.still.reference.still(self.row(frame))
    }

    /// Returns the distance of two poses with travel left out, in % of body height.
    fn apart(&self, a: usize, b: usize) -> f64 {
        self.still.apart(self.row(a), self.row(b))
    }

    /// Returns the difference of the velocities at the first and at the last frame of a stretch, in % of body height a
    /// second. Both are taken from poses inside the stretch, to the second order, as nothing is known of the outside.
    fn speed_apart(&self, [first, last]: [usize; 2], step: usize, fps: f64) -> f64 {
        let outwards = |places: [usize; 3], sign: f64| {
            let [end, inner, innermost] = places.map(|frame| self.at(frame));
            let way =
                move |((a, b), c): ((DVec3, DVec3), DVec3)| 0.5 * sign * (3.0 * a - 4.0 * b + c);
            end.zip(inner).zip(innermost).map(way)
        };
        let into = outwards([last, last - step, last - 2 * step], 1.0);
        let out = outwards([first, first + step, first + 2 * step], -1.0);
        self.still.reference.way(into, out) * fps / step as f64
    }
}

/// Returns the cycles of the gaits of a clip, each with the end that meets its begin best.
fn of_gaits(clip: &Clip, build: &Build) -> Vec<Cycle> {
    let clock = clip.clock(KOMA_RATE);
    let koma = clock.frames_in_koma();
    let frame = |instant: f64| clip.first().0 as f64 + instant * koma;
    let (begin, end) = (clip.first().0, clip.last().0);
    let mut stretches = Vec::new();
    for gait in Gait::find_all(clip, build, clock) {
        let last = gait.steps.last().map(|step| step.next);
        let contacts = gait.steps.iter().map(|step| step.contact).chain(last);
        let contacts: Vec<f64> = contacts.map(frame).collect();
        // Feet alternate: two contacts further the same foot comes down.
        for strides in [2, 4] {
            for (from, to) in contacts.iter().zip(contacts.iter().skip(strides)) {
                let (from, slack) = (from.round(), SLACK * koma);
                let to = (to - slack).round().max(0.0) as usize..=(to + slack).round() as usize;
                if from >= begin as f64 {
                    let to = to.filter(|to| *to <= end);
                    stretches.push(to.map(|to| (Frame(from as usize), Frame(to))).collect());
                }
            }
        }
    }
    let best = |ends: &Vec<(Frame, Frame)>| {
        let cycles = Cycle::measured(clip, build, ends);
        cycles.into_iter().min_by(|a, b| a.gap().total_cmp(&b.gap()))
    };
    stretches.iter().filter_map(best).collect()
}

/// Returns stretches whose ends are closest, by their poses on the koma.
fn of_poses(clip: &Clip, build: &Build) -> Vec<Cycle> {
    let (clock, own) = (clip.clock(KOMA_RATE), vec![1.0; clip.skeleton().len()]);
    let poses = Spot::new(clip, Reference::of_build(clip, build, clock, &own));
    let all = poses.reference.koma();
    let [least, most] = [SECONDS.0, SECONDS.1].map(|seconds| (seconds * KOMA_RATE) as usize);
    let mut pairs = Vec::new();
    for from in 0..all {
        let (mut reach, mut best) = (0.0_f64, None::<(f64, usize)>);
        for to in from + 1..all.min(from + most + 1) {
            let apart = poses.apart(from, to);
            reach = reach.max(apart);
            let moves = reach >= MOVES && apart <= SAME_SHARE * reach;
            let is_near = moves && to >= from + least;
            if is_near && best.is_none_or(|(before, _)| apart < before) {
                best = Some((apart, to));
            }
        }
        pairs.extend(best.map(|(apart, to)| (apart, from, to)));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<(usize, usize)> = Vec::new();
    for (_, from, to) in pairs {
        let is_other =
            |(a, b): &(usize, usize)| a.abs_diff(from) >= OTHER || b.abs_diff(to) >= OTHER;
        if found.len() < MOST && found.iter().all(is_other) {
            found.push((from, to));
        }
    }
    let frame = |koma: usize| clock.frame_from_koma(koma).min(clip.last());
    let found: Vec<_> = found.into_iter().map(|(from, to)| (frame(from), frame(to))).collect();
    Cycle::measured(clip, build, &found)
}

#[cfg(test)]
mod tests;
