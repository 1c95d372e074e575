//! Poses: local rotations of a frame, sampled instants, blends and world positions.

use glam::{DQuat, DVec3};

use crate::maths;
use crate::motion::clip::lane_poser::LanePose;
use crate::motion::{Axis, Channel, Clip, Joint, Skeleton};
use crate::time::Frame;

/// Computes the rotation of a joint relative to its parent, a unit quaternion: the product of its elementary
/// rotations in the order of its channels, left to right.
pub fn local_rotation(joint: &Joint, row: &[f64]) -> DQuat {
    let mut rotation = DQuat::IDENTITY;
    for (channel, degrees) in joint.channels.iter().zip(&row[joint.first_channel..]) {
        if let Channel::Rotation(axis) = channel {
            let (sin, cos) = maths::sin_cos(0.5 * degrees.to_radians());
            rotation = turn(rotation, *axis, sin, cos);
        }
    }
    rotation
}

/// Multiplies `rotation` by a rotation about one axis, given by the sine and cosine of half its angle. This needs
/// half the products of a full quaternion multiplication.
fn turn(q: DQuat, axis: Axis, sin: f64, cos: f64) -> DQuat {
    let DQuat { x, y, z, w } = q;
    match axis {
        Axis::X => DQuat::from_xyzw(
            x * cos + w * sin,
            y * cos + z * sin,
            z * cos - y * sin,
            w * cos - x * sin,
        ),
        Axis::Y => DQuat::from_xyzw(
            x * cos - z * sin,
            y * cos + w * sin,
            z * cos + x * sin,
            w * cos - y * sin,
        ),
        Axis::Z => DQuat::from_xyzw(
            x * cos + y * sin,
            y * cos - x * sin,
            z * cos + w * sin,
            w * cos - z * sin,
        ),
    }
}

/// Computes the position of a joint relative to its parent, in the file's unit: the offset, with each position
/// channel's value replacing that axis.
pub fn local_translation(joint: &Joint, row: &[f64]) -> DVec3 {
    let mut translation = joint.offset;
    for (channel, value) in joint.channels.iter().zip(&row[joint.first_channel..]) {
        match channel {
            Channel::Position(Axis::X) => translation.x = *value,
            Channel::Position(Axis::Y) => translation.y = *value,
            Channel::Position(Axis::Z) => translation.z = *value,
            Channel::Rotation(_) => {}
        }
    }
    translation
}

/// The local pose of an instant: a rotation and a translation per joint, in joint order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pose {
    /// Local rotations, unit quaternions.
    pub rotations: Vec<DQuat>,
    /// Local translations, in the file's unit.
    pub translations: Vec<DVec3>,
}

impl Pose {
    /// Creates the rest pose of a skeleton, as a buffer for the methods below.
    pub fn rest(skeleton: &Skeleton) -> Self {
        Self {
            rotations: vec![DQuat::IDENTITY; skeleton.len()],
            translations: skeleton.joints.iter().map(|joint| joint.offset).collect(),
        }
    }

    /// Sets the pose to that of a frame.
    pub fn take_frame(&mut self, clip: &Clip, frame: Frame) {
        self.take_row(clip.skeleton(), clip.row(frame));
    }

    /// Sets the pose from a row of channel values.
    pub(in crate::motion) fn take_row(&mut self, skeleton: &Skeleton, row: &[f64]) {
        for ((joint, rotation), translation) in
            skeleton.joints.iter().zip(&mut self.rotations).zip(&mut self.translations)
        {
            *rotation = local_rotation(joint, row);
            *translation = local_translation(joint, row);
        }
    }

