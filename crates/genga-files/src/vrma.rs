//! The limited motion for VRM avatars: VRM Animation (.vrma), a GLB whose nodes are mapped to the bones of VRM's
//! humanoid.
//!
//! The bones are those of an MMD model under other names, except that the spine hangs on the hips and the arms
//! rest level. So joints are found and the body is retargeted in the same way as for VMD.
//!
//! Players retarget the rotations to another body and rebuild the tracks without their interpolation, which would
//! turn steps into lines. A hold is therefore written as two equal keys, the second just before the next drawing.

mod names;
#[cfg(test)]
mod tests;

use std::borrow::Cow;

use glam::DVec3;
use serde_json::{Value, json};

use crate::glb::animation::{continuous, quaternion};
use crate::glb::binary::{Binary, Use};
use crate::glb::bones::floats;
use crate::glb::{GENERATOR, Step};
use crate::humanoid::capture::Capture;
use crate::humanoid::cast::{Cast, VmdBones};
use crate::humanoid::rest_alignment::Stance;
use crate::humanoid::retarget::{Local, Retarget};
use genga::error::{Error, Warning};
use genga::motion::body::names::{BoneMap, SHAPE};
use genga::motion::{Clip, Composite, JointId, Stature, played_out};
use genga::sheet::{Exposure, Sheet};
use names::{HIPS, SPINE, needed, vrm_name};

/// Keying of holds: two keys each.
const STEP: Step = Step::Doubled;

/// Height of an ankle above the floor as a share of the leg, if the capture does not tell.
const ANKLE: f64 = 0.1;

/// Maximum ankle height as a share of the leg. A higher value means that the capture's floor is not at 0.
const HIGHEST_ANKLE: f64 = 0.3;

/// Height of the hips of a body without legs, as a share of its size.
const NO_LEGS: f64 = 0.55;

/// Writes the motion of a sheet as the bytes of a `.vrma`, with all layers combined. `map` assigns joints to bones.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`]; [`Error::Clip`] if the clip has no frame or holds values that are
/// not finite, or if a bone that VRM requires has no known joint.
pub(crate) fn write(clip: &Clip, sheet: &Sheet, map: Option<&BoneMap>) -> Result<Vec<u8>, Error> {
    clip.check_size()?;
    if clip.is_empty() {
        return Err(Error::clip("the clip has no frame: there is no pose to write"));
    }
    let (clip, sheet) = played_out(clip, sheet);
    let (clip, sheet) = (&*clip, &*sheet);
    let composite = Composite::new(clip, sheet)?;
    let cast = cast(clip, map)?;
    let capture = Capture::new(clip, &cast.model, &cast.found);
    let stance = Stance::new(&capture, 0.0);
    let mut retarget = Retarget::new(&composite, &cast.model, &capture, &stance, 1.0);
    let rest = Rest::new(clip, &cast, &capture, &stance)?;
    let mut binary = Binary::default();
    let mut document = rest.document();
    document["animations"] =
        json!([animation(&composite, sheet, &rest, &mut retarget, &mut binary)?]);
    Ok(binary.into_glb(document))
}

/// Collects warnings about the file.
///
/// # Errors
/// The errors of [`write`] that concern joints.
pub(crate) fn notes(clip: &Clip, map: Option<&BoneMap>) -> Result<Vec<Warning>, Error> {
    let found = cast(clip, map)?.found;
    let message = match (&found.by_shape[..], found.dialect == SHAPE) {
        ([], _) => return Ok(Vec::new()),
        (_, true) => {
            "vrma: the shape of the body says which joint is which bone: no name does".into()
        }
        (bones, false) => {
            let bones: Vec<&str> = bones.iter().filter_map(|bone| vrm_name(bone)).collect();
            format!(
                "vrma: the shape of the body says which joints are {}: names do not, or do not fit it",
                bones.join(", ")
            )
        }
    };
    Ok(vec![Warning::new("W_BY_SHAPE", message)])
}

/// The bones with the joints that drive them, with the spine reattached to the hips.
fn cast(clip: &Clip, map: Option<&BoneMap>) -> Result<Cast, Error> {
    let map = map.map_or_else(|| Cow::Owned(BoneMap::default()), Cow::Borrowed);
    let mut cast = Cast::new(&map, map.locate(clip)?, VmdBones::Semi, None)?;
    let missing: Vec<&str> = needed()
        .filter(|bone| cast.joints(bone).is_empty())
        .filter_map(|bone| vrm_name(&bone))
        .collect();
    if !missing.is_empty() {
        return Err(Error::clip(format!(
            "vrma: VRM has no body without {}, and no joint is known to be there; a file of bones says which (--bones)",
            missing.join(", ")
        )));
    }
    let hips = cast.model.find(HIPS);
    if let Some(spine) = cast.model.find(SPINE) {
        cast.model.bones[spine].parent = hips;
    }
    Ok(cast)
}

/// A bone of the humanoid at rest.
struct Node {
    /// Index among the bones of the model.
    bone: usize,
    name: &'static str,
    parent: Option<usize>,
    /// Offset from its parent in the T-pose, in metres; for the hips, from the floor.
    offset: DVec3,
}

/// The body in its T-pose.
struct Rest {
    /// Hips first, parents before children.
    nodes: Vec<Node>,
    hips: JointId,
    /// Correction of the hips' height in the clip's unit: height when standing in the capture, minus the height in the
    /// T-pose.
    stands: f64,
    /// Metres per unit of the clip.
    metres: f64,
}

