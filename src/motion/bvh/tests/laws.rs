//! Tests invariants that hold for any text.

use proptest::prelude::*;

use super::{clip, sample, with};
use crate::motion::bvh::sample::text;
use crate::motion::bvh::{Options, Read, read, write};
use crate::time::Frame;

proptest! {
    #[test]
    fn edited_bytes_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4u8), 1..8), repair: bool) {
        let mut bytes = sample().into_bytes();
        for (index, byte, kind) in edits {
            let at = index.index(bytes.len().max(1)).min(bytes.len());
            match kind {
                0 if at < bytes.len() => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 if at < bytes.len() => drop(bytes.remove(at)),
                _ => bytes.truncate(at),
            }
        }
        let options = Options { repair, ..Options::default() };
        if let Ok(Read { clip, .. }) = options.read(&bytes) {
            prop_assert!(!clip.is_empty());
            let again = read(write(&clip).as_bytes());
            prop_assert!(again.is_ok_and(|again| again.clip == clip));
        }
    }

    /// Lines that end in CR go to the careful reader; lines that end in LF go to the fast one if possible.
    #[test]
    fn the_quick_way_and_the_careful_way_read_the_same(
        words in prop::collection::vec(prop::sample::select(TABLE_WORDS.to_vec()), 0..60),
        said in 1usize..12,
        repair: bool,
    ) {
        let joint = "ROOT a { OFFSET 0 0 0 CHANNELS 2 Xrotation Yrotation }";
        let head = format!("HIERARCHY {joint} MOTION Frames: {said} Frame Time: 0.01\n");
        let lf = format!("{head}1 2\n{}", words.concat());
        let cr = lf.replace('\n', "\r");
        let options = Options { repair, ..Options::default() };
        let told = |text: &str| options.read(text.as_bytes()).map_err(|error| error.to_string());
        prop_assert_eq!(told(&lf), told(&cr), "{:?}", lf);
    }

    #[test]
    fn shuffled_words_never_panic(words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..40)) {
        let _ = read(format!("HIERARCHY ROOT a\n{{ {}", words.join(" ")).as_bytes());
        let _ = read(with("Frames:", &words.join(" ")).as_bytes());
    }

    #[test]
    fn any_finite_values_and_rate_come_back(
        values in prop::collection::vec(proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO, 9),
        time in 1e-4..0.99f64,
    ) {
        let text = text(&format!("{time}"), &[&values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")]);
        let first = clip(&text);
        prop_assert_eq!(first.row(Frame(0)), &values[..]);
        prop_assert_eq!(clip(&write(&first)), first);
    }
}

const TABLE_WORDS: [&str; 14] = [
    "1 2\n",
    "3 4\n",
    "-0.25 12.3456\n",
    " 5.1e-06\t7.0000 \n",
    "1e3 .5\n",
    "90 180\n",
    " ",
    "\n",
    "1",
    "-7.5 ",
    "nan ",
    "1-2",
    "0,5 ",
    "1e999 ",
];

const WORDS: [&str; 18] = [
    "ROOT",
    "JOINT",
    "a\n",
    "{",
    "}",
    "OFFSET",
    "0",
    "1 2 3",
    "CHANNELS",
    "3",
    "Xrotation",
    "Yposition",
    "End",
    "Site\n",
    "MOTION",
    "Frames:",
    "Frame Time:",
    "1e999",
];
