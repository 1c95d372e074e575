//! The lay figure (デッサン人形): where the parts of a drawn body are in a rig.
//!
//! A rig says where joints are. Which way a face looks and where a toe ends it often does not: those points are found
//! once, and each is then carried by a joint.

use glam::{DQuat, DVec3};

use crate::motion::body::landmarks::{above, below};
use crate::motion::body::mannequin::{Limb, Mannequin, tips};
use crate::motion::{Body, BodySide, Build, Clip, Joint, JointId, Point, Poser, Skeleton};
use crate::time::Frame;

/// Frames that are looked at to know which way a head looks.
const LOOKS: usize = 48;

/// A direction at rest is taken for that of the motion within this angle, by its cosine: 40°.
const ALIKE: f64 = 0.766;

/// How far up the spine a neck has to point to say where a head is, by its cosine: 75° off.
const UPWARD: f64 = 0.26;

/// From a wrist to the fingertips, in heights of the body.
const HAND: f64 = 0.105;

/// The longest foot from ankle to toes, and one that a rig does not have, in heights of the body.
const LONGEST_FOOT: f64 = 0.16;
const FOOT: f64 = 0.13;

/// From between the shoulders to the middle of the head, in heights of the body.
const NECK: f64 = 0.13;

/// How far the middle of a head may be from its joint, in heights of the body.
const HEAD: [f64; 2] = [0.0, 0.13];

/// From the middle of a head to the tip of the nose and to the crown, in heights of the body.
const NOSE: f64 = 0.07;
const CROWN: f64 = 0.07;

/// Where along the spine a body bends, as a share of the way from the hips to the shoulders.
const WAIST: f64 = 0.42;

/// What hangs further from the body's bones than this is no part of it, in heights of the body: long hair, a tail.
const COVERED: f64 = 0.22;

/// An arm from the shoulder or a leg from the hip: the numbers of its points.
pub(crate) type LimbPoints = [usize; 4];

/// Where the parts of a body are among the points of a pose: joints, then tips, then [`LayFigure::marks`].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LayFigure {
    /// What a pose has besides joints and tips.
    pub(crate) marks: Vec<Point>,
    /// Shoulder, elbow, wrist and fingertips, left and right.
    pub(crate) arms: [LimbPoints; 2],
    /// Hip, knee, ankle and toes, left and right.
    pub(crate) legs: [LimbPoints; 2],
    /// Where the spine bends; none where it is one bone.
    pub(crate) waist: Option<usize>,
    /// The middle of the head, the tip of its nose, its crown.
    pub(crate) head: [usize; 3],
    /// Which of both ways across hips and up is forward: 1, or -1 in a rig whose left and right are exchanged.
    pub(crate) forward: f64,
    /// The height of a person with the legs of this rig, in the file's unit.
    pub(crate) height: f64,
    /// The joint below which the whole body hangs.
    pub(crate) root: usize,
    /// The joint at which the arms part.
    pub(crate) chest: usize,
    /// The joint that turns the head.
    pub(crate) head_joint: usize,
    /// Of each joint whether the bone that leads to it lies in the body.
    pub(crate) covered: Vec<bool>,
}

impl LayFigure {
    /// Finds the parts; none in a body without head, two arms and two legs.
    pub(crate) fn of(clip: &Clip) -> Option<Self> {
        Self::of_build(clip, &Build::of(clip))
    }

