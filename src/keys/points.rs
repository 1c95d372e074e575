//! The body as weighted points, over which errors and speeds are averaged.

use glam::DVec3;

use crate::motion::clip::lane_poser::LanePose;
use crate::motion::lanes::{LaneQuat, LaneVec, Lanes};
use crate::motion::{Build, Joint, JointId, Members, Skeleton};

/// The joints of a body and the tips of its End Sites, each weighted by the length of the bone that leads to it.
///
/// A mean over points is therefore a mean over the length of all bones. It stays the same if a rig has more joints
/// along the same spine, or a joint of no length at a hip, and a hand of many short bones counts as a hand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Points {
    joints: usize,
    /// Each tip's joint, and its offset from the joint.
    tips: Vec<(usize, DVec3)>,
    /// Whether each point is of the body, joints first.
    is_own: Vec<bool>,
    /// One weight a point, joints first; their sum is 1.
    weights: Vec<f64>,
}

impl Points {
    /// Builds the points of a skeleton; points that are not of the body weigh 0. `own` is the weight of each joint and
    /// its tips on top of their bones. If no bone counts, it is their only weight.
    ///
    /// If no limbs are known, a joint that turns and has nothing at its end gets a tip, as far away as the joint is
    /// from its parent. In many animals of games a leg is such a joint, and its turn would move nothing.
    pub(super) fn new(skeleton: &Skeleton, build: &Build, own: &[f64]) -> Self {
        let own_skeleton = build.members.skeleton();
        let bare = if build.mannequin.is_none() { bare_ends(own_skeleton) } else { Vec::new() };
        Self::of_members(skeleton, &build.members, bare, own)
    }

    fn of_members(skeleton: &Skeleton, members: &Members, bare: Vec<usize>, own: &[f64]) -> Self {
        let bone = |joint: &Joint| joint.parent.map_or(0.0, |_| joint.offset.length());
        let mut bones: Vec<f64> = members.skeleton().joints.iter().map(bone).collect();
        let mut tips = Vec::new();
        for (joint, data) in skeleton.iter() {
            for end in &data.end_sites {
                tips.push((joint.0, end.offset));
                bones.push(end.offset.length());
            }
        }
        let mut is_own = members.own_points(skeleton);
        for joint in &bare {
            let offset = skeleton.joints[*joint].offset;
            tips.push((*joint, offset));
            bones.push(offset.length());
            is_own.push(true);
        }
        let weigh = |(joint, is_own): (usize, &bool)| if *is_own { own[joint] } else { 0.0 };
        let owners = skeleton.owners().chain(bare);
        let own: Vec<f64> = owners.zip(&is_own).map(weigh).collect();
        let mut weights: Vec<f64> = bones.iter().zip(&own).map(|(bone, own)| bone * own).collect();
        if weights.iter().all(|weight| *weight == 0.0) {
            weights = own;
        }
        let all: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= all);
        Self { joints: skeleton.len(), tips, is_own, weights }
    }

    /// Number of points.
    pub(super) fn len(&self) -> usize {
        self.weights.len()
    }

    /// Writes the positions of the points for some poses in the world, in the file's unit.
    #[inline(always)]
    pub(super) fn place(&self, pose: &LanePose, positions: &mut [LaneVec]) {
        positions[..self.joints].copy_from_slice(&pose.translations);
        self.place_tips(&pose.rotations, positions);
    }

    /// Returns the values of the body's points, of one value a point.
    #[inline(always)]
    pub(super) fn own<'a, T: Copy>(&'a self, values: &'a [T]) -> impl Iterator<Item = T> + 'a {
        values.iter().zip(&self.is_own).filter(|(_, is_own)| **is_own).map(|(value, _)| *value)
    }

    /// Returns the weight of each point, joints first; their sum is 1.
    pub(super) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Writes the positions of the tips after those of the joints, from the joints' world rotations.
    #[inline(always)]
    pub(super) fn place_tips(&self, rotations: &[LaneQuat], positions: &mut [LaneVec]) {
        let (joints, tips) = positions.split_at_mut(self.joints);
        for (tip, (joint, offset)) in tips.iter_mut().zip(&self.tips) {
            *tip = joints[*joint] + rotations[*joint].rotate(LaneVec::splat(*offset));
        }
    }

    /// Returns the weighted mean of one value a point.
    pub(super) fn mean(&self, values: impl Iterator<Item = f64>) -> f64 {
        values.zip(&self.weights).map(|(value, weight)| value * weight).sum()
    }

    /// Returns the largest of one value a point, over points with a weight.
    pub(super) fn furthest(&self, values: impl Iterator<Item = f64>) -> f64 {
        let counting = values.zip(&self.weights).filter(|(_, weight)| **weight > 0.0);
        counting.map(|(value, _)| value).fold(0.0, f64::max)
    }

    /// Returns the squared distance of two poses, a weighted mean over the points.
    #[inline(always)]
    pub(super) fn apart(&self, a: &[LaneVec], b: &[LaneVec]) -> Lanes {
        let mut sum = Lanes::ZERO;
        for ((a, b), weight) in a.iter().zip(b).zip(&self.weights) {
            let way = *a - *b;
            sum = sum + way.dot(way) * Lanes::splat(*weight);
        }
        sum
    }
}

