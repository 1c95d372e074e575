//! Any bytes as a GLB, or as the rest of a JSON document: the reader refuses them with a place, or returns a clip that
//! can be worked on.

use genga::error::{Error, Place};
use genga::motion::StreamLimit;
use genga_read as file;

use super::measure::{self, Bound};

/// Bytes of numbers that may be read, and that may be sampled from curves.
const ALLOWED: usize = 4 << 20;

/// Bytes of memory that a call may take for each byte of its input.
const MULTIPLE: usize = 64;

/// Panics if the check fails.
pub(super) fn check(bytes: &[u8]) {
    // Input that is neither a GLB nor a document is put into one.
    let is_whole = bytes.starts_with(b"glTF") || bytes.starts_with(b"{");
    let head: &[u8] = if is_whole { b"" } else { br#"{"asset":{"version":"2.0"},"# };
    let gltf = [head, bytes].concat();
    let options =
        file::Options { stream: StreamLimit { bytes: ALLOWED as u64 }, ..file::Options::default() };
    let most = MULTIPLE * gltf.len() + 4 * ALLOWED + (1 << 20);
    match measure::measured(gltf.len(), Bound { most, unit: gltf.len() }, || options.read(&gltf)) {
        Ok(read) => assert!(!read.clip.is_empty(), "a clip without a frame"),
        Err(Error::Motion { place, message }) => {
            match place {
                Place::Byte(byte) => assert!(byte <= gltf.len() as u64, "byte {byte}: {message}"),
                Place::Line(line, column) => {
                    assert!((1..=gltf.len() + 1).contains(&line), "line {line}: {message}");
                    assert!(column <= gltf.len() + 1, "column {column}: {message}");
                }
                Place::Part(_) | Place::Whole => {}
            }
            assert!(message.len() < 2000, "an error of {} bytes", message.len());
        }
        Err(other) => panic!("an error without a place: {other}"),
    }
}
