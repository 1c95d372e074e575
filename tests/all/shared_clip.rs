//! A file opened in blocks by several threads gives the same clip as one read from memory.

use std::fs;

use genga::error::Error;
use genga::motion::bvh;
use tempfile::NamedTempFile;

use crate::cases::is_full;
use crate::clips;

/// The result to the bit, because NaN is not equal to itself.
fn told(read: Result<bvh::Read, Error>) -> Result<(Vec<u64>, String), String> {
    let read = read.map_err(|error| error.to_string())?;
    let clip = read.clip;
    let bits = clip.rows().flatten().map(|value| value.to_bits()).collect();
    let rest = (
        clip.skeleton(),
        clip.rate(),
        clip.first(),
        clip.len(),
        read.warnings,
        read.written_frame_time,
    );
    Ok((bits, format!("{rest:?}")))
}

/// Whether opening and reading give the same result, also with `strict` and with `repair`.
fn agree(bytes: &[u8]) -> bool {
    let file = NamedTempFile::new().unwrap();
    fs::write(file.path(), bytes).unwrap();
    let plain = bvh::Options::default();
    // A large file is checked without `strict` and `repair`, because their effect on a row does not depend on the
    // number of rows.
    if bytes.len() > 1 << 20 && !is_full() {
        return told(plain.open(file.path())) == told(plain.read(bytes));
    }
    let strict = bvh::Options { strict: true, ..plain.clone() };
    let repair = bvh::Options { repair: true, ..plain.clone() };
    [plain, strict, repair]
        .iter()
        .all(|options| told(options.open(file.path())) == told(options.read(bytes)))
}

/// A sample with one row repeated, and with the given number of frames in its header.
fn repeated(rows: usize, said: usize) -> Vec<u8> {
    let text = fs::read_to_string(clips::here("data/swing.bvh")).unwrap();
    let motion = text.find("Frames:").unwrap();
    let table = text.find("Frame Time:").unwrap();
    let row = table + text[table..].find('\n').unwrap() + 1;
    let begin = format!("{}Frames: {said}\n{}", &text[..motion], &text[table..row]);
    let line = text[row..].lines().next().unwrap().to_owned() + "\n";
    (begin + &line.repeat(rows)).into_bytes()
}

#[test]
fn every_clip_and_every_find_is_opened_as_it_is_read() {
    let found = fs::read_dir(clips::here("tests/bvh/found")).unwrap();
    let found = found.map(|entry| entry.unwrap().path());
    let samples = ["kick", "pitch", "swing", "tennis"];
    let samples = samples.map(|name| clips::here(&format!("data/{name}.bvh")));
    for path in found.chain(samples).chain(clips::all()) {
        assert!(agree(&fs::read(&path).unwrap()), "{}", path.display());
    }
}

#[test]
fn a_file_large_enough_for_threads_is_opened_as_it_is_read() {
    let line = repeated(1, 1).len() - repeated(0, 1).len();
    let rows = (10 << 20) / line;
    let plain = repeated(rows, rows);
    assert!(agree(&plain));
    assert!(agree(&repeated(rows, rows + 1)), "too few");
    assert!(agree(&repeated(rows, rows - 1)), "too many");
    let mut odd = plain.clone();
    let middle = odd.len() / 2;
    odd[middle] = b'x';
    assert!(agree(&odd), "no number");
    assert!(agree(&[&plain[..], b"\n \n"].concat()), "blank lines behind");
    assert!(agree(&[&plain[..], b"\0\0"].concat()), "NUL behind");
    assert!(agree(&plain[..plain.len() - line / 2]), "cut");
    assert!(agree(&[b"\xef\xbb\xbf", &plain[..]].concat()), "a mark before");
    let name = plain.windows(5).position(|word| word == b"ROOT ").unwrap() + 5;
    let japanese = [&plain[..name], b"\x8d\x98", &plain[name..]].concat();
    assert!(agree(&japanese), "a name in Shift-JIS, a byte longer in UTF-8");
}

#[test]
fn a_hierarchy_longer_than_a_block_is_opened_as_it_is_read() {
    let text = String::from_utf8(repeated(9, 9)).unwrap();
    let blanks = format!("OFFSET{}", " ".repeat(1 << 18));
    assert!(agree(text.replacen("OFFSET", &blanks, 1).as_bytes()), "one long line");
    let lines = format!("{}OFFSET", "\n".repeat(1 << 18));
    assert!(agree(text.replacen("OFFSET", &lines, 1).as_bytes()), "many lines");
}
