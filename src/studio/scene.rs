//! The scene (場面): what of a clip stays the same from koma to koma. The figure, the floor, where the motion
//! takes place, and where the body faces.

use glam::DVec3;

use crate::motion::{Clip, JointId, Skeleton, Stature};
use crate::plot::Camera;
use crate::plot::parts::{Figure, FigureBody, Posing, View, bones, seen_by};
use crate::sheet::Source;
use crate::time::KOMA_RATE;

/// Poses that are looked at to know where a motion takes place.
const LOOKS: usize = 240;

/// Metres from one line on the floor to the next.
const CELL: f64 = 0.5;

/// A way that is far, in heights of the body.
const FAR: f64 = 2.0;

/// What all views of a clip share.
#[derive(Debug, Clone)]
pub(super) struct Scene {
    pub(super) figure: Figure,
    pub(super) up: DVec3,
    /// How high the floor lies, in the file's unit: where the lowest point of the motion is.
    pub(super) floor: f64,
    /// From one line on the floor to the next, in the file's unit.
    pub(super) cell: f64,
    /// Points that the motion reaches, for what has to fit into a view.
    pub(super) reached: Vec<DVec3>,
    /// For each joint the point that hangs on it and goes the longest way.
    ends: Vec<usize>,
    front: View,
    side: View,
    three_quarter: View,
}

impl Scene {
    /// Looks at a clip of at least one frame and joint.
    pub(super) fn of(clip: &Clip) -> Self {
        let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
        let clock = clip.clock(KOMA_RATE);
        let step = koma.div_ceil(LOOKS).max(1);
        let places = (0..koma).step_by(step).map(|koma| clock.place_from_koma(koma));
        let figure = Figure::of(clip, FigureBody::Mannequin);
        let poses = Posing::of(clip, figure.marks()).all(places.map(Source::At));
        let stature = Stature::of(clip);
        let view = |camera: Camera| seen_by(camera, clip, &poses);
        let up = stature.up.unit();
        let reached: Vec<DVec3> =
            poses.iter().flat_map(|pose| figure.shown(pose)).copied().collect();
        let floor = reached.iter().map(|point| point.dot(up)).fold(f64::INFINITY, f64::min);
        let cell = CELL / stature.metres;
        Self {
            figure,
            up,
            floor,
            cell,
            ends: ends(clip.skeleton(), &poses),
            front: view(Camera::Front),
            side: view(Camera::Side),
            three_quarter: view(Camera::ThreeQuarter),
            reached,
        }
    }

    /// The point of a pose that goes the longest way of all that hang on a joint: a hand, a foot, the tip of a toe.
    pub(super) fn fastest_end(&self, joint: JointId) -> usize {
        self.ends[joint.0]
    }

    /// A level view.
    pub(super) fn view(&self, camera: Camera) -> View {
        match camera {
            Camera::Front => self.front,
            Camera::Side => self.side,
            Camera::ThreeQuarter | Camera::Auto => self.three_quarter,
        }
    }

    /// Whether the body goes so far that it would be small in a view of all of it.
    pub(super) fn goes_far(&self) -> bool {
        let wide = |axis: DVec3| {
            let along = self.reached.iter().map(|point| point.dot(axis));
            let start = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = along.fold(start, |(low, high), at| (low.min(at), high.max(at)));
            high - low
        };
        wide(self.front.right).max(wide(self.side.right)) > FAR * self.figure.height
    }

    /// The point of the floor under another.
    pub(super) fn on_floor(&self, point: DVec3) -> DVec3 {
        point - self.up * (point.dot(self.up) - self.floor)
    }
}

/// For each joint the point below it that goes the longest way.
fn ends(skeleton: &Skeleton, poses: &[Vec<DVec3>]) -> Vec<usize> {
    let way = |point: usize| -> f64 {
        poses.windows(2).map(|pair| pair[0][point].distance(pair[1][point])).sum()
    };
    let mut ends: Vec<(usize, f64)> = (0..skeleton.len()).map(|joint| (joint, 0.0)).collect();
    let mut bones: Vec<(usize, usize)> = bones(skeleton).collect();
    // Children have higher numbers than their parents, and tips than all joints: the last come first.
    bones.sort_unstable_by_key(|(_, to)| std::cmp::Reverse(*to));
    for (from, to) in bones {
        let below = ends.get(to).copied().filter(|(end, _)| *end != to);
        let end = below.unwrap_or_else(|| (to, way(to)));
        if end.1 > ends[from].1 {
            ends[from] = end;
        }
    }
    ends.into_iter().map(|(end, _)| end).collect()
}
