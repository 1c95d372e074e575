//! MMD's camera: it circles a point at a distance.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::CENTIMETRES;
use super::curve::Curve;
use genga::maths;
use genga::motion::{CameraPose, Lens};

/// The keys of MMD's camera, sorted by frame.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct VmdCamera {
    /// The keys, each on a frame of its own.
    pub keys: Vec<VmdCameraKey>,
}

/// A key of MMD's camera, in its units and left-handed axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct VmdCameraKey {
    /// The frame, from 0.
    pub frame: u32,
    /// The distance from the point it looks at, negative in front of it; that point; the angles about x, y and z in
    /// radians; and the angle of view in degrees.
    pub values: [f64; 8],
    /// The handles of the curves from the key before, as in the file: x₁, x₂, y₁, y₂ for x, y, z, the angles, the distance
    /// and the angle of view.
    pub curves: [u8; 24],
    /// 0 with perspective, 1 without.
    pub perspective: u8,
}

/// The curve of each value.
const CURVES: [usize; 8] = [4, 0, 1, 2, 3, 3, 3, 5];

impl VmdCamera {
    /// Sorts keys by frame; the later of two on one frame wins.
    pub(super) fn new(mut keys: Vec<VmdCameraKey>) -> Self {
        keys.reverse();
        keys.sort_by_key(|key| key.frame);
        keys.dedup_by_key(|key| key.frame);
        Self { keys }
    }

    /// Returns the state of the camera at a frame with a fraction, as a key with straight curves; `None` without keys.
    ///
    /// Between keys on neighbouring frames there is a cut and no way, as in MMD.
    pub fn at(&self, place: f64) -> Option<VmdCameraKey> {
        let after = self.keys.partition_point(|key| f64::from(key.frame) <= place);
        let before = self.keys.get(after.saturating_sub(1))?;
        let Some(next) =
            self.keys.get(after).filter(|next| after > 0 && next.frame > before.frame + 1)
        else {
            return Some(*before);
        };
        let frames = f64::from(next.frame - before.frame);
        let share = (place - f64::from(before.frame)) / frames;
        let done: [f64; 6] = std::array::from_fn(|at| {
            let [x1, x2, y1, y2] = std::array::from_fn(|byte| next.curves[4 * at + byte]);
            Curve::from_bytes([x1, y1, x2, y2]).done(share)
        });
        let value = |at: usize| {
            before.values[at] + done[CURVES[at]] * (next.values[at] - before.values[at])
        };
        Some(VmdCameraKey { values: std::array::from_fn(value), ..*before })
    }

    /// Returns the poses at some places, in centimetres and right-handed axes; none without keys.
    pub(super) fn poses(&self, places: impl Iterator<Item = f64>) -> Vec<CameraPose> {
        places.filter_map(|place| Some(self.at(place)?.pose())).collect()
    }
}

impl VmdCameraKey {
    fn pose(&self) -> CameraPose {
        let [distance, x, y, z, turn_x, turn_y, turn_z, view] = self.values;
        let turn = about(DVec3::Y, turn_y) * about(DVec3::X, turn_x) * about(DVec3::Z, -turn_z);
        let place = CENTIMETRES * (DVec3::new(x, y, -z) - turn * (distance * DVec3::Z));
        let height = 2.0 * maths::tan(0.5 * view.to_radians());
        let lens = match self.perspective {
            0 => Lens::Perspective(height),
            _ => Lens::Orthographic(height * CENTIMETRES * distance.abs()),
        };
        CameraPose { place, turn, lens }
    }
}

/// A rotation about an axis.
fn about(axis: DVec3, angle: f64) -> DQuat {
    let (sin, cos) = maths::sin_cos(0.5 * angle);
    DQuat::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos)
}
