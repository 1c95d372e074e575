//! Finds limbs by name (名前による手足), if the named joints make whole limbs.

mod name_words;

use std::sync::LazyLock;

use glam::DVec3;

use super::names::BoneMap;
use super::side::BodySide;
use super::structure::LIMBS;
use super::structure::fit::way;
use crate::motion::body::names::bones::Side;
use crate::motion::landmarks::above;
use crate::motion::{Clip, Declared, JointId, Point, Skeleton};

use name_words::ByWords;

/// The built-in table of names.
static NAMES: LazyLock<BoneMap> = LazyLock::new(BoneMap::default);

/// Least ratio of a limb's two bones. A forearm may be half as long as an upper arm, while names that are off by one
/// joint make a foot the second bone of a leg.
const EVEN: f64 = 1.0 / 3.0;

/// Largest ratio of the two limbs of a pair. An arm that is named as a leg is only half as long as a leg.
const ALIKE: f64 = 1.4;

/// Length of thigh and shin together, in heights of the body.
pub(super) const LEG: f64 = 0.48;

/// An arm or a leg: shoulder, elbow and wrist, or hip, knee and ankle. A limb whose last bone ends in an End Site
/// lists the joint of this bone twice.
pub(crate) type Limb = [usize; 3];

/// Limbs and head of a body known by name.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct NamedLimbs {
    /// Left and right arm.
    pub(crate) arms: [Option<Limb>; 2],
    /// Left and right leg.
    pub(crate) legs: [Option<Limb>; 2],
    pub(crate) head: Option<usize>,
}

impl NamedLimbs {
    /// Takes the limbs that a person declared. The others come from the dialect that names most joints of a tree, if
    /// they are whole: their joints hang on one another, and their two bones, as well as both sides, are of similar
    /// length.
    pub(crate) fn new(skeleton: &Skeleton, is_of_tree: &[bool], said: Declared) -> Self {
        let named = Self::by_names(skeleton, is_of_tree);
        let limb = |at: usize| said.limbs[at].map(|limb| limb.map(|joint| joint.0));
        Self {
            arms: [limb(0).or(named.arms[0]), limb(1).or(named.arms[1])],
            legs: [limb(2).or(named.legs[0]), limb(3).or(named.legs[1])],
            head: said.head.map(|head| head.0).or(named.head),
        }
    }

    fn by_names(skeleton: &Skeleton, is_of_tree: &[bool]) -> Self {
        let found = NAMES.find_among(skeleton, |joint| is_of_tree[joint]);
        let named = |bone: &str| found.joints[NAMES.model.find(bone)?].first().copied();
        let limbs = |bones: [&str; 3]| {
            let limb = |side: Side| whole(skeleton, bones.map(|bone| named(&side.named(bone))));
            alike(Side::BOTH.map(limb))
        };
        let found = Self {
            arms: limbs(LIMBS[0].1),
            legs: limbs(LIMBS[1].1),
            head: named("頭").map(|head| head.0),
        };
        if found.are_whole() { found } else { found.or_by_words(skeleton, is_of_tree) }
    }

    /// Adds limbs found by the words in names, for names in no dialect. Both sides of a pair are taken together.
    fn or_by_words(self, skeleton: &Skeleton, is_of_tree: &[bool]) -> Self {
        let words = ByWords::new(skeleton, is_of_tree);
        let both = |own: [Option<Limb>; 2], limb: &dyn Fn(BodySide) -> [Option<JointId>; 3]| {
            let sides = [BodySide::Left, BodySide::Right];
            let by_words = || alike(sides.map(|side| whole(skeleton, limb(side))));
            if own == [None; 2] { by_words() } else { own }
        };
        Self {
            arms: both(self.arms, &|side| words.arm(side)),
            legs: both(self.legs, &|side| words.leg(side)),
            head: self.head.or_else(|| words.head()),
        }
    }

    /// Whether a joint hangs on a named limb or head, or leads to the head.
    pub(super) fn take(&self, skeleton: &Skeleton, joint: usize) -> bool {
        let tops =
            || self.arms.iter().chain(&self.legs).flatten().map(|limb| limb[0]).chain(self.head);
        let hangs = above(skeleton, joint).any(|above| tops().any(|top| top == above));
        hangs || self.head.is_some_and(|head| above(skeleton, head).any(|above| above == joint))
    }

    /// Returns shoulder, elbow and wrist, or hip, knee and ankle, of the named limb that ends at a joint.
    pub(super) fn ending_at(&self, end: usize) -> Option<Limb> {
        let mut limbs = self.arms.iter().chain(&self.legs).flatten().copied();
        limbs.find(|limb| limb[2] == end)
    }

