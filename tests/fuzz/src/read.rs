//! Any bytes: the reader refuses them, or gives a motion that is written and read back unchanged.

#![no_main]

mod measure;

use genga::motion::bvh;
use libfuzzer_sys::fuzz_target;
use measure::measured;

fuzz_target!(|bytes: &[u8]| {
    match measured(bytes.len(), || bvh::read(bytes)) {
        Ok(read) => {
            let clip = read.clip;
            assert!(!clip.is_empty(), "a clip without a frame");
            let text = bvh::write(&clip);
            let again = match bvh::read(text.as_bytes()) {
                Ok(again) => again.clip,
                Err(error) => panic!("what was written is refused: {error}\n{text}"),
            };
            assert!(again == clip, "another clip came back from\n{text}");
            assert!(bvh::write(&again) == text, "other bytes came back from\n{text}");
        }
        Err(error) => {
            let (line, column) = error.position().expect("a reader's error has a place");
            // Lines end in LF, CRLF or CR, so there is at most one a byte, and the end is in one.
            assert!((1..=bytes.len() + 1).contains(&line), "line {line}");
            assert!((1..=bytes.len() + 1).contains(&column), "column {column}");
            assert!(error.to_string().len() < 2000, "an error of {} bytes", error.to_string().len());
        }
    }
});
