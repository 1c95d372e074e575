//! The mannequin (人形): standard bones that point in the directions of a rig's bones.
//!
//! Two rigs of one performer differ in details that are no part of the motion: the number of spine joints, the
//! position of a hip, the tip of a toe. A mannequin has the same bones for every rig, so that measurements on it
//! depend on the motion and not on the rig.

use glam::DVec3;

use crate::motion::body::limbs::{LEG, NamedLimbs};
use crate::motion::landmarks::{above, below, lengths};
use crate::motion::{BodySide, EndSite, Landmarks, Point, Skeleton};

/// Number of points of a mannequin besides its pelvis: neck, head, and for each side shoulder, elbow, wrist,
/// fingertips, hip, knee, ankle and toes.
pub(crate) const POINTS: usize = 18;

/// Length of the bone that leads to each point, in heights of the body: usual proportions of an adult.
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

/// Length along the bones from the root to the head plus that from the root to an ankle, in heights of the body.
const TRUNK_AND_LEG: f64 = 0.9;

/// Length of upper arm and forearm together, in heights of the body.
const ARM: f64 = 0.32;

/// The bones of a mannequin located in a rig.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mannequin {
    pub(super) head: Point,
    /// Joint at which the arms branch off.
    pub(super) chest: usize,
    pub(super) arms: [Limb; 2],
    pub(super) legs: [Limb; 2],
    /// Height of a person with the legs of this rig, but at least the length along the bones from its ankles to its
    /// head, in the file's unit.
    height: f64,
}

/// An arm or a leg.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Limb {
    /// Shoulder or hip.
    pub(super) upper: Point,
    /// Elbow or knee; without one, the end of the limb.
    pub(super) middle: Point,
    /// Wrist or ankle.
    pub(super) lower: Point,
    /// Points at its end: fingertips, or the sole.
    pub(super) tips: Vec<Point>,
}

/// A mannequin in a pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stand {
    /// Vector of each point from the pelvis, in heights of the body.
    pub(crate) points: [DVec3; POINTS],
    /// Position of the pelvis, in heights of the body.
    pub(crate) pelvis: DVec3,
    /// Unit vectors across the hips and across the shoulders.
    pub(crate) across: [DVec3; 2],
}

impl Mannequin {
    /// Locates the bones in a rig by their lengths; `None` for a body without head, two arms and two legs.
    pub(super) fn new(
        skeleton: &Skeleton,
        landmarks: &Landmarks,
        named: &NamedLimbs,
    ) -> Option<Self> {
        let [left_hand, right_hand] = landmarks.wrists[..] else { return None };
        let [left_foot, right_foot] = landmarks.feet[..] else { return None };
        let head = landmarks.head?;
        let lengths = lengths(skeleton);
        let pair = |ends| Pair::find(skeleton, named, &lengths, ends);
        let arms = pair([left_hand, right_hand]);
        let legs = pair([left_foot.ankle, right_foot.ankle]);
        let hands = arms.ends.map(|wrist| tips(skeleton, wrist.joint.0));
        let soles = [left_foot.sole, right_foot.sole].map(|sole| vec![sole]);
        // Measures the bones and not the motion: a crouching body has legs as long as ever. A game rig's root on the
        // floor is no bone.
        let trunk = pair([head, Point::new(legs.fork)]);
        let to_hips = lengths[trunk.fork];
        let height = (lengths[head.joint.0] + legs.mean_length() - 2.0 * to_hips) / TRUNK_AND_LEG;
        let arms_found = arms.limbs(ARM * height, hands)?;
        let legs_found = legs.limbs(LEG * height, soles)?;
        let leg = |leg: &Limb| legs.length(leg.lower) - legs.length(leg.upper);
        let leg_length = f64::midpoint(leg(&legs_found[0]), leg(&legs_found[1]));
        // A doll with a large head and short legs is at least as tall as its length from ankles to head.
        let upright = TRUNK_AND_LEG * height;
        (leg_length > 0.0).then_some(Self {
            head,
            chest: arms.fork,
            arms: arms_found,
            legs: legs_found,
            height: f64::max(leg_length / LEG, upright),
        })
    }

    /// Returns the height of a person with the legs of this rig, but at least the length along the bones from its
    /// ankles to its head, in the file's unit.
    pub(crate) fn height(&self) -> f64 {
        self.height
    }

    /// Returns the joint of the rig for each point.
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

    /// Returns the joint of the head.
    pub(crate) fn head(&self) -> usize {
        self.head.joint.0
    }

    /// Returns the joint at which the arms branch off.
    pub(crate) fn chest(&self) -> usize {
        self.chest
    }

