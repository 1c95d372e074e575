//! Changes real files at random places. Reading them never panics, every error has a place in the file, and a clip that
//! is read stays the same when it is written and read back.

use std::fs;
use std::sync::LazyLock;

use genga::motion::bvh;
use proptest::prelude::*;
use proptest::sample::Index;

use crate::cases::cases;
use crate::clips;

/// The hierarchy and the first rows of every clip at hand, with the number of frames corrected.
static FILES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let samples = ["kick", "pitch", "swing", "tennis"];
    let samples = samples.map(|name| clips::here(&format!("data/{name}.bvh")));
    samples.into_iter().chain(clips::all()).map(|path| cut(&fs::read(path).unwrap())).collect()
});

const ROWS: usize = 4;

fn cut(bytes: &[u8]) -> Vec<u8> {
    let mut lines: Vec<Vec<u8>> =
        bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    let motion = lines.iter().position(|line| line.starts_with(b"MOTION")).unwrap();
    lines[motion + 1] = format!("Frames: {ROWS}\n").into_bytes();
    lines.truncate(motion + 3 + ROWS);
    lines.concat()
}

/// Words put in place of a number or a keyword.
const ODD: &[&str] = &[
    "nan",
    "-nan",
    "inf",
    "-1.#IND00",
    "1.#QNAN",
    "1e999",
    "-1e999",
    "1e-999",
    "1e308",
    "5e-324",
    "-0",
    "-0.0000",
    ".5",
    "5.",
    "+1",
    "1,5",
    "3-10",
    "--1",
    "1.2.3",
    "1e",
    "0x10",
    "",
    " ",
    "\0",
    "\u{1a}",
    "\u{3000}",
    "腰",
    "{",
    "}",
    "{OFFSET 0 0 0}",
    "JOINT",
    "JOINT a",
    "ROOT",
    "End Site",
    "End",
    "OFFSET",
    "CHANNELS",
    "CHANNELS 0",
    "MOTION",
    "Frames:",
    "Frames: 1000000000000",
    "Frame Time:",
    "Frame Time: 30",
    "0.041667",
    "18446744073709551616",
    "123456789012345678901234567890",
    "\r",
    "\n",
    "\r\n",
    "\t",
    "\u{feff}",
    "HIERARCHY",
];

/// One change of a file. Indices are relative to its content.
#[derive(Debug, Clone)]
enum Change {
    Flip(Index, u8),
    Delete(Index, usize),
    Double(Index, usize),
    Cut(Index),
    SwapLines(Index, Index),
    DropLine(Index),
    DoubleLine(Index),
    Word(Index, &'static str),
    Splice(Index, Index, Index),
}

fn any_change() -> impl Strategy<Value = Change> {
    let at = any::<Index>;
    prop_oneof![
        2 => (at(), any::<u8>()).prop_map(|(at, byte)| Change::Flip(at, byte)),
        1 => (at(), 1..40usize).prop_map(|(at, count)| Change::Delete(at, count)),
        1 => (at(), 1..400usize).prop_map(|(at, count)| Change::Double(at, count)),
        1 => at().prop_map(Change::Cut),
        1 => (at(), at()).prop_map(|(a, b)| Change::SwapLines(a, b)),
        1 => at().prop_map(Change::DropLine),
        1 => at().prop_map(Change::DoubleLine),
        4 => (at(), prop::sample::select(ODD)).prop_map(|(at, word)| Change::Word(at, word)),
        1 => (at(), at(), at()).prop_map(|(file, from, at)| Change::Splice(file, from, at)),
    ]
}

fn apply(bytes: &mut Vec<u8>, change: &Change) {
    if bytes.is_empty() {
        return;
    }
    let length = bytes.len();
    let lines = |bytes: &[u8]| -> Vec<Vec<u8>> {
        bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect()
    };
    match change {
        Change::Flip(at, byte) => bytes[at.index(length)] = *byte,
        Change::Delete(at, count) => {
            let at = at.index(length);
            bytes.drain(at..(at + count).min(length));
        }
        Change::Double(at, count) => {
            let at = at.index(length);
            let part = bytes[at..(at + count).min(length)].to_vec();
            bytes.splice(at..at, part);
        }
        Change::Cut(at) => bytes.truncate(at.index(length)),
        Change::SwapLines(a, b) => {
            let mut lines = lines(bytes);
            let (a, b) = (a.index(lines.len()), b.index(lines.len()));
            lines.swap(a, b);
            *bytes = lines.concat();
        }
        Change::DropLine(at) => {
            let mut lines = lines(bytes);
            lines.remove(at.index(lines.len()));
            *bytes = lines.concat();
        }
        Change::DoubleLine(at) => {
            let mut lines = lines(bytes);
            let at = at.index(lines.len());
            lines.insert(at, lines[at].clone());
            *bytes = lines.concat();
        }
        Change::Word(at, word) => {
            let at = at.index(length);
            let blank = |byte: &u8| byte.is_ascii_whitespace();
            let begin = bytes[..at].iter().rposition(blank).map_or(0, |at| at + 1);
            let end = bytes[begin..].iter().position(blank).map_or(length, |end| begin + end);
            bytes.splice(begin..end, word.bytes());
        }
        Change::Splice(file, from, at) => {
            let other = &FILES[file.index(FILES.len())];
            bytes.truncate(at.index(length));
            bytes.extend_from_slice(&other[from.index(other.len())..]);
        }
    }
}

proptest! {
    #![proptest_config(cases(400, 4000))]

    #[test]
    fn a_real_file_with_anything_changed_is_refused_at_a_place_or_comes_back_when_written(
        file in any::<Index>(),
        changes in prop::collection::vec(any_change(), 0..6),
    ) {
        let mut bytes = FILES[file.index(FILES.len())].clone();
        for change in &changes {
            apply(&mut bytes, change);
        }
        match bvh::read(&bytes) {
            Ok(read) => {
                prop_assert!(!read.clip.is_empty());
                let text = bvh::write(&read.clip);
                let again = bvh::read(text.as_bytes());
                prop_assert!(again.is_ok(), "{:?}", again);
                let again = again.unwrap().clip;
                prop_assert!(again == read.clip, "another clip came back from\n{}", text);
                prop_assert!(bvh::write(&again) == text, "other bytes came back from\n{}", text);
            }
            Err(error) => {
                let (line, column) = error.position().expect("a place");
                let breaks = bytes.iter().filter(|byte| matches!(byte, b'\n' | b'\r')).count();
                prop_assert!((1..=breaks + 1).contains(&line), "line {} of {}", line, breaks + 1);
                prop_assert!((1..=bytes.len() + 1).contains(&column), "column {}", column);
            }
        }
    }
}

#[test]
fn the_files_are_read_as_long_as_nothing_is_changed() {
    for bytes in FILES.iter() {
        let read = bvh::read(bytes).unwrap();
        assert_eq!((read.clip.len(), read.warnings), (ROWS, vec![]));
    }
}
