//! Finds limbs by the words in names (単語). `r-thigh`, `ShoulderLeft` and `upperarm01.L` are in no dialect, yet clear
//! to any reader.

use crate::motion::body::accessories::role_of;
use crate::motion::body::side::{BodySide, own_name, words};
use crate::motion::{JointId, Skeleton};

/// Names of the three joints of an arm and of a leg, the most specific first.
const ARM: [&[&str]; 3] = [
    &["upperarm", "uparm", "armupper", "arm", "shldr", "shoulder"],
    &["forearm", "lowerarm", "loarm", "armlower", "elbow"],
    &["hand", "wrist", "palm", "fist"],
];
const LEG: [&[&str]; 3] = [
    &["thigh", "upperleg", "upleg", "legupper", "hip"],
    &["shin", "calf", "lowerleg", "loleg", "leglower", "knee", "leg"],
    &["foot", "ankle"],
];

/// Words that tell nothing about the body.
const NOISE: [&str; 8] = ["jnt", "jt", "joint", "bone", "bind", "def", "org", "dup"];

/// The joints of a skeleton, with their side and the rest of their name.
pub(super) struct ByWords<'a> {
    skeleton: &'a Skeleton,
    names: Vec<(BodySide, String, usize)>,
}

impl<'a> ByWords<'a> {
    /// Collects the joints of a tree, except those named as helpers, hair or props.
    pub(super) fn new(skeleton: &'a Skeleton, is_of_tree: &[bool]) -> Self {
        let own = skeleton
            .iter()
            .filter(|(joint, data)| is_of_tree[joint.0] && role_of(&data.name).is_none());
        let named = |(joint, data): (JointId, &crate::motion::Joint)| {
            (BodySide::from_name(&data.name), core(&data.name), joint.0)
        };
        Self { skeleton, names: own.map(named).collect() }
    }

    /// Finds shoulder, elbow and wrist of an arm.
    pub(super) fn arm(&self, side: BodySide) -> [Option<JointId>; 3] {
        self.limb(side, ARM)
    }

    /// Finds hip, knee and ankle of a leg.
    pub(super) fn leg(&self, side: BodySide) -> [Option<JointId>; 3] {
        self.limb(side, LEG)
    }

    /// Finds the head.
    pub(super) fn head(&self) -> Option<usize> {
        self.find(BodySide::Trunk, &["head", "skull", "forehead"])
    }

    /// Finds the joints of a limb. If the named end hangs elsewhere, for instance on an IK joint, the first child of
    /// the middle joint is used.
    fn limb(&self, side: BodySide, [upper, middle, lower]: [&[&str]; 3]) -> [Option<JointId>; 3] {
        let [upper, middle, lower] = [upper, middle, lower].map(|called| self.find(side, called));
        let parent = |joint: usize| self.skeleton.joints[joint].parent.map(|parent| parent.0);
        let hangs = |lower: &usize| {
            std::iter::successors(Some(*lower), |at| parent(*at)).any(|at| Some(at) == middle)
        };
        let carried =
            || (0..self.skeleton.len()).find(|joint| middle.is_some() && parent(*joint) == middle);
        let lower = lower.filter(hangs).or_else(carried);
        [upper, middle, lower].map(|joint| joint.map(JointId))
    }

    fn find(&self, side: BodySide, called: &[&str]) -> Option<usize> {
        let first = |word: &&str| {
            let is = |(own, core, _): &&(BodySide, String, usize)| *own == side && core == word;
            self.names.iter().find(is).map(|(.., joint)| *joint)
        };
        called.iter().find_map(first)
    }
}

/// Returns a name without side, numbers and noise words.
fn core(name: &str) -> String {
    let words = words(own_name(name)).into_iter().map(|word| {
        let word = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
        let bare = ["left", "right"].iter().find_map(|side| word.strip_prefix(side));
        let lettered = || {
            let is_sided = BodySide::from_name(word) != BodySide::Trunk;
            word.strip_prefix(['l', 'r']).filter(|_| is_sided)
        };
        bare.or_else(lettered).unwrap_or(word).to_owned()
    });
    words.filter(|word| word.len() > 1 && !NOISE.contains(&&word[..])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_name_says_besides_its_side_is_read_in_every_spelling() {
        for (name, expected) in [
            ("ShoulderLeft", "shoulder"),
            ("SHOULDER_LEFT", "shoulder"),
            ("lshoulder", "shoulder"),
            ("UpArm_L", "uparm"),
            ("upperarm01.L", "upperarm"),
            ("L_ForeArm", "forearm"),
            ("r-thigh", "thigh"),
            ("L_armUpper0001_bind_JNT", "armupper"),
            ("C_head0001_bind_JNT", "head"),
            ("Take1:LeftUpLeg", "upleg"),
            ("leftUpperLeg", "upperleg"),
            ("Hips", "hips"),
        ] {
            assert_eq!(core(name), expected, "{name}");
        }
    }
}
