//! The bones of VRM's humanoid (VRM 1.0), by those of a model of MMD.

use crate::deliver::vmd::bones::Side;

/// The bone of MMD that is VRM's hips, and the one that is its spine.
pub(super) const HIPS: &str = "下半身";
pub(super) const SPINE: &str = "上半身";

/// Those in the middle of the body: MMD's name and VRM's.
const MIDDLE: [(&str, &str); 5] =
    [(HIPS, "hips"), (SPINE, "spine"), ("上半身2", "chest"), ("首", "neck"), ("頭", "head")];

/// Those of the sides: MMD's without 左 and 右, VRM's left and right one.
const SIDED: [(&str, [&str; 2]); 22] = [
    ("肩", ["leftShoulder", "rightShoulder"]),
    ("腕", ["leftUpperArm", "rightUpperArm"]),
    ("ひじ", ["leftLowerArm", "rightLowerArm"]),
    ("手首", ["leftHand", "rightHand"]),
    ("足", ["leftUpperLeg", "rightUpperLeg"]),
    ("ひざ", ["leftLowerLeg", "rightLowerLeg"]),
    ("足首", ["leftFoot", "rightFoot"]),
    ("親指０", ["leftThumbMetacarpal", "rightThumbMetacarpal"]),
    ("親指１", ["leftThumbProximal", "rightThumbProximal"]),
    ("親指２", ["leftThumbDistal", "rightThumbDistal"]),
    ("人指１", ["leftIndexProximal", "rightIndexProximal"]),
    ("人指２", ["leftIndexIntermediate", "rightIndexIntermediate"]),
    ("人指３", ["leftIndexDistal", "rightIndexDistal"]),
    ("中指１", ["leftMiddleProximal", "rightMiddleProximal"]),
    ("中指２", ["leftMiddleIntermediate", "rightMiddleIntermediate"]),
    ("中指３", ["leftMiddleDistal", "rightMiddleDistal"]),
    ("薬指１", ["leftRingProximal", "rightRingProximal"]),
    ("薬指２", ["leftRingIntermediate", "rightRingIntermediate"]),
    ("薬指３", ["leftRingDistal", "rightRingDistal"]),
    ("小指１", ["leftLittleProximal", "rightLittleProximal"]),
    ("小指２", ["leftLittleIntermediate", "rightLittleIntermediate"]),
    ("小指３", ["leftLittleDistal", "rightLittleDistal"]),
];

/// How many of them, in their order, no humanoid is without.
const NEEDED: [&str; 6] = ["腕", "ひじ", "手首", "足", "ひざ", "足首"];

/// VRM's name of a bone.
pub(super) fn vrm_name(bone: &str) -> Option<&'static str> {
    let middle = MIDDLE.iter().find(|(own, _)| *own == bone).map(|(_, name)| *name);
    let sided = || {
        let of = |side: Side| bone.strip_prefix(side.word()).map(|stem| (side, stem));
        let (side, stem) = Side::BOTH.into_iter().find_map(of)?;
        let (_, names) = SIDED.iter().find(|(own, _)| *own == stem)?;
        Some(names[usize::from(side == Side::Right)])
    };
    middle.or_else(sided)
}

/// The bones without which VRM has no humanoid.
pub(super) fn needed() -> impl Iterator<Item = String> {
    let middle = [HIPS, SPINE, "頭"].into_iter().map(str::to_owned);
    middle.chain(Side::BOTH.into_iter().flat_map(|side| NEEDED.map(|bone| side.named(bone))))
}
