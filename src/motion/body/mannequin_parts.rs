//! The mannequin (デッサン人形): the parts of a drawn body in a rig.
//!
//! A rig gives joints, but often neither the direction of the face nor the end of a toe. Such points are found once
//! and then attached to a joint.

use glam::{DQuat, DVec3};

use crate::motion::body::landmarks::{above, below};
use crate::motion::body::mannequin::{Limb, Mannequin, tips};
use crate::motion::{Body, BodySide, Build, Clip, EndSite, Joint, JointId, Point, Poser, Skeleton};
use crate::time::Frame;

/// Number of frames sampled to find the direction of the face.
const LOOKS: usize = 48;

/// Cosine of the largest angle between rest pose and motion at which the rest pose's direction is used: 40°.
const ALIKE: f64 = 0.766;

/// Least cosine between neck and spine at which the neck's direction tells where the head is: at most 75° off.
const UPWARD: f64 = 0.26;

/// Distance from the wrist to the fingertips, in heights of the body.
const HAND: f64 = 0.105;

/// Longest foot from ankle to toes, and the default for a rig without feet, in heights of the body.
const LONGEST_FOOT: f64 = 0.16;
const FOOT: f64 = 0.13;

/// Distance from between the shoulders to the middle of the head, in heights of the body.
const NECK: f64 = 0.13;

/// Least and largest distance from the head's joint to the middle of the head, in heights of the body.
const HEAD: [f64; 2] = [0.0, 0.13];

/// Distance from the middle of the head to the tip of the nose and to the crown, in heights of the body.
const NOSE: f64 = 0.07;
const CROWN: f64 = 0.07;

/// Position along the spine at which a body bends, as a share of the way from the hips to the shoulders.
const WAIST: f64 = 0.42;

/// Distance from the body's bones beyond which a joint is no part of the drawn body, in heights of the body: long
/// hair, a tail.
const COVERED: f64 = 0.22;

/// Point indices of an arm from the shoulder or of a leg from the hip.
pub(crate) type LimbPoints = [usize; 4];

/// Parts of a body as indices into the points of a pose: joints, then tips, then [`MannequinParts::marks`].
#[derive(Debug, Clone, PartialEq)]
pub struct MannequinParts {
    /// Points that follow joints and tips in a pose: toes, fingertips, middle of the head, nose and crown.
    pub marks: Vec<Point>,
    /// Shoulder, elbow, wrist and fingertips, left and right. A wrist or ankle may be a tip.
    pub arms: [LimbPoints; 2],
    /// Hip, knee, ankle and toes, left and right.
    pub legs: [LimbPoints; 2],
    /// Joint at which the spine bends; `None` for a spine of one bone.
    pub waist: Option<usize>,
    /// Middle of the head, tip of the nose and crown.
    pub head: [usize; 3],
    /// Sign with which up × right points forward: 1, or -1 in a rig whose left and right are exchanged.
    pub forward: f64,
    /// Height of a person with the legs of this rig, in the file's unit.
    pub height: f64,
    /// Joint below which the whole body hangs.
    pub root: usize,
    /// Joint at which the arms branch off.
    pub chest: usize,
    /// Joint that turns the head.
    pub(crate) head_joint: usize,
    /// Whether the bone that leads to each joint lies in the body.
    pub covered: Vec<bool>,
}

impl MannequinParts {
    /// Finds the parts of a body; `None` without head, two arms and two legs.
    pub(crate) fn new(clip: &Clip) -> Option<Self> {
        Self::of_build(clip, &Build::new(clip))
    }

    /// Finds the parts of a body whose build is known.
    pub fn of_build(clip: &Clip, build: &Build) -> Option<Self> {
        let rig = Rig::new(clip, build)?;
        let toes = rig.mannequin.legs.each_ref().map(|leg| rig.toes(leg));
        let (legs_are_left_first, forward) = rig.sides(&rig.mannequin.legs, &toes);
        let (arms_are_left_first, _) = rig.sides(&rig.mannequin.arms, &toes);
        let legs = ordered(rig.mannequin.legs.each_ref(), legs_are_left_first);
        let arms = ordered(rig.mannequin.arms.each_ref(), arms_are_left_first);
        let [face, crown] = rig.looks(forward, [legs[0], legs[1]], arms);
        let head = rig.head(face, crown);
        let marks: Vec<Point> = (legs.iter().map(|leg| rig.toes(leg)))
            .chain(arms.iter().map(|arm| rig.fingertips(arm)))
            .chain(head)
            .collect();
        let ends = clip.skeleton().joints.iter().map(|joint| joint.end_sites.len()).sum::<usize>();
        let first = clip.skeleton().len() + ends;
        let limb = |limb: &Limb, mark: usize| {
            let points = [limb.upper, limb.middle, limb.lower];
            let [upper, middle, lower] = points.map(|point| index(clip.skeleton(), point));
            [upper, middle, lower, first + mark]
        };
        Some(Self {
            arms: [limb(arms[0], 2), limb(arms[1], 3)],
            legs: [limb(legs[0], 0), limb(legs[1], 1)],
            waist: rig.waist(),
            head: [4, 5, 6].map(|mark| first + mark),
            forward,
            height: rig.height,
            root: rig.root(),
            chest: rig.mannequin.chest,
            head_joint: rig.head_joint(),
            covered: rig.covered(),
            marks,
        })
    }
}

