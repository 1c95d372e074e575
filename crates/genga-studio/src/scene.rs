//! The scene (場面): the parts of a clip that stay the same from koma to koma. These are the figure, the floor, the space
//! that the motion reaches, and the directions that the body faces.

use glam::DVec3;

use genga::motion::{Clip, JointId, Skeleton, Stature};
use genga::sheet::Source;
use genga::signal::{Contact, ContactFinder, Limb};
use genga::time::{Clock, KOMA_RATE};
use genga_plot::Camera;
use genga_plot::parts::{BodySide, Figure, FigureBody, Posing, View, bones, seen_by};

/// Number of poses sampled to find the space that a motion reaches.
const LOOKS: usize = 240;

/// Distance of the floor's lines in metres.
const CELL: f64 = 0.5;

/// Distance that counts as far, in heights of the body.
const FAR: f64 = 2.0;

/// A stretch in which a foot stands (接地).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stand {
    pub(super) side: BodySide,
    /// Whether it is the first of the two feet.
    pub(super) is_first: bool,
    /// Places of the source at which it begins and has ended.
    pub(super) from: f64,
    pub(super) past: f64,
}

/// Data shared by all views of a clip.
#[derive(Debug, Clone)]
pub(super) struct Scene {
    pub(super) figure: Figure,
    pub(super) up: DVec3,
    /// Height of the floor, in the file's unit: that of the motion's lowest point.
    pub(super) floor: f64,
    /// Distance of the floor's lines, in the file's unit.
    pub(super) cell: f64,
    /// Points that the motion reaches, used to fit it into a view.
    pub(super) reached: Vec<DVec3>,
    /// The stands of both feet.
    pub(super) stands: Vec<Stand>,
    /// For each joint, the point below it that travels the longest path.
    ends: Vec<usize>,
    front: View,
    side: View,
    three_quarter: View,
}

impl Scene {
    /// Builds the scene of a clip with at least one frame and one joint.
    pub(super) fn from_clip(clip: &Clip) -> Self {
        let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
        let clock = clip.clock(KOMA_RATE);
        let step = koma.div_ceil(LOOKS).max(1);
        let places = (0..koma).step_by(step).map(|koma| clock.place_from_koma(koma));
        let figure = Figure::new(clip, FigureBody::Mannequin);
        let poses = Posing::new(clip, figure.marks()).all(places.map(Source::At));
        let stature = Stature::new(clip);
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
            stands: stands(clip, clock),
            ends: ends(clip.skeleton(), &poses),
            front: view(Camera::Front),
            side: view(Camera::Side),
            three_quarter: view(Camera::ThreeQuarter),
            reached,
        }
    }

    /// The point below a joint that travels the longest path: a hand, a foot, the tip of a toe.
    pub(super) fn fastest_end(&self, joint: JointId) -> usize {
        self.ends[joint.0]
    }

    /// The level view of a camera.
    pub(super) fn view(&self, camera: Camera) -> View {
        match camera {
            Camera::Front => self.front,
            Camera::Side => self.side,
            Camera::ThreeQuarter | Camera::Auto => self.three_quarter,
        }
    }

    /// Whether the body travels so far that it would be small in a view of the whole motion.
    pub(super) fn goes_far(&self) -> bool {
        let wide = |axis: DVec3| {
            let along = self.reached.iter().map(|point| point.dot(axis));
            let start = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = along.fold(start, |(low, high), at| (low.min(at), high.max(at)));
            high - low
        };
        wide(self.front.right).max(wide(self.side.right)) > FAR * self.figure.height
    }

    /// The point of the floor below another point.
    pub(super) fn on_floor(&self, point: DVec3) -> DVec3 {
        point - self.up * (point.dot(self.up) - self.floor)
    }
}

/// The stretches in which each foot of a clip stands.
fn stands(clip: &Clip, clock: Clock) -> Vec<Stand> {
    let mut contacts = ContactFinder::default().find(clip, clock);
    contacts.retain(|contact| contact.limb == Limb::Foot);
    let first = contacts.first().map(|contact| contact.point);
    let stand = |contact: &Contact| Stand {
        side: BodySide::from_name(&clip.skeleton().joints[contact.point.joint.0].name),
        is_first: Some(contact.point) == first,
        from: clock.place_from_koma(*contact.koma.start()),
        past: clock.place_from_koma(contact.koma.end() + 1),
    };
    contacts.iter().map(stand).collect()
}

/// For each joint, the point below it that travels the longest path.
fn ends(skeleton: &Skeleton, poses: &[Vec<DVec3>]) -> Vec<usize> {
    let way = |point: usize| -> f64 {
        poses.windows(2).map(|pair| pair[0][point].distance(pair[1][point])).sum()
    };
    let mut ends: Vec<(usize, f64)> = (0..skeleton.len()).map(|joint| (joint, 0.0)).collect();
    let mut bones: Vec<(usize, usize)> = bones(skeleton).collect();
    // Children have higher numbers than their parents, and tips than all joints. Going backwards visits children first.
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
