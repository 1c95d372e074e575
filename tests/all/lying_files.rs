//! Files of any size that lie about their content, for the tests in `lies.rs` and `benches/lies.rs`.

/// The expected outcome of a lying file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The file is refused.
    Refused,
    /// The file is odd but read as a motion.
    Read,
}

/// A kind of file: its name, its outcome, and a function that makes one of about the given size.
pub(crate) type Lie = (&'static str, Outcome, fn(usize) -> Vec<u8>);

use Outcome::{Read, Refused};

/// All lies.
pub(crate) const LIES: [Lie; 21] = [
    ("`Frames: 1e12`, one row after another", Read, |size| {
        motion("1000000000000", "1 2 3\n", size)
    }),
    ("`Frames: 1e12`, no row", Refused, |_| motion("1000000000000", "", 0)),
    ("`Frames: 99999999999999999999999`, rows", Read, |size| {
        motion("99999999999999999999999", "1 2 3\n", size)
    }),
    ("`Frames: 1`, rows and rows", Read, |size| motion("1", "1 2 3\n", size)),
    ("all frames in one line", Read, |size| motion("2", "1 2 3 ", size)),
    ("every third row one value short", Refused, |size| {
        motion("1000", "1 2 3\n1 2 3\n1 2\n", size)
    }),
    ("`CHANNELS 1e12`", Refused, |size| file("CHANNELS 1000000000000 ", "Xrotation ", "", size)),
    ("joints, a flat list", Read, |size| {
        joints(size, |at| format!("JOINT j{at}{{OFFSET 0 0 0}}\n"))
    }),
    ("joints, all of one name", Read, |size| {
        joints(size, |_| "JOINT Spine{OFFSET 0 0 0}\n".into())
    }),
    ("joints without a name: a warning each", Read, |size| {
        joints(size, |_| "JOINT{OFFSET 0 0 0}\n".into())
    }),
    ("End Sites", Read, |size| joints(size, |_| "End{OFFSET 0 0 0}\n".into())),
    ("joints in joints, closed", Read, nested),
    ("joints in joints, never closed", Refused, |size| file("", "JOINT a{OFFSET 0 0 0 ", "", size)),
    ("`{` and nothing else", Refused, |size| repeated("{", size)),
    ("`HIERARCHY ROOT a` and `{` without end", Refused, |size| file("", "{", "", size)),
    ("a number of digits without end", Refused, |size| motion("1", "1", size)),
    ("a number of zeros after the dot without end", Refused, |size| {
        motion("1", "0.0000000000000000", 17).into_iter().chain(repeated("0", size)).collect()
    }),
    ("a line of garbage where rows should be", Refused, |size| motion("1", "\u{fffd}\u{1}x", size)),
    ("a name without end", Refused, |size| {
        repeated("HIERARCHY ROOT x", 16).into_iter().chain(repeated("x", size)).collect()
    }),
    ("blanks and nothing else", Refused, |size| repeated(" ", size)),
    ("blank lines before the rows", Read, |size| {
        motion("1", "\r\n", size).into_iter().chain(*b"1 2 3\n").collect()
    }),
];

/// Repeats `text` up to about the given size.
fn repeated(text: &str, size: usize) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(size + size / 8 + 4096);
    append(&mut bytes, text, size);
    bytes
}

fn append(bytes: &mut Vec<u8>, text: &str, size: usize) {
    for _ in 0..size / text.len().max(1) {
        bytes.extend_from_slice(text.as_bytes());
    }
}

/// Makes a file with a root that goes on with `first`, then `text` repeated, then `last`.
fn file(first: &str, text: &str, last: &str, size: usize) -> Vec<u8> {
    let mut bytes = repeated("", size);
    bytes.extend_from_slice(b"HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n");
    bytes.extend_from_slice(first.as_bytes());
    append(&mut bytes, text, size);
    bytes.extend_from_slice(last.as_bytes());
    bytes
}

const CHANNELS: &str = "CHANNELS 3 Zrotation Xrotation Yrotation\n";
const MOTION: &str = "MOTION\nFrames: 2\nFrame Time: 0.041667\n1 2 3\n4 5 6\n";

fn motion(frames: &str, text: &str, size: usize) -> Vec<u8> {
    let head = format!("{CHANNELS}}}\nMOTION\nFrames: {frames}\nFrame Time: 0.041667\n");
    file(&head, text, "", size)
}

fn joints(size: usize, joint: fn(usize) -> String) -> Vec<u8> {
    let mut bytes = file(CHANNELS, "", "", size);
    let mut at = 0;
    while bytes.len() < size {
        bytes.extend_from_slice(joint(at).as_bytes());
        at += 1;
    }
    bytes.extend_from_slice(format!("}}\n{MOTION}").as_bytes());
    bytes
}

fn nested(size: usize) -> Vec<u8> {
    const OPEN: &str = "JOINT a{OFFSET 0 0 0\n";
    let levels = size / (OPEN.len() + 1);
    let mut bytes = file(CHANNELS, OPEN, "", levels * OPEN.len());
    append(&mut bytes, "}", levels + 1);
    bytes.extend_from_slice(MOTION.as_bytes());
    bytes
}
