//! Rotations of arms and legs from named angles, and two-bone inverse kinematics.

use glam::{DMat3, DQuat, DVec3};

/// Rotation of hips, spine or neck: bend forward, lean to the left, turn to the left.
pub(crate) fn torso([bend, lean, turn]: [f64; 3]) -> DQuat {
    about_y(turn) * about_x(bend) * about_z(-lean)
}

pub(crate) fn about_x(degrees: f64) -> DQuat {
    DQuat::from_rotation_x(degrees.to_radians())
}

pub(crate) fn about_y(degrees: f64) -> DQuat {
    DQuat::from_rotation_y(degrees.to_radians())
}

pub(crate) fn about_z(degrees: f64) -> DQuat {
    DQuat::from_rotation_z(degrees.to_radians())
}

/// Mirrors a rotation to the other side of the body.
pub(crate) fn mirrored(turn: DQuat) -> DQuat {
    DQuat::from_xyzw(turn.x, -turn.y, -turn.z, turn.w)
}

/// Rotation of the left upper arm relative to its collar, from azimuth, elevation and external rotation.
pub(crate) fn upper_arm([azimuth, elevation, external]: [f64; 3]) -> DQuat {
    // The last rotation brings the arm from hanging (zero of the angles) to the rest pose, out to the side.
    about_y(-azimuth) * about_z(elevation) * about_y(external) * about_z(-90.0)
}

/// Rotation of the left forearm from elbow bend and roll.
pub(crate) fn forearm(bend: f64, roll: f64) -> DQuat {
    about_y(-bend) * about_x(roll)
}

/// Rotation of the left thigh from bend forward, spread and outward turn.
pub(crate) fn thigh([bend, spread, outward]: [f64; 3]) -> DQuat {
    about_x(-bend) * about_z(spread) * about_y(outward)
}

/// Solves a left arm that reaches from its shoulder to `target`, elbow towards `pole`. Returns the upper arm's rotation
/// and the bend of the elbow in degrees.
pub(crate) fn reach_with_arm(target: DVec3, pole: DVec3, bones: [f64; 2]) -> (DQuat, f64) {
    let (elbow, hinge, bend) = reach(target, pole, bones);
    let along = elbow.normalize();
    (DQuat::from_mat3(&DMat3::from_cols(along, hinge, along.cross(hinge))), bend)
}

/// Solves a leg that reaches from its hip to `target`, knee towards `pole`. Returns the rotations of thigh and shank,
/// both relative to the frame of `target`.
pub(crate) fn reach_with_leg(target: DVec3, pole: DVec3, bones: [f64; 2]) -> [DQuat; 2] {
    let (knee, hinge, bend) = reach(target, pole, bones);
    let (x, y) = (-hinge, -knee.normalize());
    let thigh = DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y)));
    [thigh, thigh * about_x(bend)]
}

/// Solves two bones. Returns the position of the middle joint, the hinge axis (`target` × `pole`) and the bend in
/// degrees.
fn reach(target: DVec3, pole: DVec3, [upper, lower]: [f64; 2]) -> (DVec3, DVec3, f64) {
    let longest = 0.9995 * (upper + lower);
    let distance = target.length().clamp(0.2 * longest, longest);
    let along = target.normalize();
    let hinge = along.cross(pole).normalize();
    let out = hinge.cross(along);
    let cos = (upper * upper + distance * distance - lower * lower) / (2.0 * upper * distance);
    let middle = upper * (along * cos + out * (1.0 - cos * cos).sqrt());
    let inside = (upper * upper + lower * lower - distance * distance) / (2.0 * upper * lower);
    (middle, hinge, 180.0 - libm::acos(inside).to_degrees())
}
