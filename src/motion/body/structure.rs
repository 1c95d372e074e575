//! Assigns joints to bones by the shape of the body (体の構造): a thigh is a thigh whatever its name.
//!
//! The shape gives limbs, head and pelvis. Names that fit it are kept. A limb whose names do not fit, or are
//! incomplete, comes from the shape. The shape cannot tell the beginning of a chest or the fingers apart: names
//! decide these, and unnamed joints are distributed along the spine.

pub(super) mod fit;

use std::collections::HashSet;

use super::names::bones::{Model, Side};
use crate::motion::{Clip, JointId, MannequinParts, Skeleton};
use fit::{carries, fits};

/// A bone and the joints that form it, from the body outward.
type Row = (String, Vec<JointId>);

/// Names of the limbs, and their bones from the trunk outward.
pub const LIMBS: [(&str, [&str; 3]); 2] =
    [("arm", ["腕", "ひじ", "手首"]), ("leg", ["足", "ひざ", "足首"])];

/// The collar bone of an arm.
const COLLAR: &str = "肩";

/// The two bones of the spine.
const SPINE: [&str; 2] = ["上半身", "上半身2"];

/// Reconciles the joints named for bones with the shape of the body. A person's rows are always kept. A joint drives
/// one bone only, except that the root drives both the centre and the pelvis.
///
/// Returns the bones whose joints come from the shape.
pub(crate) fn settle(
    model: &Model,
    joints: &mut [Vec<JointId>],
    clip: &Clip,
    is_given: impl Fn(&str) -> bool,
) -> Vec<String> {
    let Some(figure) = MannequinParts::new(clip) else { return Vec::new() };
    let skeleton = clip.skeleton();
    let mut rows = rows(skeleton, &figure);
    let named = joints.to_vec();
    let open = open(model, &named, skeleton, &rows, &is_given);
    rows.retain(|(bone, _)| open.contains(bone));
    let at = |bone: &str| model.find(bone);
    open.iter().filter_map(|bone| at(bone)).for_each(|bone| joints[bone].clear());
    take_limbs(joints, &rows, at, |bone| !is_given(&model.bones[bone].name));
    let root = JointId(figure.root);
    let mut taken: HashSet<JointId> = joints.iter().flatten().copied().collect();
    let mut by_shape = Vec::new();
    for (bone, own) in rows {
        let Some(at) = at(&bone) else { continue };
        if !is_of_limb(&bone) {
            let is_free = |joint: &JointId| *joint == root || !taken.contains(joint);
            joints[at] = own.into_iter().filter(is_free).collect();
            taken.extend(&joints[at]);
        }
        let is_news = !joints[at].is_empty() && joints[at].first() != named[at].first();
        by_shape.extend(is_news.then_some(bone));
    }
    by_shape
}

/// Assigns the joints of limbs first, and removes them from other rows that may change.
fn take_limbs(
    joints: &mut [Vec<JointId>],
    rows: &[Row],
    at: impl Fn(&str) -> Option<usize>,
    may_change: impl Fn(usize) -> bool,
) {
    let limbs = || rows.iter().filter(|(bone, _)| is_of_limb(bone));
    let own: HashSet<JointId> = limbs().flat_map(|(_, own)| own).copied().collect();
    let others = joints.iter_mut().enumerate().filter(|(bone, _)| may_change(*bone));
    others.for_each(|(_, joints)| joints.retain(|joint| !own.contains(joint)));
    for (bone, own) in limbs() {
        at(bone).into_iter().for_each(|bone| joints[bone].clone_from(own));
    }
}

pub(super) fn is_of_limb(bone: &str) -> bool {
    let stem = bone.trim_start_matches(['左', '右']);
    LIMBS.iter().any(|(_, bones)| bones.contains(&stem))
}

/// The second bones of the limbs, in words.
const LOWER: [&str; 2] = ["forearm", "shin"];

/// Returns the limbs whose first bone is not driven, and the second bones of the others that are not, in words: left
/// arm, right shin.
pub fn still_limbs(drives: impl Fn(&str) -> bool) -> Vec<String> {
    let limbs = LIMBS.iter().zip(LOWER);
    let limbs = limbs.flat_map(|(limb, lower)| Side::BOTH.map(|side| (side, limb, lower)));
    // If only its end turns, a limb does not move. A hand or a foot alone is no such loss.
    let still = limbs.filter_map(|(side, (limb, [first, second, _]), lower)| {
        let part = [(first, *limb), (second, lower)];
        let (_, part) = part.into_iter().find(|(bone, _)| !drives(&side.named(bone)))?;
        Some(format!("{} {part}", side.english()))
    });
    still.collect()
}

