//! What fuzzing found, kept: each file of `tests/bvh/found` once broke one of these.

use std::fs;
use std::path::Path;

use genga::motion::bvh;

fn each(look: impl Fn(&str, &[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bvh/found");
    let paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(paths.len() >= 5, "{paths:?}");
    for path in paths {
        look(&path.file_name().unwrap().to_string_lossy(), &fs::read(&path).unwrap());
    }
}

#[test]
fn what_is_read_comes_back() {
    each(|name, bytes| {
        let Ok(read) = bvh::read(bytes) else { return };
        let text = bvh::write(&read.clip);
        let again = bvh::read(text.as_bytes()).unwrap().clip;
        assert!(again == read.clip, "{name} comes back as another clip");
        assert_eq!(bvh::write(&again), text, "{name}");
    });
}

#[test]
fn lines_may_end_in_cr_as_well_as_in_lf() {
    each(|name, bytes| {
        let cr: Vec<u8> =
            bytes.iter().map(|&byte| if byte == b'\n' { b'\r' } else { byte }).collect();
        let told = |bytes: &[u8]| {
            bvh::read(bytes).map(|read| (read.clip, read.warnings)).map_err(|e| e.to_string())
        };
        assert_eq!(told(&cr), told(bytes), "{name}");
    });
}
