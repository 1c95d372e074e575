//! The camera (カメラ): the side from which a body is drawn.

use std::fmt;
use std::str::FromStr;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Kind, Setting, as_word};
use crate::motion::seen::view::View;
use crate::motion::{BodySide, Build, Clip, Members, Skeleton};

/// Viewing direction of a picture (カメラ): level, orthographic and fixed.
///
/// Front is where the body faces in the first pose, judged by its hips. A rig whose names tell no sides is assumed to
/// face as most files do: along Z, or along −Y if Z is up.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Camera {
    /// 正面: faces the viewer; the body's left is on the right.
    Front,
    /// 側面: faces right.
    Side,
    /// 斜め: halfway between front and side.
    ThreeQuarter,
    /// The side that shows most of the movement; the body travels to the right, unless it then shows its back most of
    /// the time. The default.
    #[default]
    Auto,
}

impl Camera {
    /// All cameras.
    pub const ALL: [Self; 4] = [Self::Front, Self::Side, Self::ThreeQuarter, Self::Auto];

    const WORDS: [&'static str; 4] =
        [Self::Front.word(), Self::Side.word(), Self::ThreeQuarter.word(), Self::Auto.word()];

    /// Returns the word used on the command line and in files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Side => "side",
            Self::ThreeQuarter => "three-quarter",
            Self::Auto => "auto",
        }
    }

    /// Returns the view of some poses of a clip. Each pose lists the positions of its joints and then of its tips.
    pub fn view(self, clip: &Clip, poses: &[Vec<DVec3>]) -> View {
        let Build { members, stature, .. } = Build::new(clip);
        let up = stature.up.unit();
        let faces = Faces::new(&members, up);
        let first = poses.first().map_or(&[][..], Vec::as_slice);
        let usual = if up == DVec3::Z { DVec3::NEG_Y } else { DVec3::Z };
        let front = faces.facing(first).unwrap_or(usual);
        // Seen from the body's own right, a body that faces away from us looks to the right.
        let side = front.cross(up);
        match self {
            Self::Front => View::from(up, front),
            Self::Side => View::from(up, side),
            Self::ThreeQuarter => View::from(up, (front + side).normalize()),
            Self::Auto if members.are_all() => faces.towards(View::new(up, poses), poses),
            Self::Auto => {
                let own = own(&members, clip.skeleton(), poses);
                faces.towards(View::new(up, &own), poses)
            }
        }
    }
}

/// Returns the positions of the body alone, its root first.
fn own(members: &Members, skeleton: &Skeleton, poses: &[Vec<DVec3>]) -> Vec<Vec<DVec3>> {
    let root = members.root();
    let of: Vec<usize> = skeleton.owners().collect();
    let is_own = |point: &usize| of.get(*point).is_none_or(|joint| members.has(*joint));
    let pose = |pose: &Vec<DVec3>| {
        let others = (0..pose.len()).filter(|point| *point != root).filter(is_own);
        std::iter::once(root).chain(others).map(|point| pose[point]).collect()
    };
    poses.iter().map(pose).collect()
}

/// Tells where a body faces, from the joints that are named left and right.
struct Faces<'a> {
    members: &'a Members,
    /// A left joint and its right counterpart, hips or shoulders first.
    pairs: Vec<[usize; 2]>,
    up: DVec3,
}

impl<'a> Faces<'a> {
    /// Share of a face's direction that points away from the viewer from which a body shows its back: 30° past profile.
    const TURNED: f64 = 0.5;

    fn new(members: &'a Members, up: DVec3) -> Self {
        let of = |side| {
            let joints = members.skeleton().joints.iter().enumerate();
            let own = joints.filter(|(joint, _)| members.has(*joint));
            own.filter(move |(_, data)| BodySide::from_name(&data.name) == side)
                .map(|(joint, _)| joint)
        };
        // Both sides list their joints in one order.
        let pairs = of(BodySide::Left).zip(of(BodySide::Right)).map(<[usize; 2]>::from).collect();
        Self { members, pairs, up }
    }

    /// Returns the direction that the body faces in a pose, level and of length 1; `None` if the names tell no sides.
    fn facing(&self, pose: &[DVec3]) -> Option<DVec3> {
        // Some rigs begin with joints on the body's midline, which give no direction; these are skipped.
        let least = 0.02 * self.members.extent(pose).length();
        let across = self.pairs.iter().find_map(|[left, right]| {
            let across = *pose.get(*left)? - *pose.get(*right)?;
            let level = across - self.up * across.dot(self.up);
            (level.length() > least).then_some(level)
        })?;
        across.cross(self.up).try_normalize()
    }

    /// Turns a view round if most poses show their back in it.
    fn towards(&self, view: View, poses: &[Vec<DVec3>]) -> View {
        let faces = poses.iter().filter_map(|pose| self.facing(pose));
        let backs = faces.filter(|face| face.dot(view.near) < -Self::TURNED).count();
        if 2 * backs > poses.len() { View::from(self.up, -view.near) } else { view }
    }
}

impl Setting for Camera {
    const KIND: Kind = Kind::Choice(&Self::WORDS);
    as_word!();
}

