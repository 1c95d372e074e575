//! The body as points of some weight: what errors and speeds are averaged over.

use glam::DVec3;

use crate::motion::{Body, Joint, Pose, Skeleton};

/// The joints of a body and the tips of its End Sites, each with the length of the bone that leads to
/// it as its weight.
///
/// So a mean over points is one over the length of all bones. It does not change when a rig has more
/// joints along the same spine, or a joint of no length at a hip, and a hand of many short bones counts
/// as a hand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Points {
    joints: usize,
    /// Each tip's joint, and where it lies from there.
    tips: Vec<(usize, DVec3)>,
    /// One weight a point, joints first; their sum is 1.
    weights: Vec<f64>,
}

impl Points {
    /// The points of a skeleton. Without any bone they all weigh the same.
    pub(super) fn of(skeleton: &Skeleton) -> Self {
        let bone = |joint: &Joint| joint.parent.map_or(0.0, |_| joint.offset.length());
        let mut weights: Vec<f64> = skeleton.joints.iter().map(bone).collect();
        let mut tips = Vec::new();
        for (joint, data) in skeleton.iter() {
            for end in &data.end_sites {
                tips.push((joint.0, end.offset));
                weights.push(end.offset.length());
            }
        }
        let all: f64 = weights.iter().sum();
        let count = weights.len() as f64;
        for weight in &mut weights {
            *weight = if all > 0.0 { *weight / all } else { 1.0 / count };
        }
        Self { joints: skeleton.len(), tips, weights }
    }

    /// Number of points.
    pub(super) fn len(&self) -> usize {
        self.weights.len()
    }

    /// Writes where each point of a pose stands in the world, in the file's unit.
    pub(super) fn place(&self, body: &mut Body, pose: &Pose, positions: &mut [DVec3]) {
        let (joints, tips) = positions.split_at_mut(self.joints);
        body.place(pose, joints);
        for (tip, (joint, offset)) in tips.iter_mut().zip(&self.tips) {
            *tip = joints[*joint] + body.rotations()[*joint] * *offset;
        }
    }

    /// The squared distance of two poses, a weighted mean over the points.
    pub(super) fn apart(&self, a: &[DVec3], b: &[DVec3]) -> f64 {
        let squares = a.iter().zip(b).map(|(a, b)| a.distance_squared(*b));
        squares.zip(&self.weights).map(|(square, weight)| weight * square).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{EndSite, JointId};

    /// A chain of bones along x with a tip at its end.
    fn chain(bones: &[f64], tip: f64) -> Skeleton {
        let joint = |parent: Option<usize>, length: f64| Joint {
            name: "joint".into(),
            parent: parent.map(JointId),
            offset: DVec3::X * length,
            channels: vec![],
            first_channel: 0,
            end_sites: vec![],
        };
        let mut joints = vec![joint(None, 9.0)];
        joints
            .extend(bones.iter().enumerate().map(|(parent, length)| joint(Some(parent), *length)));
        let last = joints.len() - 1;
        joints[last].end_sites = vec![EndSite { name: "Site".into(), offset: DVec3::X * tip }];
        Skeleton { joints }
    }

    #[test]
    fn a_point_weighs_as_much_as_the_bone_that_leads_to_it() {
        let points = Points::of(&chain(&[3.0, 0.0], 1.0));
        assert_eq!(points.weights, [0.0, 0.75, 0.0, 0.25], "the root's offset is no bone");
        let rest = [DVec3::ZERO; 4];
        let moved = [DVec3::Y * 5.0, DVec3::Y * 2.0, DVec3::Y * 5.0, DVec3::Y * 4.0];
        assert_eq!(points.apart(&rest, &moved), 0.75 * 4.0 + 0.25 * 16.0);
    }

    #[test]
    fn a_joint_more_on_the_same_bone_changes_nothing_that_turns_with_it() {
        let apart = |skeleton: &Skeleton| {
            let points = Points::of(skeleton);
            let (mut body, pose) = (Body::new(skeleton), Pose::rest(skeleton));
            let mut positions = vec![DVec3::ZERO; points.len()];
            points.place(&mut body, &pose, &mut positions);
            let moved: Vec<DVec3> = positions.iter().map(|position| *position + DVec3::Y).collect();
            points.apart(&positions, &moved)
        };
        assert_eq!(apart(&chain(&[4.0], 2.0)), 1.0);
        assert!((apart(&chain(&[1.0, 0.0, 3.0], 2.0)) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_tip_turns_with_its_joint() {
        let skeleton = chain(&[2.0], 1.0);
        let points = Points::of(&skeleton);
        let mut pose = Pose::rest(&skeleton);
        pose.rotations[1] = glam::DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let mut positions = vec![DVec3::ZERO; points.len()];
        points.place(&mut Body::new(&skeleton), &pose, &mut positions);
        assert!(positions[2].abs_diff_eq(DVec3::new(11.0, 1.0, 0.0), 1e-12), "{}", positions[2]);
    }

    #[test]
    fn without_bones_all_points_weigh_the_same() {
        let points = Points::of(&chain(&[0.0], 0.0));
        assert_eq!(points.weights, [1.0 / 3.0; 3]);
        assert_eq!(Points::of(&Skeleton::default()).len(), 0);
    }
}