/// Returns the index of a joint or of a tip among the points of a pose.
fn index(skeleton: &Skeleton, point: Point) -> usize {
    let JointId(joint) = point.joint;
    let ends = |joints: &[Joint]| joints.iter().map(|joint| joint.end_sites.len()).sum::<usize>();
    let is_tip = |end: &EndSite| end.offset == point.offset && end.offset != DVec3::ZERO;
    let tip = skeleton.joints[joint].end_sites.iter().position(is_tip);
    tip.map_or(joint, |tip| skeleton.len() + ends(&skeleton.joints[..joint]) + tip)
}

/// Returns the left limb before the right one.
fn ordered([a, b]: [&Limb; 2], is_left_first: bool) -> [&Limb; 2] {
    if is_left_first { [a, b] } else { [b, a] }
}

/// A rig with frequently needed values.
struct Rig<'a> {
    clip: &'a Clip,
    /// Skeleton of the body alone.
    skeleton: &'a Skeleton,
    mannequin: &'a Mannequin,
    /// Positions of the joints at rest.
    rest: Vec<DVec3>,
    up: DVec3,
    height: f64,
}

impl<'a> Rig<'a> {
    fn new(clip: &'a Clip, build: &'a Build) -> Option<Self> {
        let mannequin = build.mannequin.as_ref()?;
        let skeleton = build.members.skeleton();
        let mut rest: Vec<DVec3> = Vec::with_capacity(skeleton.len());
        for joint in &skeleton.joints {
            rest.push(joint.offset + joint.parent.map_or(DVec3::ZERO, |parent| rest[parent.0]));
        }
        let (up, height) = (build.stature.up.unit(), mannequin.height());
        Some(Self { clip, skeleton, mannequin, rest, up, height })
    }

    /// Returns the joint that turns the head. If the head is short, the landmark is the neck; then this is the last
    /// turning joint of the unbranched chain above it.
    fn head_joint(&self) -> usize {
        let skeleton = self.skeleton;
        let mut head = self.mannequin.head.joint.0;
        let carries = |joint: usize| {
            let is_on = |other: &Joint| other.parent == Some(JointId(joint));
            skeleton.joints.iter().any(is_on) || !skeleton.joints[joint].end_sites.is_empty()
        };
        let goes_on = |head: usize| {
            let turning = skeleton
                .iter()
                .filter(|(_, joint)| joint.parent == Some(JointId(head)) && joint.turns());
            let children: Vec<usize> = turning.map(|(joint, _)| joint.0).collect();
            <[usize; 1]>::try_from(children)
                .ok()
                .map(|[child]| child)
                .filter(|child| carries(*child))
        };
        while let Some(child) = goes_on(head) {
            head = child;
        }
        head
    }

    fn at_rest(&self, point: Point) -> DVec3 {
        self.rest[point.joint.0] + point.offset
    }

    /// Returns the end of a foot, its point furthest from the ankle. A claw is cut to the longest human foot; a
    /// missing foot gets the usual length.
    fn toes(&self, leg: &Limb) -> Point {
        let ankle = self.at_rest(leg.lower);
        let way = |point: &Point| self.at_rest(*point) - ankle;
        let ends = tips(self.skeleton, leg.lower.joint.0).into_iter().chain(leg.tips.clone());
        let furthest = ends.max_by(|a, b| way(a).length().total_cmp(&way(b).length()));
        let long = furthest.map_or(0.0, |end| way(&end).length());
        match furthest.filter(|_| long > 0.03 * self.height) {
            Some(end) if long <= LONGEST_FOOT * self.height => end,
            Some(end) => {
                let foot = LONGEST_FOOT * self.height * way(&end).normalize();
                Point { offset: leg.lower.offset + foot, ..leg.lower }
            }
            None => {
                let shin = ankle - self.at_rest(leg.middle);
                let across = self.across_at_rest();
                let forward = across.cross(shin).normalize_or_zero();
                Point { offset: leg.lower.offset + FOOT * self.height * forward, ..leg.lower }
            }
        }
    }

