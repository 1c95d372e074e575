//! Reads files that lie about their content. Each gives an error or the motion that is really there, in little time and
//! memory. `cargo bench -p genga-benches --bench lies` measures time and memory.

use genga::motion::bvh;

use crate::lying_files::{LIES, Outcome};

const SIZE: usize = 1 << 20;

#[test]
fn every_lie_is_refused_or_read_as_what_is_there() {
    for (name, outcome, make) in LIES {
        for size in [1 << 10, SIZE] {
            let bytes = make(size);
            match (outcome, bvh::read(&bytes)) {
                (Outcome::Refused, Err(error)) => {
                    assert!(error.position().is_some(), "{name}: {error}");
                    assert!(error.to_string().len() < 300, "{name}: {error}");
                }
                (Outcome::Read, Ok(read)) => assert!(!read.clip.is_empty(), "{name}"),
                (_, Err(error)) => panic!("{name}: {error}"),
                (_, Ok(_)) => panic!("{name} is read"),
            }
        }
    }
}

#[test]
fn what_is_read_of_a_lie_is_written_and_read_back() {
    for (name, _, make) in LIES {
        let Ok(read) = bvh::read(&make(SIZE / 4)) else { continue };
        let text = bvh::write(&read.clip);
        let again = bvh::read(text.as_bytes()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(again.clip == read.clip, "{name}");
    }
}

#[test]
fn a_hundred_thousand_levels_of_nesting_are_no_matter() {
    let (_, _, nested) =
        LIES.iter().find(|(name, ..)| *name == "joints in joints, closed").unwrap();
    let read = bvh::read(&nested(2_300_000)).unwrap();
    assert!(read.clip.skeleton().len() > 100_000);
}
