//! The mannequin (人形): standard bones that point where a rig's bones point.
//!
//! Two rigs of one performer differ in much that is no part of the motion: how many joints a spine has,
//! where a hip sits, whether a toe has a tip. A mannequin has the same bones on everybody, so that what
//! is judged on it follows the motion and not the rig.

use glam::DVec3;

use crate::motion::body::limbs::{LEG, NamedLimbs};
use crate::motion::landmarks::{above, below, lengths};
use crate::motion::{BodySide, EndSite, JointId, Landmarks, Point, Skeleton};

/// Points of a mannequin besides its pelvis: neck, head, and of each side shoulder, elbow, wrist,
/// fingertips, hip, knee, ankle and toes.
pub(crate) const POINTS: usize = 18;

/// The bone that leads to each point, in heights of the body: usual proportions of a grown person.
pub(crate) const BONES: [f64; POINTS] = {
    let mut bones = [0.0; POINTS];
    [bones[0], bones[1]] = [0.30, 0.14];
    let side = [0.11, 0.17, 0.15, 0.10, 0.05, 0.24, 0.24, 0.13];
    let mut point = 0;
    while point < 2 * side.len() {
        bones[2 + point] = side[point % side.len()];
        point += 1;
    }
    bones
};

/// From the root to the head and to an ankle along the bones, both together, in heights of the body.
const TRUNK_AND_LEG: f64 = 0.9;

/// Upper arm and forearm together, in heights of the body.
const ARM: f64 = 0.32;

/// Where a mannequin's bones are in a rig.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mannequin {
    pub(super) head: Point,
    /// Where the arms part.
    pub(super) chest: usize,
    pub(super) arms: [Limb; 2],
    pub(super) legs: [Limb; 2],
    /// The height of a person with the legs of this rig, and no less than from its ankles to its head along the bones, in the
    /// file's unit.
    height: f64,
}

/// An arm or a leg.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Limb {
    /// Shoulder or hip.
    pub(super) upper: Point,
    /// Elbow or knee; the end of the limb where it has none.
    pub(super) middle: Point,
    /// Wrist or ankle.
    pub(super) lower: Point,
    /// What hangs on it: fingertips, or the sole.
    pub(super) tips: Vec<Point>,
}

/// A mannequin in a pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stand {
    /// Each point from the pelvis, in heights of the body.
    pub(crate) points: [DVec3; POINTS],
    /// Where the pelvis is, in heights of the body.
    pub(crate) pelvis: DVec3,
    /// From one hip to the other and from one shoulder to the other: each of length 1.
    pub(crate) across: [DVec3; 2],
}

impl Mannequin {
    /// Finds its bones in a rig by their lengths; none in a body without head, two arms and two legs.
    pub(super) fn of(
        skeleton: &Skeleton,
        landmarks: &Landmarks,
        named: &NamedLimbs,
    ) -> Option<Self> {
        let [left_hand, right_hand] = landmarks.wrists[..] else { return None };
        let [left_foot, right_foot] = landmarks.feet[..] else { return None };
        let head = landmarks.head?;
        let lengths = lengths(skeleton);
        let pair = |ends| Pair::of(skeleton, named, &lengths, ends);
        let arms = pair([left_hand.joint, right_hand.joint]);
        let legs = pair([left_foot.ankle.joint, right_foot.ankle.joint]);
        let hands = arms.ends.map(|wrist| tips(skeleton, wrist));
        let soles = [left_foot.sole, right_foot.sole].map(|sole| vec![sole]);
        // The bones and not the motion: somebody who crouches has legs as long as ever. A game's root on the floor is
        // no bone.
        let trunk = pair([head.joint, JointId(legs.fork)]);
        let to_hips = lengths[trunk.fork];
        let height = (lengths[head.joint.0] + legs.mean_length() - 2.0 * to_hips) / TRUNK_AND_LEG;
        let arms_found = arms.limbs(ARM * height, hands)?;
        let legs_found = legs.limbs(LEG * height, soles)?;
        let leg = |leg: &Limb| lengths[leg.lower.joint.0] - lengths[leg.upper.joint.0];
        let leg_length = f64::midpoint(leg(&legs_found[0]), leg(&legs_found[1]));
        // A doll with a large head and short legs is no shorter than the way from its ankles to its head.
        let upright = TRUNK_AND_LEG * height;
        (leg_length > 0.0).then_some(Self {
            head,
            chest: arms.fork,
            arms: arms_found,
            legs: legs_found,
            height: f64::max(leg_length / LEG, upright),
        })
    }

