//! What of a glTF document says where cameras are.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use serde::Deserialize;

use crate::error::Error;

/// The parts of a document that carry cameras; all others are passed over.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Document {
    nodes: Vec<Node>,
    cameras: Vec<Lens>,
    animations: Vec<Animation>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Node {
    name: Option<String>,
    camera: Option<usize>,
    children: Vec<usize>,
    matrix: Option<[f64; 16]>,
    translation: [f64; 3],
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Lens {
    name: Option<String>,
    #[serde(rename = "type")]
    kind: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Animation {
    channels: Vec<Channel>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Channel {
    target: Target,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Target {
    node: Option<usize>,
}

/// A camera that a node carries.
#[derive(Debug)]
pub(super) struct Carried<'a> {
    pub(super) node: usize,
    /// The node's name and its own, as far as they have one.
    pub(super) names: Vec<&'a str>,
    pub(super) is_orthographic: bool,
}

impl Carried<'_> {
    pub(super) fn name(&self) -> String {
        self.names.first().map_or_else(|| format!("of node {}", self.node), ToString::to_string)
    }
}

impl Document {
    /// The document of a `.glb`, which has it in its first chunk, or of a `.gltf`, which is it.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, Error> {
        let json = if bytes.starts_with(b"glTF") { chunk(bytes)? } else { bytes };
        serde_json::from_slice(json).map_err(|error| wrong(format!("is no glTF 2.0: {error}")))
    }

    /// The cameras that stand somewhere, in the order of their nodes.
    pub(super) fn cameras(&self) -> Vec<Carried<'_>> {
        let nodes = self.nodes.iter().enumerate();
        let carried = nodes.filter_map(|(node, data)| {
            let lens = self.cameras.get(data.camera?)?;
            Some(Carried {
                node,
                names: [&data.name, &lens.name].into_iter().flatten().map(String::as_str).collect(),
                is_orthographic: lens.kind == "orthographic",
            })
        });
        carried.collect()
    }

    /// Where a node stands in the world.
    pub(super) fn place(&self, node: usize) -> Result<DAffine3, Error> {
        let way = self.way_up(node)?;
        Ok(way.into_iter().fold(DAffine3::IDENTITY, |below, node| self.nodes[node].local() * below))
    }

    /// Whether an animation moves a node or what carries it.
    pub(super) fn is_animated(&self, node: usize) -> Result<bool, Error> {
        let way = self.way_up(node)?;
        let channels = self.animations.iter().flat_map(|animation| &animation.channels);
        let mut moved = channels.filter_map(|channel| channel.target.node);
        Ok(moved.any(|node| way.contains(&node)))
    }

    /// A node and all that carry it, from below.
    fn way_up(&self, node: usize) -> Result<Vec<usize>, Error> {
        let parent = |node: usize| self.nodes.iter().position(|data| data.children.contains(&node));
        let mut way = vec![node];
        while let Some(next) = parent(way[way.len() - 1]) {
            if way.contains(&next) {
                return Err(wrong(format!("is no glTF 2.0: node {next} carries itself")));
            }
            way.push(next);
        }
        Ok(way)
    }
}

impl Node {
    fn local(&self) -> DAffine3 {
        if let Some(matrix) = &self.matrix {
            return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
        }
        let rotation = self.rotation.map_or(DQuat::IDENTITY, |rotation| {
            let [x, y, z, w] = rotation;
            let length = DQuat::from_xyzw(x, y, z, w).length();
            if length > 0.0 { DQuat::from_xyzw(x, y, z, w) / length } else { DQuat::IDENTITY }
        });
        let scale = self.scale.map_or(DVec3::ONE, DVec3::from_array);
        DAffine3::from_scale_rotation_translation(scale, rotation, self.translation.into())
    }
}

/// The JSON of a `.glb`: behind the file's twelve bytes and the eight of the first chunk.
fn chunk(bytes: &[u8]) -> Result<&[u8], Error> {
    let word = |at: usize| {
        let word = bytes.get(at..at + 4)?;
        word.try_into().ok().map(u32::from_le_bytes)
    };
    match (word(4), word(12), bytes.get(16..20)) {
        (Some(2), Some(length), Some(b"JSON")) => {
            let json =
                usize::try_from(length).ok().and_then(|length| bytes.get(20..)?.get(..length));
            json.ok_or_else(|| wrong("is cut off: its document is longer than the file"))
        }
        (Some(2), ..) => Err(wrong("is no glTF 2.0: its document does not come first")),
        _ => Err(wrong("is a GLB of another version than 2")),
    }
}

fn wrong(message: impl Into<String>) -> Error {
    Error::Camera { message: message.into() }
}