    /// The same of a body that is described.
    pub(crate) fn of_build(clip: &Clip, build: &Build) -> Option<Self> {
        let rig = Rig::of(clip, build)?;
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
            let [upper, middle, lower] = [limb.upper, limb.middle, limb.lower].map(|at| at.joint.0);
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

/// Left before right.
fn ordered([a, b]: [&Limb; 2], is_left_first: bool) -> [&Limb; 2] {
    if is_left_first { [a, b] } else { [b, a] }
}

/// A rig with what is asked of it often.
struct Rig<'a> {
    clip: &'a Clip,
    /// The body alone.
    skeleton: &'a Skeleton,
    mannequin: &'a Mannequin,
    /// Where the joints are when nothing is turned.
    rest: Vec<DVec3>,
    up: DVec3,
    height: f64,
}

impl<'a> Rig<'a> {
    fn of(clip: &'a Clip, build: &'a Build) -> Option<Self> {
        let mannequin = build.mannequin.as_ref()?;
        let skeleton = build.members.skeleton();
        let mut rest: Vec<DVec3> = Vec::with_capacity(skeleton.len());
        for joint in &skeleton.joints {
            rest.push(joint.offset + joint.parent.map_or(DVec3::ZERO, |parent| rest[parent.0]));
        }
        let (up, height) = (build.stature.up.unit(), mannequin.height());
        Some(Self { clip, skeleton, mannequin, rest, up, height })
    }

    /// The joint that turns the head. Where the head is short the landmark is the neck: then the last that turns in the
    /// one line that goes on from there.
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

    /// The end of a foot: what of it is furthest from the ankle, and no claw.
    fn toes(&self, leg: &Limb) -> Point {
        let ankle = self.rest[leg.lower.joint.0];
        let way = |point: &Point| self.at_rest(*point) - ankle;
        let ends = tips(self.skeleton, leg.lower.joint.0).into_iter().chain(leg.tips.clone());
        let furthest = ends.max_by(|a, b| way(a).length().total_cmp(&way(b).length()));
        let long = furthest.map_or(0.0, |end| way(&end).length());
        match furthest.filter(|_| long > 0.03 * self.height) {
            Some(end) if long <= LONGEST_FOOT * self.height => end,
            Some(end) => {
                let offset = LONGEST_FOOT * self.height * way(&end).normalize();
                Point { offset, ..leg.lower }
            }
            None => {
                let shin = self.rest[leg.lower.joint.0] - self.rest[leg.middle.joint.0];
                let across = self.across_at_rest();
                let forward = across.cross(shin).normalize_or_zero();
                Point { offset: FOOT * self.height * forward, ..leg.lower }
            }
        }
    }

    /// The end of a hand: the way its fingers go, of a usual length.
    fn fingertips(&self, arm: &Limb) -> Point {
        let wrist = arm.lower.joint.0;
        let joints = self.skeleton.joints.iter();
        let children = joints.filter(|joint| joint.parent.is_some_and(|parent| parent.0 == wrist));
        let ends = self.skeleton.joints[wrist].end_sites.iter().map(|end| end.offset);
        let ways = children.map(|joint| joint.offset).chain(ends);
        let way: DVec3 = ways.filter(|way| way.length() > 0.01 * self.height).sum();
        let forearm = self.rest[wrist] - self.rest[arm.middle.joint.0];
        let way = way.try_normalize().unwrap_or_else(|| forearm.normalize_or_zero());
        Point { offset: HAND * self.height * way, ..arm.lower }
    }

    /// The middle of the head, its nose and its crown.
    fn head(&self, face: DVec3, crown: DVec3) -> [Point; 3] {
        let joint = self.mannequin.head.joint.0;
        let shoulders = self.mannequin.arms.each_ref().map(|arm| self.rest[arm.upper.joint.0]);
        let neck = self.rest[joint].distance(shoulders[0].midpoint(shoulders[1]));
        let [nearest, furthest] = HEAD.map(|share| share * self.height);
        let far = (NECK * self.height - neck).clamp(nearest, furthest);
        let middle = far * crown + 0.15 * far * face;
        let [nose, top] = [NOSE * face, CROWN * crown].map(|way| middle + self.height * way);
        [middle, nose, top].map(|offset| Point { offset, ..Point::of(joint) })
    }

