//! What a document holds beside the body (体以外): cameras, lights and props, with their keys, for a writer of glTF.

mod parts;

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::buffers::Buffers;
use super::curve::{Curve, Room};
use super::document::{Document, Node};
use crate::reading::{Found, counted, join_names};
use crate::track::Track;
use genga::error::Error;
use parts::Parts;

/// Nodes that are no part of the body, in the metres and axes of glTF, with all that they need.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GltfScene {
    /// The nodes, those that carry others first.
    pub nodes: Vec<GltfNode>,
    /// What the nodes refer to, by the names of the document's arrays: `meshes`, `cameras`, `accessors` …; and its
    /// `extensions` and `extensionsUsed`.
    pub parts: Map<String, Value>,
    /// The only buffer.
    pub bytes: Vec<u8>,
    /// The keys of the nodes.
    pub tracks: Vec<GltfTrack>,
    /// What could not be kept, a phrase each.
    pub lost: Vec<String>,
}

/// A node that is no joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GltfNode {
    /// The node as glTF writes it, without children.
    pub json: Map<String, Value>,
    /// What carries it.
    pub carrier: Carrier,
}

/// What carries a node.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Carrier {
    /// Nothing.
    World,
    /// An earlier node of the list.
    Node(usize),
    /// A joint of the clip, by its index, relative to which the node's own carrier stands so at rest.
    Joint(usize, DAffine3),
}

/// Keys of a node.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GltfTrack {
    /// Index of the node in the list.
    pub node: usize,
    /// The property that they move, as glTF calls it: `translation`, `rotation`, `scale` or `weights`.
    pub path: Cow<'static, str>,
    /// The keys.
    pub track: Track,
}

/// The body as it was read: the nodes that are joints, and how all nodes stand at rest.
pub(super) struct Body<'a> {
    /// The node of each joint of the clip.
    pub(super) joints: Vec<usize>,
    /// All nodes, parents first, and the parent of each.
    pub(super) order: &'a [usize],
    pub(super) parents: &'a [Option<usize>],
    /// Where each node stands at rest.
    pub(super) world: &'a [DAffine3],
}

/// The animation that was read: its index, the time of its first frame, and its rate.
#[derive(Clone, Copy)]
pub(super) struct Played {
    pub(super) animation: usize,
    pub(super) begin: f64,
    pub(super) fps: f64,
}

/// Properties of a node that have keys.
const PATHS: [&str; 4] = ["translation", "rotation", "scale", "weights"];

impl GltfScene {
    /// Keeps what stands beside a body; `None` if nothing does.
    pub(super) fn new(
        document: &Document,
        buffers: &mut Buffers<'_>,
        (bytes, body, room): (&[u8], &Body<'_>, Room),
        played: Played,
    ) -> Result<Option<Self>, Error> {
        let kept = kept(document, body, played);
        let mut scene = Self { lost: lost(document, &kept, played), ..Self::default() };
        if !kept.contains(&true) {
            return Ok((!scene.lost.is_empty()).then_some(scene));
        }
        let raw = Document::raw(bytes)?;
        let mut places: BTreeMap<usize, usize> = BTreeMap::new();
        let mut parts = Parts::new(&raw, document, buffers);
        for &node in body.order.iter().filter(|node| kept[**node]) {
            let mut json = raw["nodes"][node].as_object().cloned().unwrap_or_default();
            if let Err(error) = parts.adopt(&mut json) {
                let name = named(&document.nodes[node], node);
                scene.lost.push(format!("the shape of {name} ({error})"));
            }
            places.insert(node, scene.nodes.len());
            scene.nodes.push(GltfNode { json, carrier: body.carrier(node, &places) });
        }
        (scene.parts, scene.bytes) = parts.finish();
        scene.tracks = tracks(document, buffers, (&places, room), played)?;
        let has_shape = |track: &GltfTrack| {
            track.path != "weights" || scene.nodes[track.node].json.contains_key("mesh")
        };
        scene.tracks.retain(has_shape);
        Ok(Some(scene))
    }
}

impl GltfScene {
    /// Counts what is kept in words: `cameras (1), shapes (2)`; `None` if nothing is.
    pub fn words(&self) -> Option<String> {
        let count =
            |member: &str| self.nodes.iter().filter(|node| node.json.contains_key(member)).count();
        let mut moving: Vec<usize> = self.tracks.iter().map(|track| track.node).collect();
        moving.sort_unstable();
        moving.dedup();
        let name = |node: &usize| {
            let name = self.nodes[*node].json.get("name").and_then(Value::as_str);
            name.unwrap_or("without a name").to_owned()
        };
        let names: Vec<String> = moving.iter().map(name).collect();
        let names = format!("nodes that move: {}", join_names(&names));
        counted(&[(count("camera"), "cameras"), (count("mesh"), "shapes"), (moving.len(), &names)])
    }

