//! Reads left and right (左右) of a body from its joint names.

/// Prefixes that programs put before every joint name.
const PREFIXES: [&str; 4] = ["mixamorig", "bip001", "bip01", "character1"];

/// Separators between the words of a name.
pub(super) const DASHES: [char; 4] = [' ', '_', '-', '.'];

/// Parts of the body that may follow an l or r in the same case: lfemur, RHAND, but not lumbar, RIBS.
const PARTS: [&str; 25] = [
    "ankle", "arm", "buttock", "calf", "clavicle", "collar", "elbow", "eye", "femur", "finger",
    "foot", "forearm", "hand", "hip", "humerus", "knee", "leg", "radius", "shin", "shoulder",
    "thigh", "thumb", "tibia", "toe", "wrist",
];

/// The side of the body that a joint belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodySide {
    /// A left limb.
    Left,
    /// A right limb.
    Right,
    /// No side.
    Trunk,
}

impl BodySide {
    /// Reads the side from a joint's name: LeftArm, lShldr, LThumb, Bip01 L Thigh, Arm.L, lfemur, 左腕.
    pub fn from_name(name: &str) -> Self {
        let words = words(own_name(name));
        let is_alone = words.len() == 1;
        let side = words.iter().find_map(|word| match &word[..] {
            "l" | "r" if is_alone => None,
            "l" => Some(Self::Left),
            "r" => Some(Self::Right),
            word if begins(word, ["left", "左"], 'l') => Some(Self::Left),
            word if begins(word, ["right", "右"], 'r') => Some(Self::Right),
            _ => None,
        });
        side.unwrap_or(Self::Trunk)
    }
}

/// Whether a word begins with a word for a side, or with its letter and a part of the body.
fn begins(word: &str, sides: [&str; 2], letter: char) -> bool {
    let part = word.strip_prefix(letter);
    sides.iter().any(|side| word.starts_with(side))
        || part.is_some_and(|rest| PARTS.iter().any(|part| rest.starts_with(part)))
}

/// Returns a joint's name without its program's prefix.
pub(super) fn own_name(name: &str) -> &str {
    let name = name.rsplit(':').next().unwrap_or_default();
    let after = |prefix: &&str| {
        let (begin, rest) = name.split_at_checked(prefix.len())?;
        let rest = rest.trim_start_matches(DASHES);
        (begin.eq_ignore_ascii_case(prefix) && !rest.is_empty()).then_some(rest)
    };
    PREFIXES.iter().find_map(after).unwrap_or(name)
}

/// Normalizes a name for comparison: without prefix and separators, in lower case.
pub fn plain_name(name: &str) -> String {
    own_name(name).replace(DASHES, "").to_lowercase()
}

/// Splits a name into lower-case words: LThumb is l and thumb, UpperArm_R is upper, arm and r.
pub(super) fn words(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().collect();
    let mut words = vec![String::new()];
    for (at, letter) in letters.iter().enumerate() {
        let is_small = |at: usize| letters.get(at).is_some_and(|letter| letter.is_lowercase());
        let goes_on = at > 0 && letters[at - 1].is_uppercase() && !is_small(at + 1);
        if DASHES.contains(letter) || letter.is_uppercase() && !goes_on {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| !DASHES.contains(letter)) {
            word.extend(letter.to_lowercase());
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_sides(names: &str, side: BodySide) {
        names.split_terminator(',').map(str::trim).for_each(|name| {
            assert_eq!(BodySide::from_name(name), side, "{name}");
        });
    }

    #[test]
    fn a_side_is_read_from_the_names_of_every_dialect() {
        assert_sides(
            "LeftArm, LHipJoint, LThumb, LeftFingerBase, LeftInHandIndex, mixamorig:LeftHandThumb1,
            mixamorigLeftArm, mixamorig_LeftArm, Character1_LeftUpLeg, Take1:LeftFoot, LeftFinger1Metacarpal,
            LeftCollar, LFingers, lhand, Bip01 L Thigh, Bip001_L_UpperArm, Bip01 L Finger01, UpperArm_L,
            lShldr, lMid1, lButtock, leftEye, lfemur, lhipjoint, lclavicle, lradius, ltoes, lhumerus,
            left_foot, l_arm, Arm.L, arm_l, HandL, Thumb1L, LEFTHAND, LTHIGH, LEFT_ARM, J_Bip_L_UpperArm,
            DEF-thigh.L.001, 左腕",
            BodySide::Left,
        );
        assert_sides(
            "RightUpLeg, RHipJoint, RThumb, RFingers, rhand, R_Arm, Bip01 R Hand, Foot_R, rCollar, rIndex2,
            RightToeBase, RUpArm, RElbow, rfemur, rtibia, rwrist, Arm.R, armR, Hand_R_end, RHAND, 右ひじ",
            BodySide::Right,
        );
        assert_sides(
            "Hips, hip, LowerBack, lowerback, lowerneck, Root, root, ROOT, RIBS, LUMBAR, lumbar, ribcage, Reference,
            Neck1, L5, L3, T12, l, R, Spine.Lower, Bip01, Bip01 Pelvis, Bip01 Spine1, mixamorig:Hips, upperback,
            thorax, abdomen, Upright, LOWER_BACK, ",
            BodySide::Trunk,
        );
    }

    #[test]
    fn a_name_without_its_prefix_is_left_where_there_is_one() {
        for (name, own) in [
            ("mixamorig:LeftArm", "LeftArm"),
            ("Take1:Bip01 L UpperArm", "L UpperArm"),
            ("BIP001_Pelvis", "Pelvis"),
            ("Bip01", "Bip01"),
            ("首", "首"),
            ("", ""),
        ] {
            assert_eq!(own_name(name), own, "{name}");
        }
    }
}
