//! Reads FBX (binary and ASCII, 3.0 to 7.7) with ufbx: samples the scene's bones at every frame of a take.
//!
//! ufbx evaluates curves, layers, rotation orders, pre- and post-rotations and inherited scales. The scene
//! is converted to Y up and centimetres. Constraints count only as baked by the program that wrote the
//! file.
//!
//! Without the feature `fbx`, an FBX file is recognised and rejected.

#[cfg(feature = "fbx")]
mod scene;
#[cfg(feature = "fbx")]
mod takes;
#[cfg(all(test, feature = "fbx"))]
mod tests;

#[cfg(feature = "fbx")]
pub(super) use scene::read;

/// First bytes of a binary file.
const BINARY: &[u8] = b"Kaydara FBX Binary";

/// Names of the first section of an ASCII file; the oldest files begin with the second.
const SECTIONS: [&[u8]; 2] = [b"FBXHeaderExtension", b"FBXHeaderVersion"];

/// Whether a file begins like FBX. ASCII files may begin with comments.
pub(super) fn begins(head: &[u8]) -> bool {
    let has = |word: &[u8]| memchr::memmem::find(head, word).is_some();
    head.starts_with(BINARY)
        || head.trim_ascii_start().starts_with(b"; FBX")
        || SECTIONS.iter().any(|word| has(word))
}

/// Rejects the file, because ufbx was not compiled in.
#[cfg(not(feature = "fbx"))]
pub(super) fn read(
    _: &super::reading::Given<'_>,
    _: &super::reading::Options,
) -> Result<super::reading::Read, genga::error::Error> {
    let message = "is FBX, which the studio's page and a genga without the feature fbx do not read: export the motion as BVH or \
         GLB, or open it in the window or in Blender";
    let place = genga::error::Place::Whole;
    Err(genga::error::Error::Motion { place, message: message.into() })
}
