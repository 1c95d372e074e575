//! Parses a glTF document, as far as nodes, cameras and animations go; everything else is ignored.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use serde::Deserialize;
use serde_json::Value;

use genga::error::{Error, Place};

/// The parts of a glTF document that genga uses.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Document {
    pub(super) asset: Asset,
    pub(crate) nodes: Vec<Node>,
    pub(super) skins: Vec<Skin>,
    pub(crate) cameras: Vec<Lens>,
    pub(crate) animations: Vec<Animation>,
    pub(super) accessors: Vec<Accessor>,
    #[serde(rename = "bufferViews")]
    pub(super) views: Vec<View>,
    pub(super) buffers: Vec<Buffer>,
    pub(super) extensions: serde_json::Map<String, Value>,
}

/// The version of the document and the program that wrote it.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Asset {
    pub(super) version: String,
    pub(super) generator: String,
}

/// A glTF node.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Node {
    pub(crate) name: Option<String>,
    pub(crate) camera: Option<usize>,
    pub(super) mesh: Option<usize>,
    pub(super) skin: Option<usize>,
    pub(super) extensions: serde_json::Map<String, Value>,
    pub(crate) children: Vec<usize>,
    matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
}

/// A glTF camera.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Lens {
    pub(crate) name: Option<String>,
    #[serde(rename = "type")]
    pub(crate) kind: String,
    pub(super) perspective: Option<Perspective>,
    pub(super) orthographic: Option<Orthographic>,
}

/// The lens of a camera with perspective: its vertical angle of view in radians.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Perspective {
    pub(super) yfov: f64,
}

/// The lens of a camera without perspective: half the height of its picture.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Orthographic {
    pub(super) ymag: f64,
}

/// A glTF skin: its joint nodes.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Skin {
    pub(super) joints: Vec<usize>,
}

/// A glTF animation.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Animation {
    pub(super) name: Option<String>,
    pub(crate) channels: Vec<Channel>,
    pub(super) samplers: Vec<Sampler>,
}

/// A glTF animation channel.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Channel {
    pub(super) sampler: usize,
    pub(crate) target: Target,
}

/// The target of a channel: a property of a node.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Target {
    pub(crate) node: Option<usize>,
    pub(super) path: String,
}

/// A glTF animation sampler: accessors of key times and values, and the interpolation between keys.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Sampler {
    pub(super) input: usize,
    pub(super) output: usize,
    pub(super) interpolation: Option<String>,
}

/// A glTF accessor: typed numbers in a buffer view.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Accessor {
    #[serde(rename = "bufferView")]
    pub(super) view: Option<usize>,
    #[serde(rename = "byteOffset")]
    pub(super) offset: usize,
    #[serde(rename = "componentType")]
    pub(super) component: u32,
    pub(super) normalized: bool,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) sparse: Option<Sparse>,
}

/// The sparse values of an accessor, which replace some of its rows.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Sparse {
    pub(super) count: usize,
    pub(super) indices: Part,
    pub(super) values: Part,
}

/// The location of sparse indices or values.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Part {
    #[serde(rename = "bufferView")]
    pub(super) view: usize,
    #[serde(rename = "byteOffset")]
    pub(super) offset: usize,
    #[serde(rename = "componentType")]
    pub(super) component: u32,
}

/// A glTF buffer view: a part of a buffer.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct View {
    pub(super) buffer: usize,
    #[serde(rename = "byteOffset")]
    pub(super) offset: usize,
    #[serde(rename = "byteLength")]
    pub(super) length: usize,
    #[serde(rename = "byteStride")]
    pub(super) stride: Option<usize>,
    pub(super) extensions: serde_json::Map<String, Value>,
}

/// A glTF buffer: bytes in the file itself or beside it.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
}

/// Bytes before the JSON of a `.glb`: the file header and the header of the first chunk.
const BEFORE: usize = 20;

impl Document {
    /// Parses the document, which is the first chunk of a `.glb` or the whole of a `.gltf`; also returns
    /// the second chunk, if present.
    pub(crate) fn read(bytes: &[u8]) -> Result<(Self, Option<&[u8]>), Error> {
        if !super::begins(bytes) {
            let message = "is no glTF: it begins neither with glTF, as a GLB does, nor with {";
            return Err(Error::Motion { place: Place::Byte(0), message: message.into() });
        }
        if !bytes.starts_with(b"glTF") {
            let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
            let place = |line, column: usize| Place::Line(line, column.max(1));
            return Ok((parsed(json, place)?, None));
        }
        let (json, rest) = chunk(bytes)?;
        // The JSON of a GLB is usually a single line.
        let place = |line, column: usize| match line {
            1 => Place::Byte((BEFORE + column.saturating_sub(1)) as u64),
            _ => Place::Byte(BEFORE as u64),
        };
        Ok((parsed(json, place)?, binary(rest)))
    }

    /// The whole document as it is in a file that was read before.
    pub(super) fn raw(bytes: &[u8]) -> Result<Value, Error> {
        let json = match bytes.starts_with(b"glTF") {
            true => chunk(bytes)?.0,
            false => bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
        };
        serde_json::from_slice(filled(json)).map_err(|error| Error::Motion {
            place: Place::Whole,
            message: format!("is no glTF 2.0: {error}"),
        })
    }