    /// Returns shoulder, elbow and wrist of each arm, in the order of the wrists.
    pub(crate) fn arms(&self) -> [[usize; 3]; 2] {
        self.arms.each_ref().map(Limb::joints)
    }

    /// Returns hip, knee and ankle of each leg, in the order of the feet.
    pub(crate) fn legs(&self) -> [[usize; 3]; 2] {
        self.legs.each_ref().map(Limb::joints)
    }

    /// Returns the first joints of the limbs: left and right shoulder, left and right hip, if names tell the sides.
    pub(crate) fn limb_tops(&self, skeleton: &Skeleton) -> [usize; 4] {
        let left_first = |limbs: &[Limb; 2]| {
            let tops = [&limbs[0], &limbs[1]].map(|limb| limb.upper.joint.0);
            let is = |at: usize, side| BodySide::from_name(&skeleton.joints[tops[at]].name) == side;
            let is_turned = is(0, BodySide::Right) || is(1, BodySide::Left);
            if is_turned { [tops[1], tops[0]] } else { tops }
        };
        let ([a, b], [c, d]) = (left_first(&self.arms), left_first(&self.legs));
        [a, b, c, d]
    }

    /// Returns hip and ankle of each leg, in the order of the feet.
    pub(crate) fn leg_ends(&self) -> [[Point; 2]; 2] {
        self.legs.each_ref().map(|leg| [leg.upper, leg.lower])
    }

    /// Computes the mannequin in the pose of the rig; `place` gives the world position of a point of the rig.
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
    /// Returns its joints, from the trunk outward.
    fn joints(&self) -> [usize; 3] {
        [self.upper, self.middle, self.lower].map(|point| point.joint.0)
    }

    /// Writes the limb's four points from index `first` on. It hangs on `trunk` in the rig and on `from` in the
    /// mannequin. A bone that the rig lacks points in the direction of the bone before it.
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

/// A pair of limbs, from their fork to their ends.
struct Pair<'a> {
    skeleton: &'a Skeleton,
    named: &'a NamedLimbs,
    /// Distance of each joint from its root along the bones.
    lengths: &'a [f64],
    ends: [Point; 2],
    fork: usize,
}

impl<'a> Pair<'a> {
    fn find(
        skeleton: &'a Skeleton,
        named: &'a NamedLimbs,
        lengths: &'a [f64],
        ends: [Point; 2],
    ) -> Self {
        let [first, second] = ends.map(|end| above(skeleton, end.joint.0));
        let up: Vec<usize> = first.collect();
        let fork = second.into_iter().find(|joint| up.contains(joint)).unwrap_or(0);
        Self { skeleton, named, lengths, ends, fork }
    }

    /// Returns the mean length of both from the root to their ends.
    fn mean_length(&self) -> f64 {
        f64::midpoint(self.length(self.ends[0]), self.length(self.ends[1]))
    }

    /// Returns the length along the bones from the root to a point.
    fn length(&self, point: Point) -> f64 {
        self.lengths[point.joint.0] + point.offset.length()
    }

    /// Finds the joints of both limbs; `length` is the usual length from shoulder to wrist or from hip to ankle.
    fn limbs(&self, length: f64, tips: [Vec<Point>; 2]) -> Option<[Limb; 2]> {
        let [left, right] = tips;
        Some([self.limb(self.ends[0], length, left)?, self.limb(self.ends[1], length, right)?])
    }

    /// Uses the named joints if there are any. Otherwise shoulder and elbow are the turning joints with the most
    /// usual distances to the wrist; this skips collar bones, twist joints and elbows made of two bones.
    fn limb(&self, lower: Point, length: f64, tips: Vec<Point>) -> Option<Limb> {
        let end = lower.joint.0;
        if let Some(limb) = self.named.ending_at(end) {
            let [upper, middle, _] = limb.map(Point::new);
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
        let [upper, middle] = [upper, middle].map(Point::new);
        Some(Limb { upper, middle, lower, tips })
    }
}

/// Returns the tips at and below a joint, and the leaf joints below it that have no tip; empty if nothing hangs on
/// the joint.
pub(super) fn tips(skeleton: &Skeleton, top: usize) -> Vec<Point> {
    let carries = skeleton.carriers();
    let mut tips = Vec::new();
    for joint in below(skeleton, top) {
        let ends = &skeleton.joints[joint].end_sites;
        let at = |end: &EndSite| Point { offset: end.offset, ..Point::new(joint) };
        tips.extend(ends.iter().map(at));
        if ends.is_empty() && !carries[joint] && joint != top {
            tips.push(Point::new(joint));
        }
    }
    tips
}

#[cfg(test)]
mod tests;
