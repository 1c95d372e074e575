//! The cast (配役): which bones the model that plays the motion has, and what of the capture each of them takes over.

use super::{STILL_LIMB, VmdBones};
use crate::error::{Error, Warning};
use crate::motion::body::names::bones::{Bone, Model, Part, Side, cp932};
use crate::motion::body::names::{BoneMap, Found};
use crate::motion::body::structure;
use crate::motion::{JointId, MmdModel};

/// The longest name of an IK in a VMD, in bytes of CP932.
const LONGEST_IK: usize = 20;

/// Bones that many models lack, each with the one beside it that then takes its joints over, and whether these
/// are further out than those it has.
const FOLDS: [(&str, &str, bool); 3] =
    [("上半身2", "上半身", true), ("左親指０", "左親指１", false), ("右親指０", "右親指１", false)];

/// Which bone goes on from that of a limb.
const NEXT: [(&str, &str); 4] =
    [("腕", "ひじ"), ("ひじ", "手首"), ("足", "ひざ"), ("ひざ", "足首")];

/// The bones of the model with the joints that drive them.
pub(super) struct Cast {
    pub(super) model: Model,
    pub(super) found: Found,
    /// The model's leg in MMD units, where a model is known.
    pub(super) leg: Option<f64>,
    /// IK that would pull driven bones back.
    pub(super) ik_off: Vec<String>,
    pub(super) notes: Vec<Warning>,
}

impl Cast {
    /// Of the bones of a map those that a model has, or where none is given those that are asked for. Bones that a person
    /// named besides are taken to be there.
    ///
    /// # Errors
    /// [`Error::Clip`] when the model has no bone that the clip drives.
    pub(super) fn of(
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
            // Parents first, as the model has them.
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

    /// The joints of a bone by its name; none when the model has it not.
    pub(super) fn joints(&self, bone: &str) -> &[JointId] {
        self.model.find(bone).map_or(&[], |bone| &self.found.joints[bone])
    }

    /// That arms or legs have no motion, where no joint is known to be theirs.
    pub(super) fn still_limbs(&self) -> Option<Warning> {
        let still = structure::still_limbs(|bone| !self.joints(bone).is_empty());
        let message = format!(
            "vmd: {} will not move: no joint is known to be there; a file of bones says which (--bones)",
            still.join(", ")
        );
        (!still.is_empty()).then(|| Warning::new(STILL_LIMB, message))
    }

    /// Whether both joints of a leg are known on one side at least.
    pub(super) fn has_leg(&self) -> bool {
        Side::BOTH.into_iter().any(|side| drives_leg(side, |bone| !self.joints(bone).is_empty()))
    }
}

/// Whether a bone is one of those that models may have besides the standard ones (準標準ボーン).
fn is_semi(name: &str) -> bool {
    FOLDS.iter().any(|(semi, ..)| *semi == name)
}

/// Gives the joints of bones that are not there to the ones that take them over.
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

/// The nearest bone above that is in the cast already: as the model has it, or as all standard models do.
fn parent(all: &Model, bone: usize, cast: &Model, body: Option<&MmdModel>) -> Option<usize> {
    let name = &all.bones[bone].name;
    if let Some((body, own)) = body.and_then(|body| Some((body, body.find(name)?))) {
        return body.above(own).find_map(|above| cast.find(above));
    }
    let above = |bone: &usize| all.bones[*bone].parent;
    std::iter::successors(above(&bone), above).find_map(|above| cast.find(&all.bones[above].name))
}

/// Where the bone of a limb points in the model at rest.
fn rest(body: &MmdModel, name: &str, part: Part) -> Option<glam::DVec3> {
    let (Part::Arm(side) | Part::Leg(side)) = part else { return None };
    let stem = name.strip_prefix(side.word())?;
    let (_, next) = NEXT.iter().find(|(bone, _)| *bone == stem)?;
    body.way(name, &side.named(next))?.try_normalize()
}

fn drives_leg(side: Side, drives: impl Fn(&str) -> bool) -> bool {
    ["足", "ひざ", "足首"].iter().all(|bone| drives(&side.named(bone)))
}

/// The IK of bones that have a motion of their own: left on, it would pull them back.
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
