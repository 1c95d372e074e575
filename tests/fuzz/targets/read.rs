//! Any bytes: the reader refuses them, or returns a motion that is written and read back unchanged. The careful path,
//! which reads lines that end in CR, gives the same result as the quick path. Repairing panics no more than plain
//! reading does.

use genga::error::Error;
use genga::motion::{Clip, bvh};

use super::measure::{self, Bound};

/// Bytes of memory that a call may take for each byte of its input.
const MULTIPLE: usize = 64;

/// Fixed allowance in bytes.
const FREE: usize = 64 << 10;

fn measured<T>(size: usize, call: impl FnOnce() -> T) -> T {
    measure::measured(size, Bound { most: MULTIPLE * size + FREE, unit: size }, call)
}

/// Panics if the check fails.
pub(super) fn check(bytes: &[u8]) {
    let plain = measured(bytes.len(), || bvh::read(bytes));
    match &plain {
        Ok(read) => check_clip(&read.clip),
        Err(error) => check_error(error, bytes.len()),
    }
    let repair = bvh::Options { repair: true, ..bvh::Options::default() };
    match measured(bytes.len(), || repair.read(bytes)) {
        Ok(read) => {
            if plain.is_err() {
                check_clip(&read.clip);
            }
        }
        Err(error) => {
            check_error(&error, bytes.len());
            assert!(plain.is_err(), "repair breaks what was whole: {error}");
        }
    }
    // In UTF-16 a line end has more than one byte.
    if !bytes.contains(&b'\r') && !bytes.starts_with(b"\xff\xfe") && !bytes.starts_with(b"\xfe\xff")
    {
        let careful: Vec<u8> =
            bytes.iter().map(|&byte| if byte == b'\n' { b'\r' } else { byte }).collect();
        check_same(bvh::read(&careful), plain);
    }
}

fn check_clip(clip: &Clip) {
    assert!(!clip.is_empty(), "a clip without a frame");
    let text = bvh::write(clip);
    let again = match bvh::read(text.as_bytes()) {
        Ok(again) => again.clip,
        Err(error) => panic!("what was written is refused: {error}\n{text}"),
    };
    assert!(again == *clip, "another clip came back from\n{text}");
    assert!(bvh::write(&again) == text, "other bytes came back from\n{text}");
}

fn check_error(error: &Error, size: usize) {
    let (line, column) = error.position().expect("a reader's error has a place");
    // Lines end in LF, CRLF or CR, so there is at most one line per byte, and the end may be on one more. A byte of
    // Shift-JIS may be three of UTF-8.
    assert!((1..=size + 1).contains(&line), "line {line}");
    assert!((1..=3 * size + 1).contains(&column), "column {column}");
    assert!(error.to_string().len() < 2000, "an error of {} bytes", error.to_string().len());
}

fn check_same(careful: Result<bvh::Read, Error>, quick: Result<bvh::Read, Error>) {
    match (careful, quick) {
        (Ok(careful), Ok(quick)) => {
            assert!(careful.clip == quick.clip, "CR gives another clip than LF");
            assert_eq!(careful.warnings, quick.warnings, "CR and LF");
        }
        (Err(careful), Err(quick)) => assert_eq!(careful.to_string(), quick.to_string()),
        (careful, quick) => panic!("CR: {:?}\nLF: {:?}", careful.err(), quick.err()),
    }
}
