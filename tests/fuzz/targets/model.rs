//! Any bytes as a model of MMD (PMX, PMD): the reader refuses them at a byte within the file, or returns a hierarchy of
//! bones. It takes no more memory than the file can need.

use genga::error::{Error, Place};
use genga_read::MmdModel;

use super::measure::{self, Bound};

/// Bytes of memory that a call may take for each byte of its input.
const MULTIPLE: usize = 64;

/// Fixed allowance in bytes.
const FREE: usize = 64 << 10;

/// Panics if the check fails.
pub(super) fn check(bytes: &[u8]) {
    let (size, most) = (bytes.len(), MULTIPLE * bytes.len() + FREE);
    match measure::measured(size, Bound { most, unit: size.max(1) }, || MmdModel::read(bytes)) {
        Ok(model) => assert!(model.bones().count() <= size, "more bones than bytes"),
        Err(Error::Motion { place: Place::Byte(byte), message }) => {
            assert!(byte <= size as u64, "byte {byte}: {message}");
            assert!(message.len() < 2000 + size, "an error of {} bytes", message.len());
        }
        Err(other) => panic!("an error without a place: {other}"),
    }
}
