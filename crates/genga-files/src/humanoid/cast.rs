//! The cast (配役): the bones of the model that plays the motion, and the joints that drive each.

use genga::error::{Error, Warning};
use genga::knob::choices;
use genga::motion::JointId;
use genga::motion::body::names::bones::{Bone, Model, Part, Side, cp932};
use genga::motion::body::names::{BoneMap, Found};
use genga::motion::body::structure;
use genga_read::MmdModel;

/// Warning code for an arm or leg without motion in a file. It is a loss, so it must not be buried among other notes.
pub const STILL_LIMB: &str = "W_STILL_LIMB";

/// Maximum length of an IK bone's name in a VMD, in bytes of CP932.
const LONGEST_IK: usize = 20;

/// Bones that many models lack. Each comes with the neighbouring bone that then takes over its joints, and whether
/// these joints are further out than the neighbour's own.
const FOLDS: [(&str, &str, bool); 3] =
    [("上半身2", "上半身", true), ("左親指０", "左親指１", false), ("右親指０", "右親指１", false)];

/// The next bone along a limb.
const NEXT: [(&str, &str); 4] =
    [("腕", "ひじ"), ("ひじ", "手首"), ("足", "ひざ"), ("ひざ", "足首")];

/// Bones beside those of the limbs that a person expects to move.
const EXPECTED_MIDDLE: [&str; 2] = ["首", "頭"];

/// The bone set of a motion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum VmdBones {
    /// The standard bones (標準ボーン), which every model has. The chest drives 上半身.
    #[default]
    Standard,
    /// Also the semi-standard bones (準標準ボーン) 上半身2 and 親指０. Models without them lose their rotation.
    Semi,
}

choices!(VmdBones { Standard: "standard", Semi: "semi" });

/// The model's bones with the joints that drive them.
pub(crate) struct Cast {
    pub(crate) model: Model,
    pub(crate) found: Found,
    /// Length of the model's leg in MMD units, if a model is known.
    pub(crate) leg: Option<f64>,
    /// IK that would override driven bones.
    pub(crate) ik_off: Vec<String>,
    pub(crate) notes: Vec<Warning>,
}

impl Cast {
    /// Selects the bones of a map that the model has, or those of the requested set if no model is given. Further bones
    /// that a person named are assumed to exist.
    ///
    /// # Errors
    /// [`Error::Clip`] if the model has none of the bones that the clip drives.
    pub(crate) fn new(
        map: &BoneMap,
        mut found: Found,
        bones: VmdBones,
        body: Option<&MmdModel>,
    ) -> Result<Self, Error> {
        let all = &map.model.bones;
        let has = |name: &str| match body {
            Some(body) => body.find(name).is_some(),
            None => bones == VmdBones::Semi || !is_semi(name),
        };
        fold(&map.model, &mut found, has);
        let is_driven = |bone: &usize| !found.joints[*bone].is_empty();
        let absent: Vec<&str> = (0..all.len())
            .filter(|bone| is_driven(bone) && !has(&all[*bone].name))
            .map(|bone| &all[bone].name[..])
            .collect();
        let mut kept: Vec<usize> = (0..all.len()).filter(|bone| has(&all[*bone].name)).collect();
        if let Some(body) = body {
            // Sort parents first, by the model's own hierarchy.
            kept.sort_by_key(|bone| body.find(&all[*bone].name).map(|own| body.depth(own)));
            if !kept.iter().any(is_driven) {
                return Err(no_bone(body, &absent));
            }
        }
        let mut model = Model { bones: Vec::with_capacity(kept.len()) };
        for bone in &kept {
            let parent = parent(&map.model, *bone, &model, body);
            let Bone { name, part, .. } = all[*bone].clone();
            let rest = body.and_then(|body| rest(body, &name, part));
            model.bones.push(Bone { name, parent, part, rest });
        }
        found.joints = kept.iter().map(|bone| found.joints[*bone].clone()).collect();
        let (ik_off, mut notes) = ik_off(&model, &found, body);
        if body.is_some() && !absent.is_empty() {
            let message = format!(
                "vmd: the model has no bone {}: what their joints turn is in the bones further out, if any",
                absent.join(", ")
            );
            notes.push(Warning::new("W_VMD_NO_BONE", message));
        }
        Ok(Self { model, found, leg: body.and_then(MmdModel::leg), ik_off, notes })
    }

    /// Finds the joints of a bone by name; empty if the model lacks that bone.
    pub(crate) fn joints(&self, bone: &str) -> &[JointId] {
        self.model.find(bone).map_or(&[], |bone| &self.found.joints[bone])
    }

    /// Warns of arms or legs that will not move because none of their joints is known.
    pub(crate) fn still_limbs(&self) -> Option<Warning> {
        let still = structure::still_limbs(|bone| !self.joints(bone).is_empty());
        let message = format!(
            "vmd: {} will not move: no joint is known to be there; a file of bones says which (--bones)",
            still.join(", ")
        );
        (!still.is_empty()).then(|| Warning::new(STILL_LIMB, message))
    }

