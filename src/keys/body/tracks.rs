//! Tracks (軌跡): the velocities of everything that turns or moves in a layer, as vectors in % of body height a second.

use std::array;
use std::ops::Range;
use std::slice::ChunksExactMut;

use glam::{DQuat, DVec3};
use nalgebra::DMatrix;

use super::crispness::crispness;
use crate::keys::acting::{Acting, Part};
use crate::keys::voters::shares;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::clip::lane_poser::{LanePose, LanePoser};
use crate::motion::lanes::{LANES, LaneVec, Lanes, pieces, wide};
use crate::motion::{Build, Clip, Joint, JointId, Point, Screen};
use crate::signal::{Quantity, Signals, Spectrum};

/// Reach of a joint that carries a whole chain of bones, in body heights.
const REACH: f64 = 0.75;

/// Weight of the rotation of a joint that carries a whole chain; the position of a limb's end has 1.
const ROTATION: f64 = 0.5 * REACH;

/// Weight of each track of a gait.
const GAIT: f64 = 2.0;

/// Total weight of the tips of a body without limbs: that of a person's positions.
const TIPS: f64 = 6.0;

/// The motion of a layer, and what is known about its body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LayerMotion<'a> {
    /// The motion in which only the layer's joints move.
    pub(crate) clip: &'a Clip,
    /// The build of the whole body.
    pub(crate) build: &'a Build,
    /// Weight of each joint's rotation; 0 for no track.
    pub(crate) heard: &'a [f64],
    /// Weight of each joint's position; 0 for no track.
    pub(crate) judged: &'a [f64],
    /// The screen on which positions are seen.
    pub(crate) screen: &'a Screen,
    /// Height of the body in the file's unit, if the build has none.
    pub(crate) height: f64,
    /// Parts that act while the whole body is quiet.
    pub(crate) acting: &'a Acting,
}

/// The velocities of a layer. Another filter needs no new ones.
#[derive(Debug, Clone)]
pub(crate) struct Tracks {
    /// Three columns a track: the step from each frame to the next, one fewer than there are frames.
    pub(super) steps: Spectrum,
    /// One weight a track, above 0. Those of the body sum to 1. Parts that act while the rest is quiet come on top,
    /// each as loud as a whole body.
    pub(super) weights: Vec<f64>,
    /// Number of tracks of the body; they come before those of acting parts.
    pub(super) of_body: usize,
}

/// A joint that turns.
struct Turning {
    joint: usize,
    /// Its reach, in % of body height.
    reach: f64,
    weight: f64,
}

/// A part that turns against its carrier while the rest of the body is quiet.
struct Acts<'a> {
    part: &'a Part,
    weight: f64,
    /// Steps in which it acts, numbered by the frame that each leads to.
    when: Vec<Range<usize>>,
}

/// A place whose movement is tracked.
struct Travelling {
    what: Place,
    weight: f64,
}

/// A place on a body, or the vector from one place to another.
#[derive(Clone, Copy)]
enum Place {
    /// A point.
    Of(Point),
    /// The middle of two points.
    Between(Point, Point),
    /// The second of two points seen from the first.
    From(Point, Point),
    /// The height of the middle of two points.
    Height(Point, Point),
}

impl Tracks {
    /// Measures the tracks of a layer.
    pub(crate) fn new(motion: &LayerMotion<'_>) -> Self {
        let clip = motion.clip;
        let (turning, travelling) = (turning(motion), travelling(motion));
        let acting = acting(motion);
        let weights = turning.iter().map(|track| track.weight);
        let weights: Vec<f64> =
            weights.chain(travelling.iter().map(|track| track.weight)).collect();
        let all: f64 = weights.iter().sum();
        let weights = weights.into_iter().map(|own| own / all);
        let weights: Vec<f64> = weights.chain(acting.iter().map(|track| track.weight)).collect();
        let of_body = weights.len() - acting.len();
        let (steps, columns) = (clip.len() - 1, 3 * weights.len());
        let mut values = vec![0.0; steps * columns];
        if clip.len() > 1 {
            let mut following = Following::new(motion, &turning, &travelling, &acting);
            for piece in pieces(clip.len().div_ceil(LANES)) {
                wide(
                    #[inline(always)]
                    || following.write(piece, &mut values),
                );
            }
        }
        let values = DMatrix::from_vec(steps, columns, values);
        let signals =
            Signals { values, unit: Quantity::Ratio, rate: clip.rate(), first: clip.first() };
        Self { steps: Spectrum::from(signals), weights, of_body }
    }

    /// Measures the tracks of a whole body without acting parts.
    pub(crate) fn of_all(clip: &Clip, build: &Build, screen: &Screen, height: f64) -> Self {
        let all = vec![1.0; clip.skeleton().len()];
        let (heard, judged, acting) = (&all[..], &all[..], &Acting::default());
        Self::new(&LayerMotion { clip, build, heard, judged, screen, height, acting })
    }

    /// Returns how suddenly the body changes its velocities, from 0 for a capture to 1 for nothing but kinks.
    pub(crate) fn crispness(&self) -> f64 {
        crispness(self)
    }
}

