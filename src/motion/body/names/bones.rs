//! The bones of an MMD model (標準ボーン) that a motion can drive, and their hierarchy.

use encoding_rs::SHIFT_JIS;
use glam::DVec3;

use crate::error::Error;
use crate::maths;

/// Longest name of a bone in a VMD, in bytes of CP932. A longer name would be cut and match no bone of any model.
pub const LONGEST_NAME: usize = 15;

/// A side of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// 左; +X, in MMD as well.
    Left,
    /// 右.
    Right,
}

impl Side {
    /// Both sides, the left one first.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// Returns its word in MMD names: 左 or 右.
    pub fn word(self) -> &'static str {
        match self {
            Self::Left => "左",
            Self::Right => "右",
        }
    }

    pub(crate) fn english(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// Returns the name of this side's bone, given the name without 左 or 右.
    pub fn named(self, bone: &str) -> String {
        format!("{}{bone}", self.word())
    }

    /// Returns 1 for left and −1 for right, the sign of x on that side.
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// The kind of a bone, which decides how the rest poses of model and capture are matched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Part {
    /// Carries the whole body and turns nothing.
    Center,
    /// Pelvis, spine, neck, head, collar bones, feet: upright in the capture means upright in the model, whatever the
    /// slant of the bone itself.
    Trunk,
    /// Upper arm or forearm: the bone points in the same direction as in the capture.
    Arm(Side),
    /// Thigh or shin: the bone points in the same direction as in the capture.
    Leg(Side),
    /// Hand, fingers and bones added by a person: as their parent.
    Follows,
}

impl Part {
    /// Returns the direction of a limb's bone in a standard model at rest: arms hang `arm_angle` radians below the
    /// horizontal, legs point straight down. Axes as in BVH: +X is left, +Y up, +Z in front.
    pub fn rest_direction(self, arm_angle: f64) -> Option<DVec3> {
        let (sin, cos) = maths::sin_cos(arm_angle);
        match self {
            Self::Arm(side) => Some(DVec3::new(side.sign() * cos, -sin, 0.0)),
            Self::Leg(_) => Some(DVec3::NEG_Y),
            Self::Center | Self::Trunk | Self::Follows => None,
        }
    }
}

/// A bone of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Bone {
    /// Name in the model.
    pub name: String,
    /// Index of the parent bone, which comes earlier in the list.
    pub parent: Option<usize>,
    /// Kind of the bone.
    pub part: Part,
    /// Direction at rest, if the model gives it.
    pub rest: Option<DVec3>,
}

impl Bone {
    /// Returns the direction of a limb's bone at rest: that of its model, or else the standard one with arms at
    /// `arm_angle` radians.
    pub fn rest_direction(&self, arm_angle: f64) -> Option<DVec3> {
        self.rest.or_else(|| self.part.rest_direction(arm_angle))
    }
}

/// Name, parent and kind of the bones on the midline. Upper and lower body are siblings in MMD.
const MIDDLE: [(&str, Option<&str>, Part); 6] = [
    ("センター", None, Part::Center),
    ("下半身", Some("センター"), Part::Trunk),
    ("上半身", Some("センター"), Part::Trunk),
    ("上半身2", Some("上半身"), Part::Trunk),
    ("首", Some("上半身2"), Part::Trunk),
    ("頭", Some("首"), Part::Trunk),
];

/// Name, parent and kind of a bone on one side.
type Sided = (&'static str, &'static str, fn(Side) -> Part);