impl fmt::Display for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Self::word(*self))
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
    use glam::DQuat;

    use super::*;
    use crate::motion::{Axis, Channel, Joint, JointId};
    use crate::time::{Frame, FrameRate};

    const NAMES: [&str; 6] = ["Hips", "LHipJoint", "LeftUpLeg", "RHipJoint", "RightUpLeg", "Head"];
    const BIPED: [&str; 6] =
        ["Bip01", "Bip01 Pelvis", "Bip01 L Thigh", "Bip01 Spine", "Bip01 R Thigh", "Bip01 Head"];
    const NAMELESS: [&str; 6] = ["bone"; 6];

    /// Hips with two legs, the left one `left` away, and a head `up` above them, turned about X by some degrees in
    /// the only frame.
    fn body(names: [&str; 6], left: DVec3, up: DVec3, degrees: f64) -> (Clip, Vec<Vec<DVec3>>) {
        let pose = [DVec3::ZERO, DVec3::ZERO, left, DVec3::ZERO, -left, up];
        let joint = |at: usize| Joint {
            name: names[at].into(),
            parent: (at > 0).then_some(JointId(0)),
            offset: pose[at],
            channels: if at > 0 { vec![] } else { vec![Channel::Rotation(Axis::X)] },
            first_channel: 0,
            end_sites: vec![],
        };
        let joints = (0..names.len()).map(joint).collect();
        let rate = FrameRate::new(24.0).unwrap();
        let clip = Clip::new(Skeleton { joints }, rate, Frame(0), 1, vec![degrees]).unwrap();
        let turn = DQuat::from_rotation_x(degrees.to_radians());
        (clip, vec![pose.map(|point| turn * point).to_vec()])
    }

    #[test]
    fn the_face_looks_at_us_in_front_and_to_the_right_from_the_side() {
        for (names, left, up, faces) in [
            (NAMES, DVec3::X, 9.0 * DVec3::Y, DVec3::Z),
            (NAMES, DVec3::NEG_Z, 9.0 * DVec3::Y, DVec3::X),
            (NAMES, DVec3::X, 9.0 * DVec3::Z, DVec3::NEG_Y),
            (BIPED, DVec3::NEG_Z, 9.0 * DVec3::Y, DVec3::X),
        ] {
            let (clip, poses) = body(names, left, up, 0.0);
            let front = Camera::Front.view(&clip, &poses);
            assert!(front.near.abs_diff_eq(faces, 1e-12), "{front:?}");
            assert!(front.right.abs_diff_eq(left, 1e-12), "its left is to the right: {front:?}");
            let side = Camera::Side.view(&clip, &poses);
            assert!(side.right.abs_diff_eq(faces, 1e-12), "{side:?}");
            let between = Camera::ThreeQuarter.view(&clip, &poses);
            assert!((between.near.dot(faces) - 0.5f64.sqrt()).abs() < 1e-12, "{between:?}");
            for view in [front, side, between] {
                assert!(view.near.abs_diff_eq(view.right.cross(view.up), 1e-12), "{view:?}");
            }
        }
    }

    #[test]
    fn a_rig_without_sides_faces_as_files_usually_do() {
        let (clip, poses) = body(NAMELESS, DVec3::X, DVec3::Y, 0.0);
        assert_eq!(Camera::Front.view(&clip, &poses).near, DVec3::Z);
        assert_eq!(Camera::Front.view(&clip, &[]).near, DVec3::Z, "no pose at all");
    }

    #[test]
    fn no_body_is_seen_from_behind_most_of_the_time() {
        // It swings an arm across its front, and sways to the left or to the right.
        for (names, sway, near) in [
            (NAMES, 0.1, DVec3::Z),
            (NAMES, -0.1, DVec3::Z),
            (NAMES, 9.0, DVec3::Z),
            (NAMES, -9.0, DVec3::Z),
            (NAMELESS, -9.0, DVec3::NEG_Z),
        ] {
            let (clip, poses) = body(names, DVec3::X, 9.0 * DVec3::Y, 0.0);
            let mut last = poses[0].clone();
            last.iter_mut().for_each(|point| *point += sway * DVec3::X);
            last[5] += DVec3::X;
            let view = Camera::Auto.view(&clip, &[poses[0].clone(), last]);
            assert!(view.near.abs_diff_eq(near, 1e-12), "{sway}: {view:?}");
        }
    }

    #[test]
    fn a_body_that_walks_ahead_goes_to_the_right() {
        for way in [9.0, -9.0] {
            let (clip, poses) = body(NAMES, DVec3::X, 9.0 * DVec3::Y, 0.0);
            let gone = poses[0].iter().map(|point| *point + way * DVec3::Z).collect();
            let view = Camera::Auto.view(&clip, &[poses[0].clone(), gone]);
            assert!(view.right.abs_diff_eq(way.signum() * DVec3::Z, 1e-12), "{view:?}");
        }
    }

    #[test]
    fn up_is_that_of_the_body_also_where_it_begins_on_hands_and_knees() {
        let (clip, poses) = body(NAMES, DVec3::X, 9.0 * DVec3::Y, 90.0);
        for camera in Camera::ALL {
            assert_eq!(camera.view(&clip, &poses).up, DVec3::Y, "{camera}");
        }
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