    /// The height of a person with the legs of this rig, and no less than from its ankles to its head along the bones, in the
    /// file's unit.
    pub(crate) fn height(&self) -> f64 {
        self.height
    }

    /// The joint of the rig at which each point is looked for.
    pub(crate) fn joints(&self) -> [usize; POINTS] {
        let limb = |limb: &Limb| {
            let [upper, middle, lower] =
                [limb.upper, limb.middle, limb.lower].map(|point| point.joint.0);
            [upper, middle, lower, lower]
        };
        let mut joints = [self.chest; POINTS];
        joints[1] = self.head.joint.0;
        for (side, joints) in joints[2..].chunks_exact_mut(8).enumerate() {
            joints[..4].copy_from_slice(&limb(&self.arms[side]));
            joints[4..].copy_from_slice(&limb(&self.legs[side]));
        }
        joints
    }

    /// The joint of the head.
    pub(crate) fn head(&self) -> usize {
        self.head.joint.0
    }

    /// The joint at which the arms part.
    pub(crate) fn chest(&self) -> usize {
        self.chest
    }

    /// Shoulder, elbow and wrist of each arm, in the order of the wrists.
    pub(crate) fn arms(&self) -> [[usize; 3]; 2] {
        self.arms.each_ref().map(Limb::joints)
    }

    /// Hip, knee and ankle of each leg, in the order of the feet.
    pub(crate) fn legs(&self) -> [[usize; 3]; 2] {
        self.legs.each_ref().map(Limb::joints)
    }

    /// Where the limbs begin: left and right shoulder, left and right hip, as far as names tell a side.
    pub(crate) fn limb_tops(&self, skeleton: &Skeleton) -> [usize; 4] {
        let left_first = |limbs: &[Limb; 2]| {
            let tops = [&limbs[0], &limbs[1]].map(|limb| limb.upper.joint.0);
            let is = |at: usize, side| BodySide::of(&skeleton.joints[tops[at]].name) == side;
            let is_turned = is(0, BodySide::Right) || is(1, BodySide::Left);
            if is_turned { [tops[1], tops[0]] } else { tops }
        };
        let ([a, b], [c, d]) = (left_first(&self.arms), left_first(&self.legs));
        [a, b, c, d]
    }

    /// The mannequin in the pose of the rig; `place` says where a point of the rig stands in the world.
    pub(crate) fn stand(&self, place: impl Fn(Point) -> DVec3) -> Stand {
        let middle = |limbs: &[Limb; 2]| {
            let [left, right] = [&limbs[0], &limbs[1]].map(|limb| place(limb.upper));
            (left.midpoint(right), (right - left).normalize_or_zero())
        };
        let (pelvis, hips) = middle(&self.legs);
        let (neck, shoulders) = middle(&self.arms);
        let mut points = [DVec3::ZERO; POINTS];
        points[0] = BONES[0] * (neck - pelvis).normalize_or_zero();
        points[1] = points[0] + BONES[1] * (place(self.head) - neck).normalize_or_zero();
        for side in 0..2 {
            let first = 2 + 8 * side;
            let [from_neck, from_pelvis] = [points[0], DVec3::ZERO];
            self.arms[side].reach(neck, from_neck, first, &place, &mut points);
            self.legs[side].reach(pelvis, from_pelvis, first + 4, &place, &mut points);
        }
        Stand { points, pelvis: pelvis / self.height, across: [hips, shoulders] }
    }
}

impl Limb {
    /// Its joints from the trunk on.
    fn joints(&self) -> [usize; 3] {
        [self.upper, self.middle, self.lower].map(|point| point.joint.0)
    }

