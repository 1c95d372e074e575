//! Which joints drive which bone by the shape of the body (体の構造): a thigh is a thigh whatever its name.
//!
//! The shape says where limbs, head and pelvis are. It does not say where a chest begins or which finger is which:
//! there the names of a dialect decide, and what nobody named is shared out along the spine.

use std::collections::HashSet;

use super::bones::{Model, Side};
use crate::motion::{Clip, JointId, LayFigure, Skeleton};

/// What one bone is made of, from the body outward.
type Row = (String, Vec<JointId>);

/// The bones of the four limbs, from the trunk outward, with what a person calls the limb.
pub(super) const LIMBS: [(&str, [&str; 3]); 2] =
    [("arm", ["腕", "ひじ", "手首"]), ("leg", ["足", "ひざ", "足首"])];

/// Gives bones that no name drives the joints that the shape of the body has there. A joint drives one bone only, but for
/// the root, which the centre shares with the pelvis.
///
/// Of a limb that names know from the trunk to its middle nothing is taken: what else hangs there is a matter of
/// the rig. Gives the bones that have joints now.
pub(super) fn fill(model: &Model, joints: &mut [Vec<JointId>], clip: &Clip) -> Vec<String> {
    let open: Vec<String> = wanted(model, joints);
    if open.is_empty() {
        return Vec::new();
    }
    let Some(figure) = LayFigure::of(clip) else { return Vec::new() };
    let mut taken: HashSet<usize> = joints.iter().flatten().map(|joint| joint.0).collect();
    taken.remove(&figure.root);
    let mut filled = Vec::new();
    for (bone, own) in rows(clip.skeleton(), &figure) {
        let Some(at) = model.find(&bone).filter(|_| open.contains(&bone)) else { continue };
        let free: Vec<JointId> = own.into_iter().filter(|own| !taken.contains(&own.0)).collect();
        taken.extend(free.iter().map(|joint| joint.0).filter(|joint| *joint != figure.root));
        filled.extend((!free.is_empty()).then_some(bone));
        joints[at] = free;
    }
    filled
}

/// The limbs of which no bone is driven, in words: left arm.
pub(super) fn still_limbs(drives: impl Fn(&str) -> bool) -> Vec<String> {
    let limbs = LIMBS
        .iter()
        .flat_map(|(limb, bones)| Side::BOTH.map(|side| (side, *limb, bones)).into_iter());
    let is_still = |side: Side, bones: &[&str; 3]| {
        // A limb of one bone that turns is a limb that moves.
        bones.iter().all(|bone| !drives(&side.named(bone)))
    };
    let still = limbs.filter(|(side, _, bones)| is_still(*side, bones));
    still.map(|(side, limb, _)| format!("{} {limb}", side.english())).collect()
}

/// Bones that are to be filled: those without a joint, but for a limb whose upper and middle bone have theirs.
fn wanted(model: &Model, joints: &[Vec<JointId>]) -> Vec<String> {
    let is_driven = |bone: &str| model.find(bone).is_some_and(|bone| !joints[bone].is_empty());
    let mut wanted = Vec::new();
    let known = |side: Side, [upper, middle, _]: [&str; 3]| {
        is_driven(&side.named(upper)) && is_driven(&side.named(middle))
    };
    for side in Side::BOTH {
        for (limb, bones) in LIMBS.iter().filter(|(_, bones)| !known(side, *bones)) {
            wanted.extend(bones.map(|bone| side.named(bone)));
            wanted.extend((*limb == "arm").then(|| side.named("肩")));
        }
    }
    let spine = ["上半身", "上半身2"];
    if !spine.iter().any(|bone| is_driven(bone)) {
        wanted.extend(spine.map(str::to_owned));
    }
    wanted.extend(["センター", "下半身", "首", "頭"].map(str::to_owned));
    wanted.retain(|bone| !is_driven(bone));
    wanted
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
    let (root, chest, head) = (figure.root, figure.chest, figure.head_joint(skeleton));
    let mut spine = between(root, chest);
    spine.extend((chest != root).then_some(JointId(chest)));
    let bend = figure.waist.and_then(|waist| spine.iter().position(|joint| joint.0 == waist));
    let upper = spine.split_off(spine.len().min(bend.map_or(1, |bend| bend + 1)));
    let mut rows = vec![
        of("センター", vec![JointId(root)]),
        of("下半身", vec![JointId(root)]),
        of("上半身", spine),
        of("上半身2", upper),
        of("首", between(chest, head)),
        of("頭", vec![JointId(head)]),
    ];
    for (at, side) in Side::BOTH.into_iter().enumerate() {
        rows.push((side.named("肩"), between(chest, figure.arms[at][0])));
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

#[cfg(test)]
mod tests;
