//! What holds for any text.

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