/// Bones of each side, without 左 and 右. A parent that begins with `=` has no side.
const SIDED: [Sided; 22] = [
    ("肩", "=上半身2", |_| Part::Trunk),
    ("腕", "肩", Part::Arm),
    ("ひじ", "腕", Part::Arm),
    ("手首", "ひじ", |_| Part::Follows),
    ("親指０", "手首", |_| Part::Follows),
    ("親指１", "親指０", |_| Part::Follows),
    ("親指２", "親指１", |_| Part::Follows),
    ("人指１", "手首", |_| Part::Follows),
    ("人指２", "人指１", |_| Part::Follows),
    ("人指３", "人指２", |_| Part::Follows),
    ("中指１", "手首", |_| Part::Follows),
    ("中指２", "中指１", |_| Part::Follows),
    ("中指３", "中指２", |_| Part::Follows),
    ("薬指１", "手首", |_| Part::Follows),
    ("薬指２", "薬指１", |_| Part::Follows),
    ("薬指３", "薬指２", |_| Part::Follows),
    ("小指１", "手首", |_| Part::Follows),
    ("小指２", "小指１", |_| Part::Follows),
    ("小指３", "小指２", |_| Part::Follows),
    ("足", "=下半身", Part::Leg),
    ("ひざ", "足", Part::Leg),
    ("足首", "ひざ", |_| Part::Trunk),
];

/// The bones of a model, parents before children.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Bones in order, parents first.
    pub bones: Vec<Bone>,
}

impl Model {
    /// Creates the standard and semi-standard bones that a motion can drive.
    pub fn standard() -> Self {
        let mut model = Self { bones: Vec::new() };
        for (name, parent, part) in MIDDLE {
            model.hang(name.into(), parent, part);
        }
        for side in Side::BOTH {
            for (name, parent, part) in SIDED {
                let sided = side.named(parent);
                let parent = parent.strip_prefix('=').unwrap_or(&sided);
                model.hang(side.named(name), Some(parent), part(side));
            }
        }
        model
    }

    fn hang(&mut self, name: String, parent: Option<&str>, part: Part) {
        let parent = parent.map(|parent| self.find(parent).expect("parents stand first"));
        self.bones.push(Bone { name, parent, part, rest: None });
    }

    /// Adds a bone that a person named; it follows its parent.
    pub(crate) fn add(&mut self, name: &str, parent: &str) -> Result<(), Error> {
        let wrong = |message| Err(Error::setting("bones", message));
        if self.find(name).is_some() {
            return wrong(format!("{name} is there already: give its joints under [bones]"));
        }
        let Some(parent) = self.find(parent) else {
            return wrong(format!("{name} cannot hang on {parent}, which is no bone"));
        };
        let part = Part::Follows;
        self.bones.push(Bone { name: name.into(), parent: Some(parent), part, rest: None });
        Ok(())
    }

    /// Returns the index of the bone with that name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.bones.iter().position(|bone| bone.name == name)
    }

    /// Returns the index of a side's bone, given the name without 左 or 右.
    pub fn sided(&self, side: Side, name: &str) -> Option<usize> {
        self.find(&side.named(name))
    }
}

/// Encodes a name in CP932.
///
/// # Errors
///
/// [`Error::Setting`] if it has a character that CP932 lacks, or more than `longest` bytes.
pub fn cp932(text: &str, longest: usize) -> Result<Vec<u8>, Error> {
    let (bytes, _, has_others) = SHIFT_JIS.encode(text);
    let wrong = |message| Err(Error::setting("vmd", message));
    if has_others || text.contains('\0') {
        return wrong(format!("\"{text}\" has letters that a VMD cannot hold (CP932)"));
    }
    if bytes.len() > longest {
        let found = bytes.len();
        return wrong(format!("\"{text}\" is {found} bytes in CP932; a VMD holds {longest}"));
    }
    Ok(bytes.into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cp932_and_never_cut() {
        assert_eq!(cp932("センター", 15).unwrap(), b"\x83Z\x83\x93\x83^\x81[");
        assert_eq!(cp932("左足ＩＫ", 15).unwrap(), b"\x8d\xb6\x91\xab\x82h\x82j");
        let error = cp932("左つま先ＩＫ親子", 15).unwrap_err().to_string();
        assert!(error.contains("16 bytes") && error.contains("holds 15"), "{error}");
        assert_eq!(cp932("左つま先ＩＫ親", 15).unwrap().len(), 14);
        assert!(cp932("🦵", 15).unwrap_err().to_string().contains("CP932"));
    }
}