    /// Where the face looks and where the crown is, in the axes of the head's joint.
    ///
    /// In the mean over a clip a head looks where the chest does. A rig at rest says it exactly, if it rests as a
    /// body stands.
    fn looks(&self, forward: f64, legs: [&Limb; 2], arms: [&Limb; 2]) -> [DVec3; 2] {
        let front = |place: &dyn Fn(Point) -> DVec3| {
            let middle = |limbs: &[&Limb; 2]| place(limbs[0].upper).midpoint(place(limbs[1].upper));
            let across = place(arms[1].upper) - place(arms[0].upper);
            let spine = (middle(&arms) - middle(&legs)).normalize_or_zero();
            let neck = (place(self.mannequin.head) - middle(&arms)).normalize_or(spine);
            // The joint of a head between raised shoulders says nothing of where its top is.
            let neck = if neck.dot(spine) > UPWARD { neck } else { spine };
            [(forward * spine.cross(across)).normalize_or_zero(), spine, neck]
        };
        let (mut poser, mut body) = (Poser::of(self.clip), Body::new(self.clip.skeleton()));
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

    /// From the right hip to the left one as the rig rests; by its order where names say nothing.
    fn across_at_rest(&self) -> DVec3 {
        let [a, b] = self.mannequin.legs.each_ref().map(|leg| self.rest[leg.upper.joint.0]);
        if self.named(&self.mannequin.legs).unwrap_or(true) { a - b } else { b - a }
    }

    /// Whether the first of two limbs is the left one, as far as names tell.
    fn named(&self, limbs: &[Limb; 2]) -> Option<bool> {
        let side = |limb: &Limb| {
            let joints = [limb.upper, limb.middle, limb.lower].map(|point| point.joint.0);
            let sides = joints.map(|joint| BodySide::of(&self.skeleton.joints[joint].name));
            sides.into_iter().find(|side| *side != BodySide::Trunk)
        };
        match [side(&limbs[0]), side(&limbs[1])] {
            [Some(BodySide::Left), _] | [_, Some(BodySide::Right)] => Some(true),
            [Some(BodySide::Right), _] | [_, Some(BodySide::Left)] => Some(false),
            _ => None,
        }
    }

    /// Whether the first of two limbs is the left one, and whether up × right is forward: toes point forward.
    fn sides(&self, limbs: &[Limb; 2], toes: &[Point; 2]) -> (bool, f64) {
        let mut body = Body::new(self.clip.skeleton());
        body.place(Poser::of(self.clip).frame(self.clip.first()));
        let at = |point: Point| point.position(&body);
        let ankles = self.mannequin.legs.each_ref().map(|leg| at(leg.lower));
        let ahead = (at(toes[0]) - ankles[0]) + (at(toes[1]) - ankles[1]);
        let ahead = ahead - self.up * ahead.dot(self.up);
        let across = at(limbs[1].upper) - at(limbs[0].upper);
        // The body's own up: it may lie.
        let spine = at(self.mannequin.head) - ankles[0].midpoint(ankles[1]);
        let first_is_left = self.named(limbs);
        let turn = spine.cross(across).dot(ahead);
        let is_left = first_is_left.unwrap_or(turn >= 0.0);
        let turn = if is_left { turn } else { -turn };
        (is_left, if turn >= 0.0 { 1.0 } else { -1.0 })
    }

    /// The joint at which the spine bends.
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

    /// The joint below which the whole body hangs: a game's root on the floor is above it.
    fn root(&self) -> usize {
        let skeleton = self.skeleton;
        let ends = self.ends();
        let is_above_all = |joint: &usize| {
            ends.iter().all(|end| above(skeleton, *end).any(|above| above == *joint))
        };
        above(skeleton, ends[0]).find(is_above_all).unwrap_or(0)
    }

    /// Head, wrists and ankles.
    fn ends(&self) -> [usize; 5] {
        let Mannequin { head, arms, legs, .. } = self.mannequin;
        [*head, arms[0].lower, arms[1].lower, legs[0].lower, legs[1].lower].map(|end| end.joint.0)
    }

    /// The joints whose bones lie in the body: those on the ways to its ends, and what hangs near them.
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