impl Rest {
    fn new(
        clip: &Clip,
        cast: &Cast,
        capture: &Capture<'_>,
        stance: &Stance,
    ) -> Result<Self, Error> {
        let stature = Stature::new(clip);
        let metres = stature.metres;
        let none = || Error::clip("vrma: no joint is known to be the hips");
        let hips = capture.begin(HIPS).ok_or_else(none)?;
        let leg = capture.leg();
        let over = capture.over_legs(hips).map_or(0.0, |way| (stance.pelvis * way).y);
        let ankle = capture.standing_ankle(stance.up).unwrap_or(0.0);
        let height = match leg {
            Some(leg) if (0.0..HIGHEST_ANKLE * leg).contains(&ankle) => over + leg + ankle,
            Some(leg) => over + leg + ANKLE * leg,
            None => NO_LEGS * stature.size,
        };
        let stands = over + leg.unwrap_or(height - over) + ankle;
        let mut nodes: Vec<Node> = Vec::new();
        for (bone, data) in cast.model.bones.iter().enumerate() {
            let (Some(name), Some(joint)) = (vrm_name(&data.name), capture.begin(&data.name))
            else {
                continue;
            };
            let above = |bone: &usize| cast.model.bones[*bone].parent;
            let mut up = std::iter::successors(data.parent, above);
            let parent = up.find_map(|above| nodes.iter().position(|node| node.bone == above));
            let offset = match parent.map(|parent| nodes[parent].bone) {
                None => height * DVec3::Y,
                Some(above) => {
                    let carrier = &cast.model.bones[above].name;
                    let from = capture.begin(carrier).unwrap_or(joint);
                    let right = stance.right[above].unwrap_or_default();
                    right.inverse() * capture.rest_way(from, joint)
                }
            };
            nodes.push(Node { bone, name, parent, offset: metres * offset });
        }
        Ok(Self { nodes, hips, stands: stands - height, metres })
    }

    /// The document with its nodes and their humanoid bones.
    fn document(&self) -> Value {
        let node = |(at, node): (usize, &Node)| {
            let children: Vec<usize> = (0..self.nodes.len())
                .filter(|child| self.nodes[*child].parent == Some(at))
                .collect();
            let mut document = json!({ "name": node.name, "translation": floats(node.offset) });
            if !children.is_empty() {
                document["children"] = children.into();
            }
            document
        };
        let bones = self.nodes.iter().enumerate();
        let bones = bones.map(|(at, node)| (node.name.to_owned(), json!({ "node": at })));
        json!({
            "asset": { "version": "2.0", "generator": GENERATOR },
            "extensionsUsed": [EXTENSION],
            "extensions": {
                EXTENSION: {
                    "specVersion": "1.0",
                    "humanoid": { "humanBones": bones.collect::<serde_json::Map<_, _>>() },
                },
            },
            "nodes": self.nodes.iter().enumerate().map(node).collect::<Vec<_>>(),
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
        })
    }
}

const EXTENSION: &str = "VRMC_vrm_animation";

/// Writes the only animation: rotations of every bone, and the translation of the hips.
fn animation(
    composite: &Composite<'_>,
    sheet: &Sheet,
    rest: &Rest,
    retarget: &mut Retarget<'_>,
    binary: &mut Binary,
) -> Result<Value, Error> {
    let koma_rate = sheet.clock.koma_rate;
    let layer = composite.layer();
    let exposures: Vec<(usize, Exposure)> = layer.timed().collect();
    let on_ones: Vec<(usize, Exposure)> =
        layer.koma().map(|drawing| Exposure { drawing, koma: 1 }).enumerate().collect();
    // If the feet stay planted while the body is held, the legs turn on every koma.
    let turns = if composite.steppers().is_empty() { &exposures } else { &on_ones };
    let ways = if composite.slides() { &on_ones } else { &exposures };
    let bones = retarget.bones();
    let taken: Vec<Vec<Local>> =
        turns.iter().map(|(begin, shown)| retarget.take(shown.drawing, *begin)).collect();
    let times = |exposures: &[(usize, Exposure)], binary: &mut Binary| {
        let (blank, length) = (sheet.blank, layer.length());
        let end = |begin: usize, koma: usize| blank.pose_ends(begin + koma, length);
        let holds = exposures
            .iter()
            .map(|(begin, shown)| (blank.pose_begins(*begin), end(*begin, shown.koma)));
        binary.add_bounded(Use::Data, "SCALAR", &STEP.times(holds, koma_rate))
    };
    let turn_times = times(turns, binary);
    let way_times = times(ways, binary);
    let places = ways.iter().map(|(begin, shown)| {
        retarget.take(shown.drawing, *begin);
        let place = retarget.place(rest.hips) - rest.stands * DVec3::Y;
        floats(rest.metres * place)
    });
    let places = binary.add(Use::Data, "VEC3", &STEP.values(places));
    let mut samplers = vec![sampler(way_times, places)];
    let mut channels = vec![channel(0, 0, "translation")];
    for (at, node) in rest.nodes.iter().enumerate() {
        let Some(column) = bones.iter().position(|bone| *bone == node.bone) else { continue };
        let rotations = taken.iter().map(|locals| quaternion(locals[column].rotation));
        let values = binary.add(Use::Data, "VEC4", &STEP.values(continuous(rotations)));
        channels.push(channel(samplers.len(), at, "rotation"));
        samplers.push(sampler(turn_times, values));
    }
    Ok(json!({ "name": "koma", "channels": channels, "samplers": samplers }))
}

fn sampler(times: usize, values: usize) -> Value {
    json!({ "input": times, "interpolation": STEP.interpolation(), "output": values })
}

fn channel(sampler: usize, node: usize, path: &str) -> Value {
    json!({ "sampler": sampler, "target": { "node": node, "path": path } })
}
