//! The camera (カメラ): the side from which figures are seen.

use std::fmt;
use std::str::FromStr;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::motion::Skeleton;
use crate::plot::figure::BodySide;
use crate::plot::view::{View, extent, up};

/// From where a picture looks (カメラ): level, without perspective, standing still.
///
/// Front is where the body faces in the first pose, by its hips. A rig that names no sides faces as files
/// usually do: along Z, or along −Y where Z is up.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Camera {
    /// 正面: the face looks at us; the body's left is to the right.
    Front,
    /// 側面: the face looks to the right.
    Side,
    /// 斜め: half-way between the two.
    ThreeQuarter,
    /// The side from which most of the movement is seen; a way that is gone leads to the right. The
    /// default.
    #[default]
    Auto,
}

impl Camera {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Front, Self::Side, Self::ThreeQuarter, Self::Auto];

    /// The word used on the command line and in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Side => "side",
            Self::ThreeQuarter => "three-quarter",
            Self::Auto => "auto",
        }
    }

    /// The view of some poses of a skeleton, each the positions of its joints and then of its tips.
    pub(super) fn view(self, skeleton: &Skeleton, poses: &[Vec<DVec3>]) -> View {
        let first = poses.first().map_or(&[][..], Vec::as_slice);
        let up = up(first);
        let front = facing(skeleton, first, up);
        // Seen from the body's own right, a body that faces away from us looks to the right.
        let side = front.cross(up);
        match self {
            Self::Front => View::from(up, front),
            Self::Side => View::from(up, side),
            Self::ThreeQuarter => View::from(up, (front + side).normalize()),
            Self::Auto => View::of(poses),
        }
    }
}

/// Where a body faces, level and of length 1.
fn facing(skeleton: &Skeleton, pose: &[DVec3], up: DVec3) -> DVec3 {
    let of = |side| {
        let joints = skeleton.joints.iter().enumerate();
        joints.filter(move |(_, data)| BodySide::of(&data.name) == side).map(|(joint, _)| joint)
    };
    // Both sides list their joints in one order, hips or shoulders first. Some rigs begin them with
    // joints in the middle of the body, which say nothing.
    let across = of(BodySide::Left).zip(of(BodySide::Right)).find_map(|(left, right)| {
        let across = *pose.get(left)? - *pose.get(right)?;
        let level = across - up * across.dot(up);
        (level.length() > 0.02 * extent(pose).length()).then_some(level)
    });
    let usual = if up == DVec3::Z { DVec3::NEG_Y } else { DVec3::Z };
    across.map_or(usual, |left| left.cross(up).normalize_or(usual))
}

impl fmt::Display for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for Camera {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let known = || Self::ALL.map(Self::word).join(", ");
        let camera = Self::ALL.into_iter().find(|camera| camera.word() == text);
        camera.ok_or_else(|| {
            Error::setting("camera", format!("\"{text}\" is no camera; it is one of {}", known()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Joint, JointId};

    /// Hips with two legs, the left one `left` away, and a head `up` above them.
    fn body(left: DVec3, up: DVec3) -> (Skeleton, Vec<Vec<DVec3>>) {
        let joint = |name: &str, parent: Option<usize>| Joint {
            name: name.into(),
            parent: parent.map(JointId),
            offset: DVec3::ZERO,
            channels: vec![],
            first_channel: 0,
            end_sites: vec![],
        };
        let names = ["Hips", "LHipJoint", "LeftUpLeg", "RHipJoint", "RightUpLeg", "Head"];
        let joints = names.iter().enumerate().map(|(at, name)| joint(name, (at > 0).then_some(0)));
        let pose = vec![DVec3::ZERO, DVec3::ZERO, left, DVec3::ZERO, -left, up];
        (Skeleton { joints: joints.collect() }, vec![pose])
    }

    #[test]
    fn the_face_looks_at_us_in_front_and_to_the_right_from_the_side() {
        for (left, up, faces) in [
            (DVec3::X, 9.0 * DVec3::Y, DVec3::Z),
            (DVec3::NEG_Z, 9.0 * DVec3::Y, DVec3::X),
            (DVec3::X, 9.0 * DVec3::Z, DVec3::NEG_Y),
        ] {
            let (skeleton, poses) = body(left, up);
            let front = Camera::Front.view(&skeleton, &poses);
            assert!(front.near.abs_diff_eq(faces, 1e-12), "{front:?}");
            assert!(front.right.abs_diff_eq(left, 1e-12), "its left is to the right: {front:?}");
            let side = Camera::Side.view(&skeleton, &poses);
            assert!(side.right.abs_diff_eq(faces, 1e-12), "{side:?}");
            let between = Camera::ThreeQuarter.view(&skeleton, &poses);
            assert!((between.near.dot(faces) - 0.5f64.sqrt()).abs() < 1e-12, "{between:?}");
            for view in [front, side, between] {
                assert!(view.near.abs_diff_eq(view.right.cross(view.up), 1e-12), "{view:?}");
            }
        }
    }

    #[test]
    fn a_rig_without_sides_faces_as_files_usually_do() {
        let (mut skeleton, poses) = body(DVec3::X, DVec3::Y);
        skeleton.joints.iter_mut().for_each(|joint| joint.name = "bone".into());
        assert_eq!(Camera::Front.view(&skeleton, &poses).near, DVec3::Z);
        assert_eq!(Camera::Front.view(&skeleton, &[]).near, DVec3::Z, "no pose at all");
    }

    #[test]
    fn a_camera_is_one_of_four_words() {
        for camera in Camera::ALL {
            assert_eq!(camera.to_string().parse::<Camera>().unwrap(), camera);
        }
        let message = "top".parse::<Camera>().unwrap_err().to_string();
        let expected =
            "camera: \"top\" is no camera; it is one of front, side, three-quarter, auto";
        assert_eq!(message, expected);
    }
}
