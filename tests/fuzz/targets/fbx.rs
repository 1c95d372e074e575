//! Any bytes that begin as FBX: the reader refuses them with a place, or returns a clip that can be worked on. genga's
//! own memory is counted here. That of ufbx, which is C, is bounded by its allowance and by libFuzzer's limit.

use genga::error::{Error, Place};
use genga::motion::StreamLimit;
use genga_read as file;

use super::measure::{self, Bound};

/// Bytes that ufbx may take, and that may be sampled from curves.
const ALLOWED: usize = 4 << 20;

/// Bytes of memory that a call may take for each byte of its input.
const MULTIPLE: usize = 64;

/// Panics if the check fails.
pub(super) fn check(bytes: &[u8]) {
    // A file without the binary signature is text.
    let head: &[u8] = if bytes.starts_with(b"Kaydara FBX Binary") { b"" } else { b"; FBX\n" };
    let fbx = [head, bytes].concat();
    let options =
        file::Options { stream: StreamLimit { bytes: ALLOWED as u64 }, ..file::Options::default() };
    let most = MULTIPLE * fbx.len() + 2 * ALLOWED + (1 << 20);
    match measure::measured(fbx.len(), Bound { most, unit: fbx.len() }, || options.read(&fbx)) {
        Ok(read) => assert!(!read.clip.is_empty(), "a clip without a frame"),
        Err(Error::Motion { place, message }) => {
            if let Place::Byte(byte) = place {
                assert!(byte <= fbx.len() as u64, "byte {byte}: {message}");
            }
            assert!(message.len() < 2000, "an error of {} bytes", message.len());
        }
        Err(other) => panic!("an error without a place: {other}"),
    }
}