/// Returns the bones whose joints the shape decides: unnamed bones, and all bones of a limb that is named
/// incompletely or against the shape.
fn open(
    model: &Model,
    named: &[Vec<JointId>],
    skeleton: &Skeleton,
    rows: &[Row],
    is_given: impl Fn(&str) -> bool,
) -> Vec<String> {
    let by_name = |bone: &str| named[model.find(bone)?].first().copied();
    let by_shape = |bone: &str| rows.iter().find(|(own, _)| own == bone)?.1.first().copied();
    let mut open = Vec::new();
    for side in Side::BOTH {
        for (limb, bones) in LIMBS {
            let bones = bones.map(|bone| side.named(bone));
            let names = bones.each_ref().map(|bone| by_name(bone));
            let shape = bones.each_ref().map(|bone| by_shape(bone));
            if bones.iter().any(|bone| is_given(bone)) || fits(skeleton, names, shape) {
                continue;
            }
            let collar = side.named(COLLAR);
            let is_above =
                |joint: JointId| shape[0].is_some_and(|arm| carries(skeleton, joint, arm));
            let is_known = is_given(&collar) || by_name(&collar).is_some_and(is_above);
            open.extend((limb == "arm" && !is_known).then_some(collar));
            open.extend(bones);
        }
    }
    // Only names tell where a chest begins. A chest without a spine below it is the whole spine, and is distributed.
    let has_spine = by_name(SPINE[0]).is_some() || SPINE.iter().any(|bone| is_given(bone));
    open.extend(SPINE.iter().filter(|_| !has_spine).map(|bone| (*bone).to_owned()));
    let unnamed = |bone: &String| by_name(bone).is_none() && !is_given(bone);
    open.extend(["センター", "下半身", "首", "頭"].map(str::to_owned).into_iter().filter(unnamed));
    open
}

/// Returns the joints of each bone as found by shape.
fn rows(skeleton: &Skeleton, figure: &MannequinParts) -> Vec<Row> {
    let between = |from: usize, to: usize| -> Vec<JointId> {
        let parent = |joint: &usize| skeleton.joints[*joint].parent.map(|parent| parent.0);
        let up = std::iter::successors(parent(&to), parent).take_while(|joint| *joint != from);
        let mut way: Vec<JointId> =
            up.filter(|joint| skeleton.joints[*joint].turns()).map(JointId).collect();
        way.reverse();
        way
    };
    let of = |name: &str, joints: Vec<JointId>| (name.to_owned(), joints);
    let (root, chest, head) = (figure.root, figure.chest, figure.head_joint);
    let mut spine = between(root, chest);
    spine.extend((chest != root).then_some(JointId(chest)));
    let bend = figure.waist.and_then(|waist| spine.iter().position(|joint| joint.0 == waist));
    let upper = spine.split_off(spine.len().min(bend.map_or(1, |bend| bend + 1)));
    let mut rows = vec![
        of("センター", vec![JointId(root)]),
        of("下半身", vec![JointId(root)]),
        of(SPINE[0], spine),
        of(SPINE[1], upper),
        of("首", between(chest, head)),
        of("頭", vec![JointId(head)]),
    ];
    for (at, side) in Side::BOTH.into_iter().enumerate() {
        rows.push((side.named(COLLAR), between(chest, figure.arms[at][0])));
        for ((_, bones), limb) in LIMBS.iter().zip([figure.arms[at], figure.legs[at]]) {
            // A limb without a hand or foot ends in a tip.
            let is_joint = |point: &usize| *point < skeleton.len();
            let mut joints: Vec<usize> = limb[..3].iter().copied().filter(is_joint).collect();
            let has_end = joints.len() == 3;
            // A limb without a middle joint lists its end twice.
            joints.dedup();
            let bones = match has_end && joints.len() < 3 {
                true => &[bones[0], bones[2]],
                false => &bones[..],
            };
            let named = bones.iter().zip(joints);
            rows.extend(named.map(|(bone, joint)| (side.named(bone), vec![JointId(joint)])));
        }
    }
    rows
}
