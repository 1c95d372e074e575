//! Reads motion of glTF 2.0 (.gltf, .glb, .vrm, .vrma): the joints of its skins, or the nodes that an
//! animation moves.
//!
//! Units are metres, with Y up, as the format defines. Curves are sampled at the rate derived from their
//! keys. In a VRM file, bones get their VRM 1.0 names. Cameras, props and their keys are kept for a GLB.

mod accessor;
mod buffers;
mod camera;
mod curve;
mod document;
mod kept;
mod scene;
#[cfg(test)]
mod tests;

pub(super) use document::Document;
pub use kept::{Carrier, GltfNode, GltfScene, GltfTrack};
pub(super) use scene::{camera_path, read};

use crate::reading::shortened;
use genga::error::{Error, Place};

/// Whether a file begins like glTF: a GLB, or a JSON object.
pub(super) fn begins(head: &[u8]) -> bool {
    head.starts_with(b"glTF") || {
        let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
        head.trim_ascii_start().starts_with(b"{")
    }
}

/// Builds an error about a part of a document. Words of the file in it are cut off at a length that can be read.
fn wrong(part: impl Into<String>, message: impl Into<String>) -> Error {
    let message = shortened(&message.into(), 400).into_owned();
    Error::Motion { place: Place::Part(part.into()), message }
}
