//! The scene (場面): what of a clip stays the same from koma to koma. The figure, the floor, where the motion
//! takes place, and where the body faces.

use glam::DVec3;

use crate::motion::{Clip, Stature, Unit};
use crate::plot::Camera;
use crate::plot::parts::{Figure, FigureBody, Posing, View, seen_by};
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
        let floor = poses.iter().flatten().map(|point| point.dot(up)).fold(f64::INFINITY, f64::min);
        let cell = CELL / Unit::nearest(stature.size).metres();
        Self {
            figure,
            up,
            floor,
            cell,
            front: view(Camera::Front),
            side: view(Camera::Side),
            three_quarter: view(Camera::ThreeQuarter),
            reached: poses.concat(),
        }
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