    /// Returns the end of a hand, in the direction of its fingers and at the usual length.
    fn fingertips(&self, arm: &Limb) -> Point {
        let wrist = arm.lower.joint.0;
        let joints = self.skeleton.joints.iter();
        let children = joints.filter(|joint| joint.parent.is_some_and(|parent| parent.0 == wrist));
        let ends = self.skeleton.joints[wrist].end_sites.iter().map(|end| end.offset);
        let ways = children.map(|joint| joint.offset).chain(ends);
        let way: DVec3 = ways.filter(|way| way.length() > 0.01 * self.height).sum();
        let forearm = self.at_rest(arm.lower) - self.at_rest(arm.middle);
        let way = way.try_normalize().unwrap_or_else(|| forearm.normalize_or_zero());
        Point { offset: arm.lower.offset + HAND * self.height * way, ..arm.lower }
    }

    /// Returns the middle of the head, its nose and its crown.
    fn head(&self, face: DVec3, crown: DVec3) -> [Point; 3] {
        let joint = self.mannequin.head.joint.0;
        let shoulders = self.mannequin.arms.each_ref().map(|arm| self.rest[arm.upper.joint.0]);
        let neck = self.rest[joint].distance(shoulders[0].midpoint(shoulders[1]));
        let [nearest, furthest] = HEAD.map(|share| share * self.height);
        let far = (NECK * self.height - neck).clamp(nearest, furthest);
        let middle = far * crown + 0.15 * far * face;
        let [nose, top] = [NOSE * face, CROWN * crown].map(|way| middle + self.height * way);
        [middle, nose, top].map(|offset| Point { offset, ..Point::new(joint) })
    }

    /// Returns the directions of the face and of the crown, in the axes of the head's joint.
    ///
    /// Averaged over a clip, the head looks where the chest does. The rest pose gives the exact direction if it is
    /// similar.
    fn looks(&self, forward: f64, legs: [&Limb; 2], arms: [&Limb; 2]) -> [DVec3; 2] {
        let front = |place: &dyn Fn(Point) -> DVec3| {
            let middle = |limbs: &[&Limb; 2]| place(limbs[0].upper).midpoint(place(limbs[1].upper));
            let across = place(arms[1].upper) - place(arms[0].upper);
            let spine = (middle(&arms) - middle(&legs)).normalize_or_zero();
            let neck = (place(self.mannequin.head) - middle(&arms)).normalize_or(spine);
            // The joint of a head between raised shoulders does not tell where its top is.
            let neck = if neck.dot(spine) > UPWARD { neck } else { spine };
            [(forward * spine.cross(across)).normalize_or_zero(), spine, neck]
        };
        let (mut poser, mut body) = (Poser::new(self.clip), Body::new(self.clip.skeleton()));
        let [mut face, mut crown] = [DVec3::ZERO; 2];
        let looks = self.clip.len().min(LOOKS);
        for look in 0..looks {
            let frame = self.clip.first().0 + look * self.clip.len() / looks;
            body.place(poser.frame(Frame(frame)));
            let [ahead, spine, neck] = front(&|point| point.position(&body));
            let back: DQuat = body.rotations()[self.mannequin.head.joint.0].conjugate();
            face += back * ahead;
            crown += back * (spine + neck);
        }
        let [ahead, spine, _] = front(&|point| self.at_rest(point));
        let nearer = |rest: DVec3, mean: DVec3| {
            let mean = mean.normalize_or(rest);
            if rest.dot(mean) > ALIKE { rest } else { mean }
        };
        let face = nearer(ahead, face);
        let crown = nearer(spine, crown);
        let crown = (crown - crown.dot(face) * face).normalize_or(face.any_orthonormal_vector());
        [face, crown]
    }

    /// Returns the vector from the right hip to the left one at rest. If names tell no side, the first leg is the
    /// left one.
    fn across_at_rest(&self) -> DVec3 {
        let [a, b] = self.mannequin.legs.each_ref().map(|leg| self.rest[leg.upper.joint.0]);
        if self.named(&self.mannequin.legs).unwrap_or(true) { a - b } else { b - a }
    }

