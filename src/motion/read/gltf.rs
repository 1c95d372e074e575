//! Motion of glTF 2.0 (.gltf, .glb, .vrm, .vrma): the joints of its skins, or the nodes that an animation moves.
//!
//! Metres and Y up, as the format has it. Curves are sampled at the rate that their keys mean. Where a file is VRM, bones
//! are called by their names of VRM 1.0. Weights of shapes and materials are no motion of a body.

mod accessor;
mod buffers;
mod curve;
mod document;
mod scene;
#[cfg(test)]
mod tests;

pub(super) use document::Document;
pub(super) use scene::read;

use crate::error::{Error, Place};

/// Whether a file begins as glTF does: as a GLB, or as an object in JSON.
pub(super) fn begins(head: &[u8]) -> bool {
    head.starts_with(b"glTF") || {
        let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
        head.trim_ascii_start().starts_with(b"{")
    }
}

/// What is wrong with a part of a document.
fn wrong(part: impl Into<String>, message: impl Into<String>) -> Error {
    Error::Motion { place: Place::Part(part.into()), message: message.into() }
}