    /// The parent of each node; `None` for roots.
    ///
    /// # Errors
    /// [`Error::Motion`] if a node is its own ancestor, has two parents, or refers to a missing child.
    pub(crate) fn parents(&self) -> Result<Vec<Option<usize>>, Error> {
        let mut parents = vec![None; self.nodes.len()];
        for (node, data) in self.nodes.iter().enumerate() {
            for (at, child) in data.children.iter().enumerate() {
                let part = || format!("nodes[{node}].children[{at}]");
                let Some(parent) = parents.get_mut(*child) else {
                    return Err(super::wrong(part(), format!("there is no node {child}")));
                };
                if parent.replace(node).is_some() {
                    return Err(super::wrong(part(), format!("node {child} is carried twice")));
                }
            }
        }
        // A node that is not reached from a root is part of a cycle.
        let mut reached = 0;
        let mut open: Vec<usize> =
            (0..parents.len()).filter(|node| parents[*node].is_none()).collect();
        let mut seen = vec![false; parents.len()];
        while let Some(node) = open.pop() {
            seen[node] = true;
            reached += 1;
            open.extend(&self.nodes[node].children);
        }
        if reached < parents.len() {
            let node = seen.iter().position(|seen| !seen).unwrap_or_default();
            return Err(super::wrong(
                format!("nodes[{node}]"),
                format!("node {node} carries itself"),
            ));
        }
        Ok(parents)
    }
}

impl Node {
    /// The local transform of the node without animation.
    pub(crate) fn local(&self) -> DAffine3 {
        if let Some(matrix) = &self.matrix {
            return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
        }
        placed(self.translation, self.rotation, self.scale)
    }

    /// Translation, rotation and scale, each of which an animation may replace.
    pub(super) fn parts(&self) -> ([f64; 3], [f64; 4], [f64; 3]) {
        if let Some(matrix) = &self.matrix {
            let matrix = DAffine3::from_mat4(DMat4::from_cols_array(matrix));
            let (scale, turn, place) = matrix.to_scale_rotation_translation();
            return (place.to_array(), turn.to_array(), scale.to_array());
        }
        let turn = self.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        (self.translation.unwrap_or_default(), turn, self.scale.unwrap_or([1.0; 3]))
    }
}

/// Composes a transform of three parts, each optional.
pub(super) fn placed(
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
) -> DAffine3 {
    let rotation = rotation.map_or(DQuat::IDENTITY, |rotation| {
        let rotation = DQuat::from_array(rotation);
        let length = rotation.length();
        if length > 0.0 { rotation / length } else { DQuat::IDENTITY }
    });
    let scale = scale.map_or(DVec3::ONE, DVec3::from_array);
    let translation = translation.map_or(DVec3::ZERO, DVec3::from_array);
    DAffine3::from_scale_rotation_translation(scale, rotation, translation)
}

fn parsed(json: &[u8], place: impl Fn(usize, usize) -> Place) -> Result<Document, Error> {
    let document: Document = serde_json::from_slice(filled(json)).map_err(|error| {
        let text = error.to_string();
        let reason = text.rsplit_once(" at line ").map_or(text.as_str(), |(reason, _)| reason);
        let message = format!("is no glTF 2.0: {reason}");
        Error::Motion { place: place(error.line(), error.column()), message }
    })?;
    if document.asset.version.starts_with("2.") {
        return Ok(document);
    }
    let found = match document.asset.version.as_str() {
        "" => "it has none".to_owned(),
        version => format!("found {version:?}"),
    };
    let message = format!("is no glTF 2.0: expected asset.version 2.0, {found}");
    Err(Error::Motion { place: Place::Whole, message })
}

/// Cuts off the padding: chunks are padded with blanks, by some writers with zeros.
fn filled(json: &[u8]) -> &[u8] {
    let filled = json.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
    &json[..filled]
}

/// Splits a `.glb` into its JSON and the remaining chunks.
fn chunk(bytes: &[u8]) -> Result<(&[u8], &[u8]), Error> {
    let wrong = |byte: u64, message: &str| {
        Err(Error::Motion { place: Place::Byte(byte), message: message.into() })
    };
    match (word(bytes, 4), word(bytes, 12), bytes.get(16..20)) {
        (Some(2), Some(length), Some(b"JSON")) => match bytes[BEFORE..].split_at_checked(length) {
            Some(parts) => Ok(parts),
            None => wrong(12, "is cut off: its document is longer than the file"),
        },
        _ if bytes.len() < BEFORE => wrong(bytes.len() as u64, "is cut off in its head"),
        (Some(2), ..) => wrong(12, "is no glTF 2.0: its document does not come first"),
        _ => wrong(4, "is a GLB of another version than 2"),
    }
}

/// The bytes of the second chunk, as far as they exist.
fn binary(rest: &[u8]) -> Option<&[u8]> {
    let length = word(rest, 0)?;
    let bytes = rest.get(4..8).filter(|kind| *kind == b"BIN\0").and_then(|_| rest.get(8..))?;
    Some(&bytes[..length.min(bytes.len())])
}

/// Reads a little-endian 32-bit number.
fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let word = bytes.get(at..at + 4)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(word)).ok()
}