    /// Describes what is kept, if anything is.
    pub(super) fn found(&self) -> Option<Found> {
        Some(Found::new("beside", format!("beside the body: {}", self.words()?)))
    }
}

impl Body<'_> {
    /// Finds what carries a node: another kept one, the joint above it, or nothing.
    fn carrier(&self, node: usize, places: &BTreeMap<usize, usize>) -> Carrier {
        let Some(parent) = self.parents[node] else { return Carrier::World };
        if let Some(at) = places.get(&parent) {
            return Carrier::Node(*at);
        }
        let mut way_up = std::iter::successors(Some(parent), |node| self.parents[*node]);
        let joint = way_up.find_map(|node| self.joints.iter().position(|joint| *joint == node));
        // Joints of the clip rest without a rotation, at the place of their node.
        let Some(joint) = joint else { return Carrier::World };
        let place: DVec3 = self.world[self.joints[joint]].translation;
        Carrier::Joint(joint, DAffine3::from_translation(-place) * self.world[parent])
    }
}

/// Marks the nodes that are kept: cameras, lights, shapes that no bones bend, and whatever moves beside the body; and the
/// nodes that carry one.
fn kept(document: &Document, body: &Body<'_>, played: Played) -> Vec<bool> {
    let mut is_joint = vec![false; document.nodes.len()];
    body.joints.iter().for_each(|joint| is_joint[*joint] = true);
    let mut carries_joint = is_joint.clone();
    let mut kept: Vec<bool> = document.nodes.iter().map(is_thing).collect();
    for &node in body.order.iter().rev() {
        if let Some(parent) = body.parents[node] {
            carries_joint[parent] |= carries_joint[node];
        }
    }
    // What moves and carries the body is in the body's motion.
    for channel in &document.animations[played.animation].channels {
        if let Some(node) = channel.target.node {
            kept[node] |= document.nodes[node].skin.is_none() && !carries_joint[node];
        }
    }
    for &node in body.order.iter().rev() {
        kept[node] &= !is_joint[node];
        if let Some(parent) = body.parents[node] {
            kept[parent] |= kept[node];
        }
    }
    kept
}

/// Whether a node is something to see or to see by.
fn is_thing(node: &Node) -> bool {
    let is_light = node.extensions.contains_key(parts::LIGHTS);
    node.camera.is_some() || is_light || (node.mesh.is_some() && node.skin.is_none())
}

/// Names the keys that no kept node has.
fn lost(document: &Document, kept: &[bool], played: Played) -> Vec<String> {
    let mut lost = Vec::new();
    let channels = &document.animations[played.animation].channels;
    let others = channels.iter().filter(|channel| channel.target.node.is_none()).count();
    if others > 0 {
        lost.push(format!("curves of other things than nodes ({others})"));
    }
    for channel in channels.iter().filter(|channel| channel.target.path == "weights") {
        let is_body = |node: &usize| !kept[*node] || document.nodes[*node].skin.is_some();
        if let Some(node) = channel.target.node.filter(is_body) {
            let name = named(&document.nodes[node], node);
            lost.push(format!("the morphs of {name}, whose shape is the body's"));
        }
    }
    lost
}

fn named(node: &Node, at: usize) -> String {
    node.name.clone().unwrap_or_else(|| format!("node {at}"))
}

/// Reads the keys of the kept nodes.
fn tracks(
    document: &Document,
    buffers: &mut Buffers<'_>,
    (places, mut room): (&BTreeMap<usize, usize>, Room),
    played: Played,
) -> Result<Vec<GltfTrack>, Error> {
    let animation = &document.animations[played.animation];
    let mut tracks = Vec::new();
    for channel in &animation.channels {
        let place = channel.target.node.and_then(|node| places.get(&node));
        let path = PATHS.iter().find(|path| **path == channel.target.path);
        let (Some(node), Some(path)) = (place, path) else { continue };
        let part = format!("animations[{}].samplers[{}]", played.animation, channel.sampler);
        let Some(sampler) = animation.samplers.get(channel.sampler) else {
            return Err(super::wrong(part, "there is no such sampler"));
        };
        let width = match *path {
            "rotation" => Some(4),
            "weights" => None,
            _ => Some(3),
        };
        let curve = Curve::read(document, buffers, sampler, width, &part)?;
        room.take(&curve, &part)?;
        let track = curve.track(played.begin, played.fps);
        tracks.push(GltfTrack { node: *node, path: Cow::Borrowed(path), track });
    }
    Ok(tracks)
}

#[cfg(test)]
mod tests;