    /// Names the bones of the model that a person expects to move and that no joint drives.
    pub(crate) fn undriven(&self) -> Option<Warning> {
        let of_limbs = structure::LIMBS.iter().flat_map(|(_, bones)| {
            Side::BOTH
                .into_iter()
                .flat_map(move |side| bones.iter().map(move |bone| side.named(bone)))
        });
        let expected = EXPECTED_MIDDLE.iter().map(|bone| (*bone).to_owned()).chain(of_limbs);
        let is_undriven =
            |bone: &String| self.model.find(bone).is_some() && self.joints(bone).is_empty();
        let bones: Vec<String> = expected.filter(is_undriven).collect();
        let message =
            format!("vmd: no joint for the bones {}: they will not move", bones.join(", "));
        (!bones.is_empty()).then(|| Warning::new("W_VMD_NO_JOINT", message))
    }

    /// Whether all joints of a leg are known on at least one side.
    pub(crate) fn has_leg(&self) -> bool {
        Side::BOTH.into_iter().any(|side| drives_leg(side, |bone| !self.joints(bone).is_empty()))
    }
}

/// Whether a bone is semi-standard (準標準ボーン), one that a model may lack.
fn is_semi(name: &str) -> bool {
    FOLDS.iter().any(|(semi, ..)| *semi == name)
}

/// Moves the joints of missing bones to the bones that take them over.
fn fold(model: &Model, found: &mut Found, has: impl Fn(&str) -> bool) {
    for (semi, other, is_outer) in FOLDS {
        if has(semi) || !has(other) {
            continue;
        }
        let (Some(semi), Some(other)) = (model.find(semi), model.find(other)) else { continue };
        let joints = std::mem::take(&mut found.joints[semi]);
        let own = &mut found.joints[other];
        let at = if is_outer { own.len() } else { 0 };
        own.splice(at..at, joints);
    }
}

/// The nearest ancestor that is already in the cast, by the model's own hierarchy or else by the standard one.
fn parent(all: &Model, bone: usize, cast: &Model, body: Option<&MmdModel>) -> Option<usize> {
    let name = &all.bones[bone].name;
    if let Some((body, own)) = body.and_then(|body| Some((body, body.find(name)?))) {
        return body.above(own).find_map(|above| cast.find(above));
    }
    let above = |bone: &usize| all.bones[*bone].parent;
    std::iter::successors(above(&bone), above).find_map(|above| cast.find(&all.bones[above].name))
}

/// The direction of a limb's bone in the model at rest.
fn rest(body: &MmdModel, name: &str, part: Part) -> Option<glam::DVec3> {
    let (Part::Arm(side) | Part::Leg(side)) = part else { return None };
    let stem = name.strip_prefix(side.word())?;
    let (_, next) = NEXT.iter().find(|(bone, _)| *bone == stem)?;
    body.way(name, &side.named(next))?.try_normalize()
}

fn drives_leg(side: Side, drives: impl Fn(&str) -> bool) -> bool {
    ["足", "ひざ", "足首"].iter().all(|bone| drives(&side.named(bone)))
}

/// The IK of bones that have motion of their own. Left on, it would override that motion.
fn ik_off(model: &Model, found: &Found, body: Option<&MmdModel>) -> (Vec<String>, Vec<Warning>) {
    let drives = |name: &str| model.find(name).is_some_and(|bone| !found.joints[bone].is_empty());
    let Some(body) = body else {
        let has_leg =
            |side: &Side| ["足", "ひざ", "足首"].iter().any(|bone| drives(&side.named(bone)));
        let sides: Vec<Side> = Side::BOTH.into_iter().filter(has_leg).collect();
        let names = ["足ＩＫ", "つま先ＩＫ"];
        let ik = names.iter().flat_map(|name| sides.iter().map(move |side| side.named(name)));
        return (ik.collect(), vec![]);
    };
    let fits = |name: &String| cp932(name, LONGEST_IK).is_ok();
    let (fitting, others): (Vec<_>, Vec<_>) = body.ik_of(drives).into_iter().partition(fits);
    let message = format!(
        "vmd: no VMD can switch {} off: its name does not fit. Switch it off in MMD",
        others.join(", ")
    );
    let note = (!others.is_empty()).then(|| Warning::new("W_VMD_IK_STAYS", message));
    (fitting, note.into_iter().collect())
}

fn no_bone(body: &MmdModel, absent: &[&str]) -> Error {
    const SHOWN: usize = 12;
    let names: Vec<&str> = body.bones().take(SHOWN).collect();
    Error::clip(format!(
        "vmd: the model {} has none of the bones that the clip drives ({}); its bones begin with {}",
        body.name,
        absent.join(", "),
        names.join(", ")
    ))
}
