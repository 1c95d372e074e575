//! Provides a figure of usual proportions (標準的な体型), the skeleton of a motion without a model.

use glam::DVec3;

/// A bone at rest.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RestBone {
    pub(super) name: String,
    pub(super) parent: Option<usize>,
    /// Its start in MMD units; +X is left, +Y up, +Z in front.
    pub(super) place: DVec3,
    /// The vector from its start to its end, if a model defines it.
    pub(super) tip: Option<DVec3>,
}

/// Name, parent and position of a bone, in MMD units: +X is left, +Y up, +Z in front.
type Middle = (&'static str, &'static str, [f64; 3]);

/// Middle bones of a person 158 cm tall, whose legs are 9.7 units long.
const MIDDLE: [Middle; 9] = [
    ("全ての親", "", [0.0, 0.0, 0.0]),
    ("センター", "全ての親", [0.0, 8.0, 0.0]),
    ("グルーブ", "センター", [0.0, 8.2, 0.0]),
    ("腰", "グルーブ", [0.0, 12.0, 0.0]),
    ("下半身", "腰", [0.0, 12.3, 0.0]),
    ("上半身", "腰", [0.0, 12.3, 0.0]),
    ("上半身2", "上半身", [0.0, 13.6, 0.0]),
    ("首", "上半身2", [0.0, 16.4, 0.0]),
    ("頭", "首", [0.0, 17.2, 0.0]),
];

/// Bones of the left side, named without 左. A parent is on that side too, unless it begins with `=`. Arms
/// hang by 35°.
const SIDED: [Middle; 15] = [
    ("肩P", "=上半身2", [0.3, 16.0, 0.0]),
    ("肩", "肩P", [0.3, 16.0, 0.0]),
    ("肩C", "肩", [1.2, 15.8, 0.0]),
    ("腕", "肩C", [1.2, 15.8, 0.0]),
    ("腕捩", "腕", [2.3, 15.03, 0.0]),
    ("ひじ", "腕捩", [3.33, 14.31, 0.0]),
    ("手捩", "ひじ", [4.35, 13.59, 0.0]),
    ("手首", "手捩", WRIST),
    ("足", "=下半身", [0.8, 11.2, 0.0]),
    ("ひざ", "足", [0.8, 6.3, 0.0]),
    ("足首", "ひざ", [0.8, 1.5, 0.0]),
    ("つま先", "足首", [0.8, 0.2, 1.4]),
    ("足IK親", "=全ての親", [0.8, 0.0, 0.0]),
    ("足ＩＫ", "足IK親", [0.8, 1.5, 0.0]),
    ("つま先ＩＫ", "足ＩＫ", [0.8, 0.2, 1.4]),
];

const WRIST: [f64; 3] = [5.38, 12.88, 0.0];

/// Fingers that a motion may have: the name, and the position along and across the hand.
const FINGERS: [(&str, [f64; 2]); 5] = [
    ("親指", [0.15, 0.3]),
    ("人指", [0.8, 0.25]),
    ("中指", [0.85, 0.0]),
    ("薬指", [0.8, -0.2]),
    ("小指", [0.7, -0.4]),
];

/// Direction of a hand at rest.
const HAND: DVec3 = DVec3::new(0.82, -0.57, 0.0);

/// Distance between two joints of a finger.
const KNUCKLE: f64 = 0.3;

/// Bones that every body has, named without the side.
const CORE: [&str; 12] =
    ["センター", "下半身", "上半身", "首", "頭", "肩", "腕", "ひじ", "手首", "足", "ひざ", "足首"];

/// Whether every body has this bone, with or without keys.
pub(super) fn is_core(name: &str) -> bool {
    CORE.contains(&plain(name))
}

/// Whether a bone moves the body; fingers, face and hair do not.
pub(super) fn is_of_body(name: &str) -> bool {
    let own = plain(name);
    MIDDLE.iter().chain(&SIDED).any(|(bone, ..)| *bone == own)
}

/// Whether a bone is an IK target of a foot, or carries one.
pub(super) fn is_target(name: &str) -> bool {
    name.contains("ＩＫ") || name.contains("IK")
}

/// Removes the side from a name.
fn plain(name: &str) -> &str {
    name.strip_prefix(['左', '右']).unwrap_or(name)
}

/// Builds the bones of the figure, parents first.
pub(super) fn bones() -> Vec<RestBone> {
    let mut bones: Vec<RestBone> = Vec::new();
    for (name, parent, place) in MIDDLE {
        hang(&mut bones, name.into(), parent, DVec3::from_array(place));
    }
    for (side, sign) in [("左", 1.0), ("右", -1.0)] {
        let across = DVec3::new(sign, 1.0, 1.0);
        for (name, parent, place) in SIDED {
            let sided = format!("{side}{parent}");
            let parent = parent.strip_prefix('=').unwrap_or(&sided);
            hang(&mut bones, format!("{side}{name}"), parent, across * DVec3::from_array(place));
        }
        fingers(&mut bones, side, across);
    }
    bones
}

fn fingers(bones: &mut Vec<RestBone>, side: &str, across: DVec3) {
    let wrist = DVec3::from_array(WRIST);
    for (finger, [along, front]) in FINGERS {
        let base = wrist + along * HAND + front * DVec3::Z;
        let numbers =
            if finger == "親指" { ["０", "１", "２"] } else { ["１", "２", "３"] };
        let mut parent = format!("{side}手首");
        for (at, number) in numbers.into_iter().enumerate() {
            let name = format!("{side}{finger}{number}");
            let place = base + KNUCKLE * at as f64 * HAND;
            hang(bones, name.clone(), &parent, across * place);
            parent = name;
        }
    }
}

fn hang(bones: &mut Vec<RestBone>, name: String, parent: &str, place: DVec3) {
    let parent = bones.iter().position(|bone| bone.name == parent);
    bones.push(RestBone { name, parent, place, tip: None });
}