/// Returns the joints that turn, have no tip, and carry nothing.
fn bare_ends(skeleton: &Skeleton) -> Vec<usize> {
    let carries = skeleton.carriers();
    let is_bare = |(joint, data): &(JointId, &Joint)| {
        data.parent.is_some() && data.end_sites.is_empty() && data.turns() && !carries[joint.0]
    };
    skeleton.iter().filter(is_bare).map(|(joint, _)| joint.0).collect()
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;
    use crate::motion::clip::lane_poser::LanePoser;
    use crate::motion::lanes::LANES;
    use crate::motion::{Clip, EndSite};
    use crate::time::{Frame, FrameRate};

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

    fn points_of(skeleton: &Skeleton, own: &[f64]) -> Points {
        Points::of_members(
            skeleton,
            &Members::all_of_one(skeleton, &vec![true; skeleton.len()]),
            vec![],
            own,
        )
    }

    #[test]
    fn a_point_weighs_as_much_as_the_bone_that_leads_to_it() {
        let points = points_of(&chain(&[3.0, 0.0], 1.0), &[1.0; 3]);
        assert_eq!(points.weights, [0.0, 0.75, 0.0, 0.25], "the root's offset is no bone");
        let rest = [LaneVec::default(); 4];
        let moved = [5.0, 2.0, 5.0, 4.0].map(|way| LaneVec::splat(DVec3::Y * way));
        assert_eq!(points.apart(&rest, &moved).0[1], 0.75 * 4.0 + 0.25 * 16.0);
    }

    #[test]
    fn a_joint_and_its_tips_count_as_much_as_a_person_says() {
        let body = chain(&[3.0, 2.0], 1.0);
        assert_eq!(
            points_of(&body, &[1.0, 1.0, 2.0]).weights,
            [0.0, 3.0 / 9.0, 4.0 / 9.0, 2.0 / 9.0]
        );
        assert_eq!(points_of(&body, &[1.0, 1.0, 0.0]).weights, [0.0, 1.0, 0.0, 0.0]);
        let root_alone = points_of(&body, &[2.0, 0.0, 0.0]).weights;
        assert_eq!(root_alone, [1.0, 0.0, 0.0, 0.0], "it has no bone and the only say");
    }

    #[test]
    fn a_joint_more_on_the_same_bone_changes_nothing_that_turns_with_it() {
        let apart = |skeleton: &Skeleton| {
            let points = points_of(skeleton, &vec![1.0; skeleton.len()]);
            let rate = FrameRate::new(24.0).unwrap();
            let clip = Clip::new(skeleton.clone(), rate, Frame(0), 1, vec![]).unwrap();
            let mut positions = vec![LaneVec::default(); points.len()];
            let mut poser = LanePoser::new(&clip);
            poser.rows(&[&[]; LANES]);
            points.place(poser.stand(), &mut positions);
            let up = LaneVec::splat(DVec3::Y);
            let moved: Vec<LaneVec> = positions.iter().map(|position| *position + up).collect();
            points.apart(&positions, &moved).0[0]
        };
        assert_eq!(apart(&chain(&[4.0], 2.0)), 1.0);
        assert!((apart(&chain(&[1.0, 0.0, 3.0], 2.0)) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_tip_turns_with_its_joint() {
        let skeleton = chain(&[2.0], 1.0);
        let points = points_of(&skeleton, &[1.0; 2]);
        let quarter = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let pose = LanePose {
            rotations: [DQuat::IDENTITY, quarter].map(LaneQuat::splat).to_vec(),
            translations: [9.0, 11.0].map(|x| LaneVec::splat(DVec3::X * x)).to_vec(),
        };
        let mut positions = vec![LaneVec::default(); points.len()];
        points.place(&pose, &mut positions);
        let tip = positions[2].lane(0);
        assert!(tip.abs_diff_eq(DVec3::new(11.0, 1.0, 0.0), 1e-12), "{tip}");
    }

    #[test]
    fn without_bones_all_points_weigh_the_same() {
        let points = points_of(&chain(&[0.0], 0.0), &[1.0; 2]);
        assert_eq!(points.weights, [1.0 / 3.0; 3]);
        assert_eq!(points_of(&Skeleton::default(), &[]).len(), 0);
    }
}
