//! Which joints drive which bone by the shape of the body (体の構造): a thigh is a thigh whatever its name.
//!
//! The shape says where limbs, head and pelvis are. Names that fit it stand. Where they do not, or say a limb in part, the
//! shape decides the limb. It does not say where a chest begins or which finger is which: there names decide, and what
//! nobody named is shared out along the spine.

pub(super) mod fit;

use std::collections::HashSet;

use super::names::bones::{Model, Side};
use crate::motion::{Clip, JointId, LayFigure, Skeleton};
use fit::{carries, fits};

/// What one bone is made of, from the body outward.
type Row = (String, Vec<JointId>);

/// The bones of the four limbs, from the trunk outward, with what a person calls the limb.
pub(crate) const LIMBS: [(&str, [&str; 3]); 2] =
    [("arm", ["腕", "ひじ", "手首"]), ("leg", ["足", "ひざ", "足首"])];

/// The collar bone of an arm.
const COLLAR: &str = "肩";

/// The two bones of the spine.
const SPINE: [&str; 2] = ["上半身", "上半身2"];

/// Brings the joints that names gave to bones together with the shape of the body. Rows that a person gave stand whatever
/// they say. A joint drives one bone only, but for the root, which the centre shares with the pelvis.
///
/// Gives the bones of which the shape says the joints.
pub(crate) fn settle(
    model: &Model,
    joints: &mut [Vec<JointId>],
    clip: &Clip,
    is_given: impl Fn(&str) -> bool,
) -> Vec<String> {
    let Some(figure) = LayFigure::of(clip) else { return Vec::new() };
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

/// Gives limbs their joints before all else, and takes these from the rows that may change.
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

/// The limbs whose bone at the trunk is not driven, in words: left arm.
pub(crate) fn still_limbs(drives: impl Fn(&str) -> bool) -> Vec<String> {
    let limbs = LIMBS
        .iter()
        .flat_map(|(limb, bones)| Side::BOTH.map(|side| (side, *limb, bones)).into_iter());
    // A limb of one bone that turns is a limb that moves; one of which only the end turns is not.
    let still = limbs.filter(|(side, _, bones)| !drives(&side.named(bones[0])));
    still.map(|(side, limb, _)| format!("{} {limb}", side.english())).collect()
}

/// The bones of which the shape is to say the joints: those that names leave, and of limbs that they say in part or
/// against the shape all.
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
    // Where a chest begins only names say. A chest without a spine below it is the whole spine, and is shared out.
    let has_spine = by_name(SPINE[0]).is_some() || SPINE.iter().any(|bone| is_given(bone));
    open.extend(SPINE.iter().filter(|_| !has_spine).map(|bone| (*bone).to_owned()));
    let unnamed = |bone: &String| by_name(bone).is_none() && !is_given(bone);
    open.extend(["センター", "下半身", "首", "頭"].map(str::to_owned).into_iter().filter(unnamed));
    open
}

/// The joints of each bone as the shape has them.
fn rows(skeleton: &Skeleton, figure: &LayFigure) -> Vec<Row> {
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
            let mut joints = limb[..3].to_vec();
            // A limb without a middle ends there twice.
            joints.dedup();
            let bones = if joints.len() == 3 { &bones[..] } else { &[bones[0], bones[2]] };
            let named = bones.iter().zip(joints);
            rows.extend(named.map(|(bone, joint)| (side.named(bone), vec![JointId(joint)])));
        }
    }
    rows
}
