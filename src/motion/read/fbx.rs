//! FBX (binary and ASCII, 3.0 to 7.7), by ufbx: the scene's bones at every frame of a take.
//!
//! ufbx evaluates curves, layers, rotation orders, pre- and post-rotations and inherited scales. The scene is turned to
//! Y up and measured in centimetres. Constraints count as the program that wrote the file has baked them.
//! Without the feature `fbx` a file is known for what it is, and refused.

#[cfg(feature = "fbx")]
mod scene;
#[cfg(feature = "fbx")]
mod takes;
#[cfg(all(test, feature = "fbx"))]
mod tests;

#[cfg(feature = "fbx")]
pub(super) use scene::read;

/// How a binary file begins.
const BINARY: &[u8] = b"Kaydara FBX Binary";

/// Words of the first section of a file that is text; the oldest begin with the second.
const SECTIONS: [&[u8]; 2] = [b"FBXHeaderExtension", b"FBXHeaderVersion"];

/// Whether a file begins as FBX does: one that is text begins with comments.
pub(super) fn begins(head: &[u8]) -> bool {
    let has = |word: &[u8]| memchr::memmem::find(head, word).is_some();
    head.starts_with(BINARY)
        || head.trim_ascii_start().starts_with(b"; FBX")
        || SECTIONS.iter().any(|word| has(word))
}

/// What is said where ufbx was left out.
#[cfg(not(feature = "fbx"))]
pub(super) fn read(
    _: &super::reading::Given<'_>,
    _: &super::reading::Options,
) -> Result<super::reading::Read, crate::error::Error> {
    let message =
        "is FBX, and this genga was built without the feature fbx; export the motion as BVH or GLB";
    let place = crate::error::Place::Whole;
    Err(crate::error::Error::Motion { place, message: message.into() })
}
