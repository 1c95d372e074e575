//! Any two texts, the skeleton before a line of `%` and the motion after it: the reader refuses them with line and
//! column, or returns a clip.

use std::path::PathBuf;
use std::sync::OnceLock;

use genga::error::{Error, Place};
use genga_read as file;

use super::measure::{self, Bound};

/// Bytes of memory that a call may take for each byte of its input.
const MULTIPLE: usize = 256;

/// Fixed allowance in bytes.
const FREE: usize = 256 << 10;

/// Path of the skeleton, which the reader finds by its path.
fn skeleton() -> &'static PathBuf {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| std::env::temp_dir().join(format!("genga-fuzz-{}.asf", std::process::id())))
}

/// Panics if the check fails.
pub(super) fn check(bytes: &[u8]) {
    let at = bytes.windows(3).position(|part| part == b"\n%\n");
    let (asf, amc) = at.map_or((bytes, &b""[..]), |at| (&bytes[..at], &bytes[at + 3..]));
    if std::fs::write(skeleton(), asf).is_err() {
        return;
    }
    let mut motion = b":DEGREES\n".to_vec();
    motion.extend(amc);
    let skeleton = Some(skeleton().clone());
    let options = file::Options { skeleton, ..file::Options::default() };
    let (size, most) = (bytes.len(), MULTIPLE * bytes.len() + FREE);
    match measure::measured(size, Bound { most, unit: size.max(1) }, || options.read(&motion)) {
        Ok(read) => assert!(!read.clip.is_empty(), "a clip without a frame"),
        Err(Error::Motion { place: Place::Line(line, column), .. }) => {
            assert!((1..=motion.len() + 1).contains(&line), "line {line}");
            assert!((1..=3 * motion.len() + 1).contains(&column), "column {column}");
        }
        Err(Error::Motion { place: Place::Part(place), .. }) => assert!(place.contains(".asf:")),
        Err(Error::Clip { .. }) => {}
        Err(other) => panic!("an error without a place: {other}"),
    }
}
