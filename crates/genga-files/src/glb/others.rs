//! What the source holds beside the body (体以外): its nodes under the new ones, and their keys in the sheet's time.

use glam::{DAffine3, DMat3, DMat4, DVec3};
use serde_json::{Value, json};

use super::Space;
use super::binary::{Binary, Use};
use crate::timeline::Timeline;
use genga::motion::Clip;
use genga_read::{Between, Carrier, GltfScene, GltfTrack, Track};

/// The nodes that the source holds beside the body, in the new document.
pub(super) struct Hung<'a> {
    scene: &'a GltfScene,
    /// Index of each node in the new document.
    nodes: Vec<usize>,
}

/// The nodes that a clip's file holds beside the body, if it is a glTF that has some.
pub(super) fn scene_of(clip: &Clip) -> Option<&GltfScene> {
    clip.beside()?.kept::<GltfScene>().filter(|scene| !scene.nodes.is_empty())
}

impl<'a> Hung<'a> {
    /// Hangs the nodes on joints, on each other and on the scene, of which `roots` are the uppermost.
    pub(super) fn new(
        scene: &'a GltfScene,
        space: Space,
        (nodes, roots): (&mut Vec<Value>, &mut Vec<usize>),
    ) -> Self {
        let mut hung: Vec<usize> = Vec::with_capacity(scene.nodes.len());
        for node in &scene.nodes {
            let at = nodes.len();
            nodes.push(Value::Object(node.json.clone()));
            hung.push(at);
            let (parent, rest) = match node.carrier {
                Carrier::Node(parent) => (Some(hung[parent]), DAffine3::IDENTITY),
                Carrier::World => (None, space.affine()),
                Carrier::Joint(joint, rest) => (Some(joint), space.affine() * rest),
            };
            // Joints have the axes of the world at rest, and the source's had their own.
            let top = if rest.abs_diff_eq(DAffine3::IDENTITY, 1e-9) { at } else { nodes.len() };
            if top != at {
                let name = node.json.get("name").and_then(Value::as_str).unwrap_or("node");
                let matrix = DMat4::from(rest).to_cols_array().map(|part| part as f32 + 0.0);
                let name = format!("{name}_rest");
                nodes.push(json!({ "name": name, "matrix": matrix, "children": [at] }));
            }
            match parent {
                Some(parent) => carry(&mut nodes[parent], top),
                None => roots.push(top),
            }
        }
        Self { scene, nodes: hung }
    }

    /// Adds the keys to an animation with so many koma a second.
    pub(super) fn play(
        &self,
        animation: &mut Value,
        (timeline, koma_rate): (&Timeline, f64),
        binary: &mut Binary,
    ) {
        for GltfTrack { node, path, track } in &self.scene.tracks {
            let retimed = timeline.retimed(track);
            let Some(sampler) = sampler(&retimed, path, koma_rate, binary) else { continue };
            let samplers = list(animation, "samplers");
            samplers.push(sampler);
            let at = samplers.len() - 1;
            let target = json!({ "node": self.nodes[*node], "path": path });
            list(animation, "channels").push(json!({ "sampler": at, "target": target }));
        }
    }
}

/// Adds a child to a node.
fn carry(node: &mut Value, child: usize) {
    if node.get("children").is_none() {
        node["children"] = json!([]);
    }
    list(node, "children").push(child.into());
}

fn list<'a>(value: &'a mut Value, member: &str) -> &'a mut Vec<Value> {
    value[member].as_array_mut().expect("the member was made as a list")
}

/// Writes a sampler; `None` for a track without keys.
fn sampler(track: &Track, path: &str, koma_rate: f64, binary: &mut Binary) -> Option<Value> {
    // Two keys of the source may be one in single precision.
    let seconds: Vec<f32> = track.places.iter().map(|koma| (koma / koma_rate) as f32).collect();
    let is_later = |key: &usize| *key == 0 || seconds[*key] > seconds[*key - 1];
    let keys: Vec<usize> = (0..seconds.len()).filter(is_later).collect();
    let times: Vec<[f32; 1]> = keys.iter().map(|key| [seconds[*key].max(0.0)]).collect();
    // A spline has a key at either end.
    let is_spline = track.between == Between::Cubic && keys.len() > 1;
    let rows = if is_spline { 0..3 } else { 1..2 };
    let mut values: Vec<f32> = Vec::with_capacity(keys.len() * rows.len() * track.width);
    for key in keys {
        for row in rows.clone() {
            let scale = if row == 1 { 1.0 } else { koma_rate };
            let own = track.row(key, row);
            let length = match path {
                "rotation" if !is_spline => own.iter().map(|part| part * part).sum::<f64>().sqrt(),
                _ => 1.0,
            };
            values.extend(own.iter().map(|part| (scale * part / length) as f32));
        }
    }
    let input = (!times.is_empty()).then(|| binary.add_bounded(Use::Data, "SCALAR", &times))?;
    let output = match path {
        "rotation" => binary.add(Use::Data, "VEC4", values.as_chunks::<4>().0),
        "weights" => binary.add(Use::Data, "SCALAR", values.as_chunks::<1>().0),
        _ => binary.add(Use::Data, "VEC3", values.as_chunks::<3>().0),
    };
    let between = match track.between {
        Between::Step => "STEP",
        Between::Cubic if is_spline => "CUBICSPLINE",
        _ => "LINEAR",
    };
    Some(json!({ "input": input, "interpolation": between, "output": output }))
}

impl Space {
    /// The conversion as a matrix.
    fn affine(self) -> DAffine3 {
        let axis = |axis: DVec3| self.position(axis);
        let axes = DMat3::from_cols(axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z));
        DAffine3 { matrix3: axes, translation: DVec3::ZERO }
    }
}
