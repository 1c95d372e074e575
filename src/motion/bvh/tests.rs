//! Tests of the reader and the writer together.

mod catalogue; // every case of docs/input.md
mod errors; // every error at its place
mod laws; // invariants for any text
mod lies; // files that lie about their size
mod options; // the options of the reader
mod spellings; // every accepted style
mod writing; // the writer, and the round trip through the reader

use super::sample::{ROW, text};
use super::{Read, read};
use crate::motion::{Clip, Skeleton};

const OTHER_ROW: &str = "1 2 3 4 5 6 7 8 9";

/// The sample with two frames: HIERARCHY is lines 1 to 15, the rows are lines 19 and 20.
fn sample() -> String {
    text("0.0083333", &[ROW, OTHER_ROW])
}

/// The clip of a text that must give no warning.
fn clip(text: &str) -> Clip {
    let Read { clip, warnings, .. } =
        read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(warnings, [], "{text}");
    clip
}

/// The sample with `from`, which must be present, replaced by `to`.
fn with(from: &str, to: &str) -> String {
    let sample = sample();
    assert!(sample.contains(from), "{from}");
    sample.replacen(from, to, 1)
}

fn hierarchy(text: &str) -> Skeleton {
    clip(text).skeleton().clone()
}