    /// Sets the pose to that at a place, a fractional frame number: a slerp between the two neighbouring frames.
    /// Places outside the clip give its first or last frame.
    pub fn take_place(&mut self, clip: &Clip, place: f64) {
        let place = place.clamp(clip.first().0 as f64, clip.last().0 as f64);
        let before = Frame(place.floor() as usize);
        self.take_frame(clip, before);
        let share = place - place.floor();
        if share == 0.0 {
            return;
        }
        let row = clip.row(Frame(before.0 + 1));
        for ((joint, rotation), translation) in
            clip.skeleton().joints.iter().zip(&mut self.rotations).zip(&mut self.translations)
        {
            *rotation = slerp(*rotation, local_rotation(joint, row), share);
            *translation = lerp(*translation, local_translation(joint, row), share);
        }
    }

    /// Sets the pose to the blend `share` of the way from one pose to another: a slerp of every joint.
    pub fn take_blend(&mut self, from: &Pose, to: &Pose, share: f64) {
        for (rotation, (from, to)) in
            self.rotations.iter_mut().zip(from.rotations.iter().zip(&to.rotations))
        {
            *rotation = slerp(*from, *to, share);
        }
        for (translation, (from, to)) in
            self.translations.iter_mut().zip(from.translations.iter().zip(&to.translations))
        {
            *translation = lerp(*from, *to, share);
        }
    }
}

/// Slerps between two rotations. Equal rotations are returned unchanged: rounding must not make a still body move.
fn slerp(from: DQuat, to: DQuat, share: f64) -> DQuat {
    if from == to { from } else { from.slerp(to, share) }
}

/// Interpolates between two translations. Equal ones are returned unchanged, as in [`slerp`].
fn lerp(from: DVec3, to: DVec3, share: f64) -> DVec3 {
    if from == to { from } else { from.lerp(to, share) }
}

/// A body in the world (forward kinematics): the positions of joints and bone tips in a pose.
#[derive(Debug, Clone)]
pub struct Body {
    parents: Vec<Option<usize>>,
    /// Joint of each tip, and the offset from it.
    tips: Vec<(usize, DVec3)>,
    rotations: Vec<DQuat>,
    points: Vec<DVec3>,
}

impl Body {
    /// Creates a body of a skeleton in its rest pose.
    pub fn new(skeleton: &Skeleton) -> Self {
        let parent = |joint: &Joint| joint.parent.map(|parent| parent.0);
        let tips = skeleton
            .iter()
            .flat_map(|(joint, data)| data.end_sites.iter().map(move |end| (joint.0, end.offset)));
        let tips: Vec<(usize, DVec3)> = tips.collect();
        let mut body = Self {
            parents: skeleton.joints.iter().map(parent).collect(),
            rotations: vec![DQuat::IDENTITY; skeleton.len()],
            points: vec![DVec3::ZERO; skeleton.len() + tips.len()],
            tips,
        };
        body.place(&Pose::rest(skeleton));
        body
    }

    /// Sets the body to a local pose.
    pub fn place(&mut self, pose: &Pose) {
        let positions = &mut self.points;
        for (joint, parent) in self.parents.iter().enumerate() {
            let (rotation, translation) = (pose.rotations[joint], pose.translations[joint]);
            (self.rotations[joint], positions[joint]) = match *parent {
                None => (rotation, translation),
                Some(parent) => (
                    self.rotations[parent] * rotation,
                    positions[parent] + self.rotations[parent] * translation,
                ),
            };
        }
        self.place_tips();
    }

    /// Sets the body to one lane of poses that are already in world space.
    pub(in crate::motion) fn take_lane(&mut self, world: &LanePose, lane: usize) {
        for (joint, rotation) in self.rotations.iter_mut().enumerate() {
            *rotation = world.rotations[joint].lane(lane);
            self.points[joint] = world.translations[joint].lane(lane);
        }
        self.place_tips();
    }

    fn place_tips(&mut self) {
        let (positions, tips) = self.points.split_at_mut(self.parents.len());
        for (tip, (joint, offset)) in tips.iter_mut().zip(&self.tips) {
            *tip = positions[*joint] + self.rotations[*joint] * *offset;
        }
    }

    /// Returns the world positions of the joints, in joint order and in the file's unit.
    pub fn positions(&self) -> &[DVec3] {
        &self.points[..self.parents.len()]
    }