/// Returns the rotations [KT11 §3.1] of all joints that turn and have a weight, weighted by the bones they carry.
fn turning(motion: &LayerMotion<'_>) -> Vec<Turning> {
    let turns = motion.clip.turning_joints();
    let track = |(joint, carried): (usize, f64)| Turning {
        joint,
        reach: 100.0 * REACH * carried,
        weight: ROTATION * carried * motion.heard[joint],
    };
    let members = &motion.build.members;
    let is_of_body = |(joint, heard): (usize, &f64)| *heard > 0.0 && members.has(joint);
    // If a layer has only hair, its hair gives the reach.
    let skeleton = match motion.heard.iter().enumerate().any(is_of_body) {
        true => members.skeleton(),
        false => motion.clip.skeleton(),
    };
    let joints = shares(skeleton).into_iter().enumerate();
    let tracks = joints.filter(|(joint, _)| turns[*joint]).map(track);
    tracks.filter(|track| track.weight > 0.0).collect()
}

/// Returns the displacements [KT11 §2]: head, wrists, ankles, pelvis and gait; of a body without limbs, its tips.
fn travelling(motion: &LayerMotion<'_>) -> Vec<Travelling> {
    let mut tracks = match &motion.build.mannequin {
        Some(mannequin) => of_person(motion, mannequin),
        None => of_tips(motion),
    };
    tracks.retain(|track| track.weight > 0.0);
    tracks
}

fn of_person(motion: &LayerMotion<'_>, mannequin: &Mannequin) -> Vec<Travelling> {
    let counts = |point: &Point| motion.judged[point.joint.0];
    let both = |a: &Point, b: &Point| f64::min(counts(a), counts(b));
    let ends = motion.build.landmarks.points().into_iter();
    let ends = ends.map(|end| Travelling { what: Place::Of(end), weight: counts(&end) });
    let [left, right] = mannequin.leg_ends();
    let hips = both(&left[0], &right[0]);
    // In the world, feet and pelvis mostly travel. The step is their movement relative to each other.
    let pelvis = Travelling { what: Place::Between(left[0], right[0]), weight: hips };
    let gait = [
        Travelling {
            what: Place::From(left[1], right[1]),
            weight: GAIT * both(&left[1], &right[1]),
        },
        Travelling { what: Place::Height(left[0], right[0]), weight: GAIT * hips },
    ];
    ends.chain([pelvis]).chain(gait).collect()
}

/// Returns the tips of the body's chains, or its joints if no chain has a tip.
fn of_tips(motion: &LayerMotion<'_>) -> Vec<Travelling> {
    let skeleton = motion.build.members.skeleton();
    let of_joint = |(joint, data): (JointId, &Joint)| {
        let tips = data.end_sites.iter().map(move |end| Point { joint, offset: end.offset });
        tips.collect::<Vec<Point>>()
    };
    let mut tips: Vec<Point> = skeleton.iter().flat_map(of_joint).collect();
    if tips.is_empty() {
        tips.extend((0..skeleton.len()).map(Point::new));
    }
    let weight = (TIPS / tips.len() as f64).min(1.0);
    let track = |tip: Point| Travelling {
        what: Place::Of(tip),
        weight: weight * motion.judged[tip.joint.0],
    };
    tips.into_iter().map(track).collect()
}

/// Returns the parts that act while the rest of the body is quiet.
fn acting<'a>(motion: &LayerMotion<'a>) -> Vec<Acts<'a>> {
    let first = motion.clip.first().0;
    let acts = motion.acting.parts().map(|(part, when)| Acts {
        part,
        weight: motion.heard[part.ends()[1]],
        when: when
            .into_iter()
            .map(|when| when.start().0 - first + 1..when.end().0 - first + 1)
            .collect(),
    });
    acts.filter(|track| track.weight > 0.0).collect()
}

/// Follows the body block by block, and keeps its state at the frame before.
struct Following<'a> {
    motion: &'a LayerMotion<'a>,
    turning: &'a [Turning],
    travelling: &'a [Travelling],
    acting: &'a [Acts<'a>],
    rows: Vec<&'a [f64]>,
    sight: Sight<'a>,
    poser: LanePoser<'a>,
    turned: Vec<DQuat>,
    stood: Vec<DVec3>,
    held: Vec<DQuat>,
}