    /// Whether the first of two limbs is the left one, if names tell.
    fn named(&self, limbs: &[Limb; 2]) -> Option<bool> {
        let side = |limb: &Limb| {
            let joints = [limb.upper, limb.middle, limb.lower].map(|point| point.joint.0);
            let sides = joints.map(|joint| BodySide::from_name(&self.skeleton.joints[joint].name));
            sides.into_iter().find(|side| *side != BodySide::Trunk)
        };
        match [side(&limbs[0]), side(&limbs[1])] {
            [Some(BodySide::Left), _] | [_, Some(BodySide::Right)] => Some(true),
            [Some(BodySide::Right), _] | [_, Some(BodySide::Left)] => Some(false),
            _ => None,
        }
    }

    /// Returns whether the first of two limbs is the left one, and the sign with which up × right points forward,
    /// where the toes point.
    fn sides(&self, limbs: &[Limb; 2], toes: &[Point; 2]) -> (bool, f64) {
        let mut body = Body::new(self.clip.skeleton());
        body.place(Poser::new(self.clip).frame(self.clip.first()));
        let at = |point: Point| point.position(&body);
        let ankles = self.mannequin.legs.each_ref().map(|leg| at(leg.lower));
        let ahead = (at(toes[0]) - ankles[0]) + (at(toes[1]) - ankles[1]);
        let ahead = ahead - self.up * ahead.dot(self.up);
        let across = at(limbs[1].upper) - at(limbs[0].upper);
        // Uses the body's own up direction, because it may be lying down.
        let spine = at(self.mannequin.head) - ankles[0].midpoint(ankles[1]);
        let first_is_left = self.named(limbs);
        let turn = spine.cross(across).dot(ahead);
        let is_left = first_is_left.unwrap_or(turn >= 0.0);
        let turn = if is_left { turn } else { -turn };
        (is_left, if turn >= 0.0 { 1.0 } else { -1.0 })
    }

    /// Returns the joint at which the spine bends.
    fn waist(&self) -> Option<usize> {
        let middle = |limbs: &[Limb; 2]| {
            let tops = limbs.each_ref().map(|limb| self.rest[limb.upper.joint.0]);
            tops[0].midpoint(tops[1])
        };
        let (hips, shoulders) = (middle(&self.mannequin.legs), middle(&self.mannequin.arms));
        let root = self.root();
        let spine = above(self.skeleton, self.mannequin.chest).take_while(|joint| *joint != root);
        let share = |joint: usize| {
            let [low, high] = [hips, shoulders].map(|end| self.rest[joint].distance(end));
            low / (low + high).max(f64::MIN_POSITIVE)
        };
        let off = |joint: &usize| (share(*joint) - WAIST).abs();
        let nearest = spine.min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.filter(|joint| off(joint) < 0.25)
    }

    /// Returns the lowest joint that carries the whole body. A game rig's root on the floor is above it.
    fn root(&self) -> usize {
        let skeleton = self.skeleton;
        let ends = self.ends();
        let is_above_all = |joint: &usize| {
            ends.iter().all(|end| above(skeleton, *end).any(|above| above == *joint))
        };
        above(skeleton, ends[0]).find(is_above_all).unwrap_or(0)
    }

    /// Returns head, wrists and ankles.
    fn ends(&self) -> [usize; 5] {
        let Mannequin { head, arms, legs, .. } = self.mannequin;
        [*head, arms[0].lower, arms[1].lower, legs[0].lower, legs[1].lower].map(|end| end.joint.0)
    }

    /// Finds the joints whose bones lie in the body: all bones on the ways to its ends, and nearby ones.
    fn covered(&self) -> Vec<bool> {
        let (skeleton, root) = (self.skeleton, self.root());
        let mut far = vec![f64::INFINITY; skeleton.len()];
        far[root] = 0.0;
        for end in self.ends() {
            let way = above(skeleton, end).take_while(|joint| *joint != root);
            way.for_each(|joint| far[joint] = 0.0);
        }
        for joint in below(skeleton, root).skip(1) {
            let data = &skeleton.joints[joint];
            let parent = data.parent.map_or(f64::INFINITY, |parent| far[parent.0]);
            far[joint] = far[joint].min(parent + data.offset.length());
        }
        far[root] = f64::INFINITY;
        far.into_iter().map(|far| far <= COVERED * self.height).collect()
    }
}

#[cfg(test)]
mod tests;