    /// Returns the world positions of the joints, followed by those of the tips (End Sites) in the order of their
    /// joints.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Returns the world rotations of the joints.
    pub fn rotations(&self) -> &[DQuat] {
        &self.rotations
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::JointId;
    use crate::time::FrameRate;

    fn arm(channels: &[Channel]) -> Skeleton {
        let joint = |parent: Option<usize>, channels: &[Channel], first_channel| Joint {
            name: "joint".into(),
            parent: parent.map(JointId),
            offset: DVec3::Y,
            channels: channels.to_vec(),
            first_channel,
            end_sites: vec![],
        };
        Skeleton { joints: vec![joint(None, channels, 0), joint(Some(0), &[], channels.len())] }
    }

    const ZXY: [Channel; 3] =
        [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];

    #[test]
    fn channels_multiply_in_the_order_listed() {
        let skeleton = arm(&ZXY);
        let rotation = local_rotation(&skeleton.joints[0], &[40.0, 50.0, 60.0]);
        let expected = DQuat::from_xyzw(0.188938, 0.551004, 0.467012, 0.665279);
        assert!(rotation.abs_diff_eq(expected, 1e-6), "{rotation}");
        let by_glam = DQuat::from_rotation_z(40f64.to_radians())
            * DQuat::from_rotation_x(50f64.to_radians())
            * DQuat::from_rotation_y(60f64.to_radians());
        assert!(rotation.abs_diff_eq(by_glam, 1e-15));
    }

    #[test]
    fn a_position_channel_replaces_the_offset_on_its_axis_alone() {
        let skeleton = arm(&[Channel::Position(Axis::X)]);
        let translation = local_translation(&skeleton.joints[0], &[5.0]);
        assert_eq!(translation, DVec3::new(5.0, 1.0, 0.0));
    }

    #[test]
    fn a_child_turns_with_its_parent() {
        let skeleton = arm(&ZXY);
        let clip = clip(skeleton, &[90.0, 0.0, 0.0]);
        let mut pose = Pose::rest(clip.skeleton());
        pose.take_frame(&clip, Frame(0));
        let mut body = Body::new(clip.skeleton());
        body.place(&pose);
        let positions = body.positions();
        assert_eq!(positions[0], DVec3::Y);
        assert!(positions[1].abs_diff_eq(DVec3::new(-1.0, 1.0, 0.0), 1e-15), "{}", positions[1]);
    }

    #[test]
    fn a_place_between_frames_is_a_slerp_even_across_a_full_turn() {
        let clip = clip(arm(&ZXY), &[170.0, 0.0, 0.0, -170.0, 0.0, 0.0]);
        let mut pose = Pose::rest(clip.skeleton());
        pose.take_place(&clip, 0.25);
        let expected = DQuat::from_rotation_z(175f64.to_radians());
        assert!(pose.rotations[0].dot(expected).abs() > 1.0 - 1e-12, "{}", pose.rotations[0]);
        let mut exact = pose.clone();
        exact.take_frame(&clip, Frame(1));
        pose.take_place(&clip, 7.0);
        assert_eq!(pose, exact, "a place past the end is the last frame");
    }

    #[test]
    fn between_equal_poses_nothing_moves_by_even_the_last_digit() {
        let row = [0.1, 33.3, -77.7];
        let clip = clip(arm(&ZXY), &[row, row].concat());
        let (mut between, mut frame) = (Pose::rest(clip.skeleton()), Pose::rest(clip.skeleton()));
        frame.take_frame(&clip, Frame(0));
        for share in [0.1, 0.3, 0.7] {
            between.take_place(&clip, share);
            assert_eq!(between, frame);
            between.take_blend(&frame, &frame, share);
            assert_eq!(between, frame);
        }
    }

    fn clip(skeleton: Skeleton, values: &[f64]) -> Clip {
        let frames = values.len() / skeleton.channels();
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(skeleton, rate, Frame(0), frames, values.to_vec()).unwrap()
    }
}
