//! Tests how the format of a file is determined, and which files beside it a reader may open.

use std::fs;

use super::*;

#[test]
fn content_decides_and_the_ending_only_where_it_says_nothing() {
    let name = |head: &[u8], path: &str| Format::detect(head, Some(path.as_ref())).name;
    assert_eq!(name(b"\xef\xbb\xbf\n hierarchy\nROOT a", "walk.fbx"), "BVH");
    assert_eq!(name(b"\xff\xfeH\0I\0E\0R\0A\0R\0C\0H\0Y\0", "walk"), "BVH");
    assert_eq!(name(b"", "walk.txt"), "BVH", "whose reader then says what it expects");
    for format in FORMATS {
        for ending in format.endings {
            let path = format!("a/walk.{}", ending.to_uppercase());
            assert_eq!(name(b"\x01\x02\x03", &path), format.name);
        }
    }
}

#[test]
fn a_bvh_is_what_it_is_without_the_door() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh").as_ref();
    let plain = genga::motion::bvh::open(path).unwrap();
    let bytes = fs::read(path).unwrap();
    for read in [open(path).unwrap(), Options::default().read(&bytes).unwrap()] {
        assert_eq!((&read.clip, &read.warnings), (&plain.clip, &plain.warnings));
        assert_eq!(read.written_frame_time, Some(plain.written_frame_time));
        assert!(read.found.is_empty() && read.takes.is_empty());
    }
}

#[test]
fn what_a_bvh_cannot_have_is_refused() {
    let bytes = fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh")).unwrap();
    let said = |options: Options| options.read(&bytes).unwrap_err().to_string();
    let take = said(Options { take: Some("Walk".into()), ..Options::default() });
    assert_eq!(take, "take: there is no take \"Walk\": the file has one motion, without a name");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh").as_ref();
    let asked = Options { take: Some("Walk".into()), ..Options::default() };
    assert_eq!(asked.open(path).unwrap_err().to_string(), take, "opened by its path as well");
}

#[test]
fn what_is_no_motion_is_refused_with_the_way_out() {
    let said = |bytes: &[u8]| Options::default().read(bytes).unwrap_err().to_string();
    assert!(said(b"PMX \0\0\0\x40").contains("--skeleton"), "{}", said(b"PMX "));
    assert!(said(b"Pmd\0\0\x80\x3f").contains("--skeleton"));
    assert!(said(b"PathFileType\t4").starts_with("these are the paths of markers"));
}

/// Reads files with up to five random changes: bytes flipped, cut out or doubled, numbers replaced by odd
/// ones. No reader may panic; each file must be read or rejected with a motion error.
pub(crate) fn read_changed(whole: &[u8], times: u64) {
    let odd: [&[u8]; 6] = [b"-1", b"1e308", b"99999999999", b"4294967295", b"0", b""];
    let options = Options { stream: StreamLimit { bytes: 16 << 20 }, ..Options::default() };
    for seed in 1..=times {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut below = |most: usize| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state % most.max(1) as u64) as usize
        };
        let mut bytes = whole.to_vec();
        for _ in 0..=below(5) {
            let at = below(bytes.len());
            let end = (at + below(40)).min(bytes.len());
            match below(5) {
                0 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << (seed % 8)),
                1 => drop(bytes.drain(at..end)),
                2 => bytes.extend_from_within(at..end),
                3 => bytes.truncate(at.max(16)),
                _ => {
                    let digit = (at..bytes.len()).find(|at| bytes[*at].is_ascii_digit());
                    let number = odd[below(odd.len())];
                    if let Some(digit) = digit {
                        bytes.splice(digit..=digit, number.iter().copied());
                    }
                }
            }
        }
        match options.read(&bytes) {
            Ok(read) => assert!(!read.clip.is_empty(), "{seed}: a clip without a frame"),
            Err(Error::Motion { .. }) => {}
            Err(other) => panic!("{seed}: {other}"),
        }
    }
}
