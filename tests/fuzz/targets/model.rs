//! Any bytes as a model of MMD (PMX, PMD): the reader refuses them at a byte that is there, or gives bones that hang on one
//! another. It takes no more memory than the file can need.

use genga::error::Error;
use genga::motion::MmdModel;

use super::measure::{self, Bound};

/// Bytes of memory that a call may take for each byte of its input.
const MULTIPLE: usize = 64;

/// Bytes that it may take for nothing.
const FREE: usize = 64 << 10;

/// Panics where that does not hold.
pub(super) fn check(bytes: &[u8]) {
    let (size, most) = (bytes.len(), MULTIPLE * bytes.len() + FREE);
    match measure::measured(size, Bound { most, unit: size.max(1) }, || MmdModel::read(bytes)) {
        Ok(model) => assert!(model.bones().count() <= size, "more bones than bytes"),
        Err(Error::Model { byte, message }) => {
            assert!(byte <= size, "byte {byte}: {message}");
            assert!(message.len() < 2000 + size, "an error of {} bytes", message.len());
        }
        Err(other) => panic!("an error without a place: {other}"),
    }
}
