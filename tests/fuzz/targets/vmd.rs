//! Any bytes after the signature of a VMD: the reader refuses them at a byte within the file, or returns a clip that
//! can be worked on. Its memory is bounded by the limit, whatever the file says about itself.

use genga::error::{Error, Place};
use genga::motion::StreamLimit;
use genga_read as file;

use super::measure::{self, Bound};

/// Bytes that may be sampled from curves: a few bytes can name a frame that is far away.
const SAMPLED: usize = 4 << 20;

/// Bytes of memory that a call may take for each byte of its input, and for sampled values.
const MULTIPLE: usize = 64;

/// Panics if the check fails.
pub(super) fn check(bytes: &[u8]) {
    let mut vmd = b"Vocaloid Motion Data".to_vec();
    vmd.extend(bytes);
    let options =
        file::Options { stream: StreamLimit { bytes: SAMPLED as u64 }, ..file::Options::default() };
    let most = MULTIPLE * vmd.len() + 2 * SAMPLED + (1 << 20);
    match measure::measured(vmd.len(), Bound { most, unit: vmd.len() }, || options.read(&vmd)) {
        Ok(read) => assert!(!read.clip.is_empty(), "a clip without a frame"),
        Err(Error::Motion { place: Place::Byte(byte), message }) => {
            assert!(byte <= vmd.len() as u64, "byte {byte}: {message}");
            assert!(message.len() < 2000, "an error of {} bytes", message.len());
        }
        // That no bone is known concerns the whole file.
        Err(Error::Motion { place: Place::Whole, message }) => assert!(message.contains("keyed")),
        Err(Error::Clip { .. }) => {}
        Err(other) => panic!("an error without a place: {other}"),
    }
}
