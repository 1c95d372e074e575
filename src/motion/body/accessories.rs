//! Finds accessories (付属物), joints that hang on a body without belonging to it: hair and cloth, props, rig helpers
//! and joints that never move.
//!
//! Joints on the way to the end of a named limb are the body. For others the name may tell their role, and a bone far
//! longer than the others leads to a helper such as a knee pole. If all limbs are known, three more rules hold: a
//! chain that reaches further than a hand or a foot is no part of the body, a joint that travels is a control, and a
//! joint that never moves is a point on a bone.

use crate::motion::Skeleton;
use crate::motion::body::limbs::NamedLimbs;
use crate::motion::body::role::Role;
use crate::motion::body::side::words;
use crate::motion::landmarks::above;

/// Largest distance along the bones from a limb's line to a joint of the body, in heights of the body: a hand is .11
/// long and a foot .15.
const REACH: f64 = 0.22;

/// Longest bone of a body, as a share of all its bones: a thigh has a tenth.
const LONGEST: f64 = 0.25;

/// Largest number of similar long bones that are helpers. More similar bones are an animal's legs.
const PAIR: usize = 2;

/// Ratio of lengths above which two bones count as similar.
const ALIKE: f64 = 0.67;

/// Fewest joints of a body in which an overlong bone is looked for.
const FEWEST: usize = 8;

/// A joint that carries more than one in this many of its tree's joints is no accessory, whatever its name.
const ONE_OF: usize = 3;

/// A role, words that name it, and substrings that name it in names without word boundaries.
type Names = (Role, &'static [&'static str], &'static [&'static str]);

const NAMES: [Names; 3] = [
    (
        Role::Helper,
        &[
            "ik",
            "pole",
            "ctrl",
            "control",
            "controller",
            "target",
            "effector",
            "helper",
            "mannequin",
            "null",
            "locator",
            "weight",
            "aim",
            "goal",
            "socket",
            "attach",
        ],
        &["ＩＫ", "操作", "の親"],
    ),
    (
        Role::Hair,
        &[
            "hair", "ponytail", "twintail", "tail", "bang", "bangs", "braid", "skirt", "cloth",
            "clothes", "cape", "cloak", "coat", "ribbon", "scarf", "tie", "sleeve", "ear", "ears",
            "breast", "bust", "jiggle", "spring", "physics",
        ],
        &["髪", "スカート", "袖", "胸", "ネクタイ", "リボン", "耳", "尻尾"],
    ),
    (
        Role::Prop,
        &[
            "prop", "weapon", "sword", "gun", "rifle", "bow", "racket", "bat", "ball", "camera",
            "light", "shield",
        ],
        &["剣", "刀", "武器"],
    ),
];

/// Words for parts of hands, feet, heads and backs, which belong to the body.
const PARTS: [&str; 15] = [
    "toe",
    "finger",
    "thumb",
    "index",
    "mid",
    "ring",
    "pinky",
    "little",
    "eye",
    "jaw",
    "wing",
    "指",
    "つま先",
    "目",
    "翼",
];

/// Names of finger joints without numbers.
const KNUCKLES: [&str; 4] = ["metacarpal", "proximal", "intermediate", "distal"];

/// Words for sides, which follow the number in some names.
const SIDES: [&str; 4] = ["l", "r", "left", "right"];

/// The joints of a rig and their known properties.
pub(super) struct Rig<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) limbs: &'a NamedLimbs,
    /// Whether each joint moves relative to its parent.
    pub(super) moves: &'a [bool],
    /// Whether each joint changes position relative to its parent.
    pub(super) travels: &'a [bool],
}

/// Sums over the joints of a rig.
struct Sums {
    /// Whether a joint lies on the way to the end of a limb or to the head.
    is_core: Vec<bool>,
    /// Distance of each joint from that way along the bones.
    far: Vec<f64>,
    /// Longest chain of bones below each joint.
    reach: Vec<f64>,
    /// Whether a joint or its descendants move.
    moves: Vec<bool>,
    /// Whether a joint or its descendants are known by name: a finger, a toe.
    is_part: Vec<bool>,
    /// Number of joints below each joint, itself included, and the sum of their bones.
    joints: Vec<usize>,
    bones: Vec<f64>,
    /// Root of each joint's tree.
    root: Vec<usize>,
}