    /// Returns the point at the end of the limb that ends at a joint: the joint itself, or its End Site.
    pub(super) fn end(&self, skeleton: &Skeleton, joint: usize) -> Point {
        let is_short = self.ending_at(joint).is_some_and(|[_, middle, lower]| middle == lower);
        let tip = is_short.then(|| tip(skeleton, JointId(joint))).flatten();
        Point { offset: tip.unwrap_or_default(), ..Point::new(joint) }
    }

    /// Returns the length of the longest End Site in which a limb ends.
    pub(super) fn longest_tip(&self, skeleton: &Skeleton) -> f64 {
        let ends = self.arms.iter().chain(&self.legs).flatten().map(|[_, _, lower]| lower);
        let tips = ends.map(|end| self.end(skeleton, *end).offset.length());
        tips.fold(0.0, f64::max)
    }

    /// Returns the height of a person with these legs, if head and all limbs are known.
    pub(super) fn height(&self, skeleton: &Skeleton) -> Option<f64> {
        let [Some(left), Some(right)] = self.legs else { return None };
        let length = |[hip, _, ankle]: Limb| {
            let end = self.end(skeleton, ankle);
            Some(way(skeleton, JointId(hip), end.joint)? + end.offset.length())
        };
        let mean = f64::midpoint(length(left)?, length(right)?);
        self.are_whole().then_some(mean / LEG)
    }

    /// Returns both legs and the head, if they are known.
    pub(super) fn legs_and_head(&self) -> Option<([Limb; 2], usize)> {
        let [left, right] = self.legs;
        Some(([left?, right?], self.head?))
    }

    /// Whether head and all limbs are known.
    pub(super) fn are_whole(&self) -> bool {
        self.head.is_some() && self.arms.iter().chain(&self.legs).all(Option::is_some)
    }

    /// Returns the joints of the limbs and the head.
    pub(crate) fn joints(&self) -> impl Iterator<Item = usize> {
        let limbs = self.arms.into_iter().chain(self.legs).flatten().flatten();
        limbs.chain(self.head)
    }
}

/// Reads head and limbs from a person's bone table. A limb counts if the person has a row for it and its joints hang
/// on one another.
pub(crate) fn said(map: &BoneMap, clip: &Clip) -> Declared {
    let (skeleton, found) = (clip.skeleton(), map.find(clip));
    let named = |bone: &str| found.joints[map.model.find(bone)?].first().copied();
    let limb = |(bones, side): ([&str; 3], Side)| {
        let bones = bones.map(|bone| side.named(bone));
        let limb @ [upper, middle, lower] = bones.each_ref().map(|bone| named(bone));
        let is_said = map.says(&found, &bones.each_ref().map(String::as_str));
        let hangs = way(skeleton, upper?, middle?).and(way(skeleton, middle?, lower?));
        hangs.filter(|_| is_said).and(Some([limb[0]?, limb[1]?, limb[2]?]))
    };
    let limbs = [LIMBS[0].1, LIMBS[1].1].map(|bones| Side::BOTH.map(|side| limb((bones, side))));
    let head = named("頭").filter(|_| map.says(&found, &["頭"]));
    Declared {
        limbs: [limbs[0][0], limbs[0][1], limbs[1][0], limbs[1][1]],
        head,
        ..Declared::default()
    }
}

/// Returns a limb and its length if its joints can be one. Without a hand or foot it ends in the tip of its last bone.
fn whole(skeleton: &Skeleton, limb: [Option<JointId>; 3]) -> Option<(Limb, f64)> {
    let [upper, middle, lower] = limb;
    let (upper, middle) = (upper?, middle?);
    let first = way(skeleton, upper, middle)?;
    let second = match lower {
        Some(lower) => way(skeleton, middle, lower)?,
        None => tip(skeleton, middle)?.length(),
    };
    let lower = lower.unwrap_or(middle);
    let is_even = first.min(second) >= EVEN * first.max(second) && first > 0.0;
    is_even.then_some(([upper.0, middle.0, lower.0], first + second))
}

/// Returns the offset of the End Site of a joint that carries no other joint.
fn tip(skeleton: &Skeleton, joint: JointId) -> Option<DVec3> {
    let carries = skeleton.joints.iter().any(|other| other.parent == Some(joint));
    skeleton.joints[joint.0].end_sites.first().filter(|_| !carries).map(|end| end.offset)
}

/// Returns both sides if their lengths are similar, or neither.
fn alike(limbs: [Option<(Limb, f64)>; 2]) -> [Option<Limb>; 2] {
    if let [Some((_, left)), Some((_, right))] = limbs
        && left.max(right) > ALIKE * left.min(right)
    {
        return [None; 2];
    }
    limbs.map(|limb| limb.map(|(limb, _)| limb))
}