impl<'a> Following<'a> {
    fn new(
        motion: &'a LayerMotion<'a>,
        turning: &'a [Turning],
        travelling: &'a [Travelling],
        acting: &'a [Acts<'a>],
    ) -> Self {
        Self {
            motion,
            turning,
            travelling,
            acting,
            rows: motion.clip.rows().collect(),
            sight: Sight::new(motion),
            poser: LanePoser::new(motion.clip),
            turned: vec![DQuat::IDENTITY; turning.len()],
            stood: vec![DVec3::ZERO; travelling.len()],
            held: vec![DQuat::IDENTITY; acting.len()],
        }
    }

    /// Writes each track's steps into the frames of some blocks, [`LANES`] frames side by side. `values` holds all
    /// frames.
    #[inline(always)]
    fn write(&mut self, blocks: Range<usize>, values: &mut [f64]) {
        let steps = self.rows.len() - 1;
        for begin in blocks.map(|block| LANES * block) {
            let mut tracks = values.chunks_exact_mut(3 * steps);
            self.turn(begin, &mut tracks);
            self.travel(begin, &mut tracks);
            self.act(begin, &mut tracks);
        }
    }

    /// Poses a block and writes its rotations.
    #[inline(always)]
    fn turn(&mut self, begin: usize, tracks: &mut ChunksExactMut<'_, f64>) {
        let Self { motion, turning, rows, poser, turned, .. } = self;
        let (fps, last) = (motion.clip.rate().fps(), rows.len() - 1);
        let pose = poser.rows(&array::from_fn(|lane| rows[(begin + lane).min(last)]));
        for ((track, before), columns) in turning.iter().zip(turned).zip(tracks) {
            let now = pose.rotations[track.joint];
            if begin == 0 {
                *before = now.lane(0);
            }
            let way = now.shifted(*before).way_to(now);
            put(columns, begin, way * Lanes::splat(track.reach * fps));
            *before = now.lane(LANES - 1);
        }
    }

    /// Writes the displacements of the posed block.
    #[inline(always)]
    fn travel(&mut self, begin: usize, tracks: &mut ChunksExactMut<'_, f64>) {
        let Self { travelling, sight, poser, stood, .. } = self;
        let pose = poser.stand();
        for ((track, before), columns) in travelling.iter().zip(stood).zip(tracks) {
            let now = sight.see(track.what, pose);
            if begin == 0 {
                *before = now.lane(0);
            }
            put(columns, begin, now - now.shifted(*before));
            *before = now.lane(LANES - 1);
        }
    }

    /// Writes the turns of acting parts in the posed block; 0 while a part does not act.
    #[inline(always)]
    fn act(&mut self, begin: usize, tracks: &mut ChunksExactMut<'_, f64>) {
        let Self { motion, acting, poser, held, .. } = self;
        let (fps, pose) = (motion.clip.rate().fps(), poser.pose());
        for ((track, before), columns) in acting.iter().zip(held).zip(tracks) {
            let [base, tip] = track.part.ends().map(|joint| pose.rotations[joint]);
            let now = base.conjugate() * tip;
            if begin == 0 {
                *before = now.lane(0);
            }
            let acts = Lanes::from_fn(|lane| {
                let acts = track.when.iter().any(|when| when.contains(&(begin + lane)));
                if acts { track.part.worth * fps } else { 0.0 }
            });
            put(columns, begin, now.shifted(*before).way_to(now) * acts);
            *before = now.lane(LANES - 1);
        }
    }
}

/// Writes the steps into the frames of a block to the three columns of a track.
#[inline(always)]
fn put(columns: &mut [f64], begin: usize, step: LaneVec) {
    let steps = columns.len() / 3;
    // No step leads into the first frame.
    let skipped = usize::from(begin == 0);
    let own = begin + skipped - 1..steps.min(begin + LANES - 1);
    for (column, step) in columns.chunks_exact_mut(steps).zip([step.x, step.y, step.z]) {
        match column[own.clone()].as_mut_array::<LANES>() {
            Some(whole) => *whole = step.0,
            None => column[own.clone()].copy_from_slice(&step.0[skipped..][..own.len()]),
        }
    }
}

/// The view of places: the screen, the up axis and the scale.
struct Sight<'a> {
    screen: &'a Screen,
    up: DVec3,
    /// Factor from the file's unit a frame to % of body height a second.
    scale: f64,
}

impl<'a> Sight<'a> {
    fn new(motion: &LayerMotion<'a>) -> Self {
        let Build { landmarks, mannequin, .. } = motion.build;
        let height = mannequin.as_ref().map_or(motion.height, Mannequin::height);
        let scale = if height > 0.0 { 100.0 * motion.clip.rate().fps() / height } else { 0.0 };
        // On a screen, the second axis is up.
        let up = if motion.screen.is_world() { landmarks.up.unit() } else { DVec3::Y };
        Self { screen: motion.screen, up, scale }
    }

    /// Returns where a place is in some poses, scaled so that the step between two frames is in % of body height a
    /// second.
    #[inline(always)]
    fn see(&self, what: Place, pose: &LanePose) -> LaneVec {
        let stand = |point: Point| {
            let joint = point.joint.0;
            pose.translations[joint] + pose.rotations[joint].rotate(LaneVec::splat(point.offset))
        };
        let seen = |place: LaneVec| {
            let is_world = self.screen.is_world();
            let place = if is_world { place } else { place.map(|place| self.screen.see(place)) };
            place * Lanes::splat(self.scale)
        };
        let middle = |a, b| seen((stand(a) + stand(b)) * Lanes::splat(0.5));
        match what {
            Place::Of(point) => seen(stand(point)),
            Place::Between(a, b) => middle(a, b),
            Place::From(a, b) => seen(stand(b)) - seen(stand(a)),
            Place::Height(a, b) => {
                let up = LaneVec::splat(self.up);
                up * middle(a, b).dot(up)
            }
        }
    }
}