impl Rig<'_> {
    /// Assigns other roles to joints that are no part of the body.
    pub(super) fn strip(&self, roles: &mut [Role]) {
        let sums = self.sums(roles);
        for (joint, data) in self.skeleton.iter() {
            let Some(parent) = data.parent.filter(|parent| roles[parent.0] != Role::Guide) else {
                continue;
            };
            if roles[joint.0] == Role::Body && !sums.is_core[joint.0] {
                let hangs_on = roles[parent.0];
                roles[joint.0] = match hangs_on {
                    Role::Body => self.role(&sums, joint.0).unwrap_or(Role::Body),
                    other => other,
                };
            }
        }
    }

    /// Finds the role of a joint that hangs on the body; `None` for a part of the body.
    fn role(&self, sums: &Sums, joint: usize) -> Option<Role> {
        let root = sums.root[joint];
        if ONE_OF * sums.joints[joint] > sums.joints[root] {
            return None;
        }
        let bone = self.skeleton.joints[joint].offset.length();
        let others = sums.bones[root] - sums.bones[joint];
        let is_long = sums.joints[root] >= FEWEST
            && bone > LONGEST * others
            && self.count_like(sums, joint) <= PAIR;
        role_of(&self.skeleton.joints[joint].name)
            .or_else(|| is_long.then_some(Role::Helper))
            .or_else(|| {
                let height = self.limbs.height(self.skeleton)?;
                match () {
                    () if sums.is_part[joint] => None,
                    () if sums.far[joint] + sums.reach[joint] > REACH * height => Some(Role::Far),
                    () if self.travels[joint] => Some(Role::Helper),
                    () if !sums.moves[joint] => Some(Role::Still),
                    () => None,
                }
            })
    }

    /// Counts the bones of its tree that are similar to a joint's bone in length, or longer.
    fn count_like(&self, sums: &Sums, joint: usize) -> usize {
        let root = sums.root[joint];
        let bone = |joint: usize| self.skeleton.joints[joint].offset.length();
        let own = (0..sums.root.len()).filter(|other| sums.root[*other] == root && *other != root);
        own.filter(|other| bone(*other) > ALIKE * bone(joint)).count()
    }

    fn sums(&self, roles: &[Role]) -> Sums {
        let skeleton = self.skeleton;
        let count = skeleton.len();
        let mut is_core = vec![false; count];
        for end in self.limbs.joints() {
            above(skeleton, end).for_each(|joint| is_core[joint] = true);
        }
        let bone = |joint: usize| skeleton.joints[joint].offset.length();
        let parent = |joint: usize| {
            let parent = skeleton.joints[joint].parent.map(|parent| parent.0);
            parent.filter(|parent| roles[*parent] != Role::Guide)
        };
        let (mut far, mut root) = (vec![0.0; count], Vec::with_capacity(count));
        for joint in 0..count {
            root.push(parent(joint).map_or(joint, |parent| root[parent]));
            if let Some(parent) = parent(joint).filter(|_| !is_core[joint]) {
                far[joint] = far[parent] + bone(joint);
            }
        }
        // Marks the joints of a finger. A joint named by the same word further out is only the point at its end.
        let mut known = vec![0; count];
        let mut is_part = Vec::with_capacity(count);
        for (joint, data) in skeleton.iter() {
            let before = parent(joint.0).map_or(0, |parent| known[parent]);
            let own = if is_core[joint.0] { 0 } else { parts_in(&data.name) };
            known[joint.0] = before | own;
            is_part.push(own & !before != 0 || own != 0 && is_in_a_row(&data.name));
        }
        let (mut reach, mut moves) = (vec![0.0; count], self.moves.to_vec());
        let (mut joints, mut bones) = (vec![1; count], vec![0.0; count]);
        for joint in (0..count).rev() {
            let Some(parent) = parent(joint) else { continue };
            bones[joint] += bone(joint);
            reach[parent] = f64::max(reach[parent], reach[joint] + bone(joint));
            moves[parent] |= moves[joint];
            is_part[parent] |= is_part[joint];
            joints[parent] += joints[joint];
            bones[parent] += bones[joint];
        }
        Sums { is_core, far, reach, moves, is_part, joints, bones, root }
    }
}

/// Finds the role that a name tells.
pub(super) fn role_of(name: &str) -> Option<Role> {
    let own = words(name);
    let is = |(_, words, letters): &&Names| {
        own.iter().any(|word| {
            words.contains(&word.trim_end_matches(|digit: char| digit.is_ascii_digit()))
        }) || letters.iter().any(|letters| name.contains(letters))
    };
    NAMES.iter().find(is).map(|(role, ..)| *role)
}

/// Returns the parts of hands, feet, heads and backs that a name mentions, one bit per word.
fn parts_in(name: &str) -> u32 {
    let words = words(name);
    let has = |part: &str| {
        let is = |word: &String| {
            word.starts_with(part) || word.trim_start_matches(['l', 'r']).starts_with(part)
        };
        words.iter().any(is) || !part.is_ascii() && name.contains(part)
    };
    let bit = |(at, part): (usize, &&str)| if has(part) { 1 << at } else { 0 };
    PARTS.iter().enumerate().map(bit).fold(0, |all, bit| all | bit)
}

/// Whether a name marks a joint as one of several in a row, as in a finger.
fn is_in_a_row(name: &str) -> bool {
    let words = words(name);
    let last = words.iter().rfind(|word| !SIDES.contains(&&word[..]));
    last.is_some_and(|word| {
        word.ends_with(char::is_numeric) || KNUCKLES.iter().any(|knuckle| word.ends_with(knuckle))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_says_what_is_no_body() {
        for (name, role) in [
            ("Hair_L_0", Some(Role::Hair)),
            ("J_Sec_Hair1_01", Some(Role::Hair)),
            ("ik_foot_Left", Some(Role::Helper)),
            ("KneePole", Some(Role::Helper)),
            ("ClothWeight", Some(Role::Helper)),
            ("左足ＩＫ", Some(Role::Helper)),
            ("前髪1", Some(Role::Hair)),
            ("Sword", Some(Role::Prop)),
            ("LeftForeArm", None),
            ("heart", None),
            ("Tailor", None),
            ("Spine", None),
            ("LeftEar", Some(Role::Hair)),
            ("左親指０", None),
        ] {
            assert_eq!(role_of(name), role, "{name}");
        }
        for name in [
            "LeftToeBase",
            "lBigToe",
            "LeftFingerBase",
            "LThumb",
            "LeftHandIndex4",
            "leftEye",
            "左人指１",
            "l_toes",
        ] {
            assert!(parts_in(name) != 0, "{name}");
        }
        for name in ["rMid2", "index_02_l", "leftIndexDistal", "左人指２", "f_index.02.L"] {
            assert!(is_in_a_row(name), "{name}");
        }
        for name in ["LeftToeBase_End", "LeftHandIndex3_tip", "more"] {
            assert!(!is_in_a_row(name), "{name}");
        }
        for name in ["Hips", "Sword", "LeftHand", "Neck"] {
            assert!(parts_in(name) == 0, "{name}");
        }
    }
}
