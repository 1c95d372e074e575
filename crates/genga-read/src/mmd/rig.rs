//! Selects the bones of a motion (ボーン構成): those with keys, and those that every body needs.

use std::collections::HashSet;

use glam::DVec3;

use super::legs::MmdLeg;
use super::model::MmdModel;
use super::record::{Key, Motion};
use super::usual_skeleton::{self, RestBone};

/// A bone with its keys.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RigBone {
    pub(super) rest: RestBone,
    /// Its keys; empty if it has none.
    pub(super) keys: Vec<Key>,
    /// Whether it is an IK target of a foot, which becomes no joint.
    pub(super) is_target: bool,
}

/// A leg solved by IK.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LegIk {
    pub(super) leg: MmdLeg,
    /// The names of the two IK bones.
    pub(super) names: [String; 2],
}

/// The bones that a motion moves.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rig {
    /// The bones, parents first.
    pub(super) bones: Vec<RigBone>,
    pub(super) legs: Vec<LegIk>,
    /// Keyed bones that the skeleton lacks.
    pub(super) strangers: Vec<String>,
    /// Vectors to the ends of the bones that carry no joint.
    pub(super) tips: Vec<(usize, DVec3)>,
}

impl Rig {
    /// Selects the bones of a model, or of the usual figure, that the motion moves or every body has.
    pub(super) fn new(motion: &Motion, model: Option<&MmdModel>) -> Self {
        let all = model.map_or_else(usual_skeleton::bones, of_model);
        let keys = |name: &str| motion.bones.get(&motion.names.of_bone(name));
        let is_kept =
            |bone: &RestBone| keys(&bone.name).is_some() || usual_skeleton::is_core(&bone.name);
        let mut places: Vec<Option<usize>> = Vec::with_capacity(all.len());
        let mut bones: Vec<RigBone> = Vec::new();
        for bone in &all {
            let above = |at: &usize| all[*at].parent;
            let mut up = std::iter::successors(bone.parent, above);
            let parent = up.find_map(|at| places[at]);
            places.push(is_kept(bone).then_some(bones.len()));
            if is_kept(bone) {
                let keys = keys(&bone.name).cloned().unwrap_or_default();
                let is_target = usual_skeleton::is_target(&bone.name);
                let rest = RestBone { parent, ..bone.clone() };
                bones.push(RigBone { rest, keys, is_target });
            }
        }
        let known: HashSet<String> =
            all.iter().map(|bone| motion.names.of_bone(&bone.name)).collect();
        let strangers =
            motion.bones.keys().filter(|name| !known.contains(*name)).cloned().collect();
        let mut rig = Self { bones, legs: Vec::new(), strangers, tips: Vec::new() };
        rig.legs = ["左", "右"].into_iter().filter_map(|side| rig.leg(side, &all)).collect();
        rig.tips = tips(&rig, &all);
        rig
    }

    /// Finds a bone by name.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.bones.iter().position(|bone| bone.rest.name == name)
    }

    /// Builds the IK of a leg, if its target is in the rig.
    fn leg(&self, side: &str, all: &[RestBone]) -> Option<LegIk> {
        let named = |name: &str| format!("{side}{name}");
        let bone = |name: &str| self.find(&named(name));
        let joints = [bone("足")?, bone("ひざ")?, bone("足首")?];
        let names = ["足ＩＫ", "つま先ＩＫ"].map(named);
        let target = self.find(&names[0])?;
        let place =
            |name: &str| all.iter().find(|bone| bone.name == named(name)).map(|bone| bone.place);
        let toes = place("つま先").or_else(|| place("つま先ＩＫ"));
        let ankle = self.bones[joints[2]].rest.place;
        let toes = toes.map(|toes| toes - ankle).filter(|way| way.length() > 0.0);
        let toes = toes.zip(self.find(&names[1]));
        Some(LegIk { leg: MmdLeg { joints, target, toes }, names })
    }

    /// Describes how the legs are moved.
    pub(super) fn legs_in_words(&self) -> String {
        let names: Vec<&str> = self.legs.iter().map(|leg| &leg.names[0][..]).collect();
        match &names[..] {
            [] => "legs turned by their own keys".into(),
            names => format!("legs brought to their feet by {}", names.join(", ")),
        }
    }
}

/// The bones of a model, parents first.
fn of_model(model: &MmdModel) -> Vec<RestBone> {
    let mut order: Vec<usize> = (0..model.bones.len()).collect();
    order.sort_by_key(|bone| model.bones[*bone].depth);
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, bone)| places[*bone] = at);
    let rest = |bone: &usize| {
        let bone = &model.bones[*bone];
        let parent = bone.parent.map(|parent| places[parent]);
        RestBone { name: bone.name.clone(), parent, place: bone.place, tip: bone.tip }
    };
    order.iter().map(rest).collect()
}

/// Shortest vector accepted as the end of a bone; some programs write ends a hair from the start.
const SHORTEST: f64 = 0.1;

/// Finds the ends of joints without children. Hands and feet end at the next bone. Others end where the
/// model says, or else hands, feet and head at a usual length.
fn tips(rig: &Rig, all: &[RestBone]) -> Vec<(usize, DVec3)> {
    const HEAD: DVec3 = DVec3::new(0.0, 2.4, 0.0);
    const FOOT: DVec3 = DVec3::new(0.0, -1.3, 1.4);
    let place = |name: &str| all.iter().find(|bone| bone.name == name).map(|bone| bone.place);
    let way = |from: &str, to: &str| Some(place(to)? - place(from)?);
    let usual = |bone: &RestBone| -> (Option<DVec3>, Option<DVec3>) {
        let name = bone.name.as_str();
        let sided = |own: &str| format!("{}{own}", name.chars().next().unwrap_or_default());
        match name.trim_start_matches(['左', '右']) {
            "頭" => (None, Some(HEAD)),
            "手首" => {
                let along = way(&sided("ひじ"), name).map(|forearm| 0.4 * forearm);
                (way(name, &sided("中指１")), along)
            }
            "足首" => {
                let toes = way(name, &sided("つま先"));
                (toes.or_else(|| way(name, &sided("つま先ＩＫ"))), Some(FOOT))
            }
            _ => (None, None),
        }
    };
    let mut carries = vec![false; rig.bones.len()];
    let joints = || rig.bones.iter().enumerate().filter(|(_, bone)| !bone.is_target);
    joints().filter_map(|(_, bone)| bone.rest.parent).for_each(|parent| carries[parent] = true);
    let tip = |(at, bone): (usize, &RigBone)| {
        let (next, usual) = usual(&bone.rest);
        let said = bone.rest.tip.filter(|way| way.length() >= SHORTEST);
        Some((at, next.or(said).or(usual)?))
    };
    joints().filter(|(at, _)| !carries[*at]).filter_map(tip).collect()
}