    /// Writes the limb's four points from `first` on: it hangs on `trunk` in the rig and on `from` in
    /// the mannequin. A bone that the rig does not have points as the one before it.
    fn reach(
        &self,
        trunk: DVec3,
        from: DVec3,
        first: usize,
        place: impl Fn(Point) -> DVec3,
        points: &mut [DVec3; POINTS],
    ) {
        let tips = self.tips.iter().map(|tip| place(*tip)).sum::<DVec3>();
        let lower = place(self.lower);
        let tip = if self.tips.is_empty() { lower } else { tips / self.tips.len() as f64 };
        let rig = [trunk, place(self.upper), place(self.middle), lower, tip];
        let (mut at, mut way) = (from, DVec3::ZERO);
        for (bone, ends) in rig.windows(2).enumerate() {
            way = (ends[1] - ends[0]).normalize_or(way);
            at += BONES[first + bone] * way;
            points[first + bone] = at;
        }
    }
}

/// Two limbs, from where they part to their ends.
struct Pair<'a> {
    skeleton: &'a Skeleton,
    named: &'a NamedLimbs,
    /// How far each joint is from its root along the bones.
    lengths: &'a [f64],
    ends: [usize; 2],
    fork: usize,
}

impl<'a> Pair<'a> {
    fn of(
        skeleton: &'a Skeleton,
        named: &'a NamedLimbs,
        lengths: &'a [f64],
        ends: [JointId; 2],
    ) -> Self {
        let ends = ends.map(|end| end.0);
        let up: Vec<usize> = above(skeleton, ends[0]).collect();
        let fork = above(skeleton, ends[1]).find(|joint| up.contains(joint)).unwrap_or(0);
        Self { skeleton, named, lengths, ends, fork }
    }

    /// From the root to their ends, the mean of both.
    fn mean_length(&self) -> f64 {
        f64::midpoint(self.lengths[self.ends[0]], self.lengths[self.ends[1]])
    }

    /// The joints of both; `length` is what a usual limb has from shoulder to wrist or hip to ankle.
    fn limbs(&self, length: f64, tips: [Vec<Point>; 2]) -> Option<[Limb; 2]> {
        let [left, right] = tips;
        Some([self.limb(self.ends[0], length, left)?, self.limb(self.ends[1], length, right)?])
    }

    /// As names have it. Else shoulder and elbow are the joints that turn whose distance to the wrist is nearest to the usual
    /// one: a collar bone, a twist joint or an elbow of two bones is passed over.
    fn limb(&self, end: usize, length: f64, tips: Vec<Point>) -> Option<Limb> {
        if let Some(limb) = self.named.ending_at(end) {
            let [upper, middle, lower] = limb.map(Point::of);
            return Some(Limb { upper, middle, lower, tips });
        }
        let inner: Vec<usize> = above(self.skeleton, end)
            .skip(1)
            .take_while(|joint| {
                *joint != self.fork && self.skeleton.joints[*joint].parent.is_some()
            })
            .filter(|joint| self.skeleton.joints[*joint].turns())
            .collect();
        let to_end = |joint: usize| self.lengths[end] - self.lengths[joint];
        let nearest = |joints: &[usize], length: f64| {
            let off = |joint: &usize| (to_end(*joint) - length).abs();
            joints.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)))
        };
        let upper = nearest(&inner, length)?;
        let below: Vec<usize> =
            inner.into_iter().filter(|joint| to_end(*joint) < to_end(upper)).collect();
        let middle = nearest(&below, to_end(upper) / 2.0).unwrap_or(end);
        let [upper, middle, lower] = [upper, middle, end].map(Point::of);
        Some(Limb { upper, middle, lower, tips })
    }
}

/// The tips of all that hangs on a joint, and the joints without any at its ends; none where nothing
/// hangs on it.
pub(super) fn tips(skeleton: &Skeleton, top: usize) -> Vec<Point> {
    let carries = skeleton.carriers();
    let mut tips = Vec::new();
    for joint in below(skeleton, top) {
        let ends = &skeleton.joints[joint].end_sites;
        let at = |end: &EndSite| Point { offset: end.offset, ..Point::of(joint) };
        tips.extend(ends.iter().map(at));
        if ends.is_empty() && !carries[joint] && joint != top {
            tips.push(Point::of(joint));
        }
    }
    tips
}

#[cfg(test)]
mod tests;
