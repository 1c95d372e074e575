//! The skeleton of all samples: 23 joints, 170 cm tall, arms out to the sides at rest, facing +Z.

use glam::DVec3;

/// A joint with the bone that leads to it; centimetres.
pub(crate) struct Bone {
    pub(crate) name: &'static str,
    pub(crate) parent: Option<usize>,
    pub(crate) offset: DVec3,
    /// Position of the End Site, on leaf joints.
    pub(crate) tip: Option<DVec3>,
}

const fn bone(name: &'static str, parent: usize, offset: [f64; 3]) -> Bone {
    Bone { name, parent: Some(parent), offset: DVec3::from_array(offset), tip: None }
}

const fn last(name: &'static str, parent: usize, offset: [f64; 3], tip: [f64; 3]) -> Bone {
    let tip = Some(DVec3::from_array(tip));
    Bone { name, parent: Some(parent), offset: DVec3::from_array(offset), tip }
}

pub(crate) const HIPS: usize = 0;
pub(crate) const SPINE: [usize; 3] = [9, 10, 11];
pub(crate) const CHEST: usize = SPINE[2];
pub(crate) const NECK: [usize; 3] = [20, 21, 22];
/// Thigh, shank, foot and toes, left then right.
pub(crate) const LEGS: [[usize; 4]; 2] = [[1, 2, 3, 4], [5, 6, 7, 8]];
/// Collar, upper arm, forearm and hand, left then right.
pub(crate) const ARMS: [[usize; 4]; 2] = [[12, 13, 14, 15], [16, 17, 18, 19]];

/// Height of the ball of the foot (the toe joint) when it stands flat.
pub(crate) const BALL_HEIGHT: f64 = 2.0;

/// All bones, parents before children.
pub(crate) const BONES: [Bone; 23] = [
    Bone { name: "Hips", parent: None, offset: DVec3::new(0.0, 92.5, 0.0), tip: None },
    bone("LeftUpLeg", 0, [9.0, -4.0, 0.0]),
    bone("LeftLeg", 1, [0.0, -40.5, 0.0]),
    bone("LeftFoot", 2, [0.0, -40.0, 0.0]),
    last("LeftToeBase", 3, [0.0, -6.0, 13.0], [0.0, -0.5, 7.0]),
    bone("RightUpLeg", 0, [-9.0, -4.0, 0.0]),
    bone("RightLeg", 5, [0.0, -40.5, 0.0]),
    bone("RightFoot", 6, [0.0, -40.0, 0.0]),
    last("RightToeBase", 7, [0.0, -6.0, 13.0], [0.0, -0.5, 7.0]),
    bone("Spine", 0, [0.0, 7.0, -1.0]),
    bone("Spine1", 9, [0.0, 11.0, -0.5]),
    bone("Spine2", 10, [0.0, 11.0, -0.5]),
    bone("LeftShoulder", 11, [3.0, 15.0, 1.0]),
    bone("LeftArm", 12, [14.5, 0.0, -1.0]),
    bone("LeftForeArm", 13, [28.0, 0.0, 0.0]),
    last("LeftHand", 14, [25.5, 0.0, 0.0], [16.0, 0.0, 0.0]),
    bone("RightShoulder", 11, [-3.0, 15.0, 1.0]),
    bone("RightArm", 16, [-14.5, 0.0, -1.0]),
    bone("RightForeArm", 17, [-28.0, 0.0, 0.0]),
    last("RightHand", 18, [-25.5, 0.0, 0.0], [-16.0, 0.0, 0.0]),
    bone("Neck", 11, [0.0, 18.0, 0.0]),
    bone("Neck1", 20, [0.0, 5.0, 1.0]),
    last("Head", 21, [0.0, 5.0, 1.0], [0.0, 20.0, 1.0]),
];
