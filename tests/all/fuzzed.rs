//! The checks of fuzzing without fuzzing: on every seed and every file that once broke something, whole and cut short.
//!
//! `tests/fuzz/run` searches further and measures memory.

use std::fs;
use std::path::{Path, PathBuf};

use genga::motion::bvh;

use crate::clips::here;

#[path = "../fuzz/targets/amc.rs"]
mod amc;
#[path = "../fuzz/targets/chain.rs"]
mod chain;
#[cfg(feature = "fbx")]
#[path = "../fuzz/targets/fbx.rs"]
mod fbx;
#[path = "../fuzz/targets/gltf.rs"]
mod gltf;
#[path = "../fuzz/targets/model.rs"]
mod model;
#[path = "../fuzz/targets/read.rs"]
mod read;
#[path = "../fuzz/targets/vmd.rs"]
mod vmd;

/// Stand-in without measurement: counting memory needs an allocator, of which a program has only one.
mod measure {
    #[allow(dead_code, reason = "what counts reads it")]
    pub(super) struct Bound {
        pub(super) most: usize,
        pub(super) unit: usize,
    }

    pub(super) fn measured<T>(_: usize, _: Bound, call: impl FnOnce() -> T) -> T {
        call()
    }
}

/// The files of a folder, sorted.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let paths = entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    let mut paths: Vec<_> = paths.collect();
    paths.sort();
    assert!(!paths.is_empty(), "{} has no files", folder.display());
    paths
}

/// Checks files whole, cut short in eight places, and with a byte changed in each.
fn check_each(paths: &[PathBuf], check: impl Fn(&[u8])) {
    for path in paths {
        let whole = fs::read(path).unwrap();
        check(&whole);
        for part in 0..8 {
            let at = part * whole.len() / 8;
            check(&whole[..at]);
            let mut changed = whole.clone();
            changed.get_mut(at).into_iter().for_each(|byte| *byte ^= 0x5a);
            check(&changed);
        }
    }
}

fn seeds(target: &str) -> Vec<PathBuf> {
    files(&here("tests/fuzz/seeds").join(target))
}

fn found() -> Vec<PathBuf> {
    let found = files(&here("tests/bvh/found"));
    assert!(found.len() >= 5, "{found:?}");
    found
}

/// Checks files that contain CR too, which the fuzzer does not compare.
#[test]
fn lines_may_end_in_cr_as_well_as_in_lf() {
    let told = |bytes: &[u8]| {
        bvh::read(bytes).map(|read| (read.clip, read.warnings)).map_err(|e| e.to_string())
    };
    for path in found() {
        let bytes = fs::read(&path).unwrap();
        let cr = bytes.iter().map(|&byte| if byte == b'\n' { b'\r' } else { byte });
        assert_eq!(told(&cr.collect::<Vec<u8>>()), told(&bytes), "{}", path.display());
    }
}

#[test]
fn the_bvh_reader() {
    check_each(&found(), read::check);
}

#[test]
fn the_chain() {
    check_each(&found(), chain::check);
    check_each(&[here("data/swing.bvh")], |bytes| chain::check(&two_rows(bytes)));
}

/// Cuts a motion to its first two rows: a realistic body in few bytes.
fn two_rows(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    let mut rows = None;
    let lines = text.lines().map_while(|line| {
        let more = rows.is_none_or(|rows| rows < 2);
        rows = if line.starts_with("Frame Time") { Some(0) } else { rows.map(|rows| rows + 1) };
        more.then(|| if line.starts_with("Frames:") { "Frames: 2" } else { line })
    });
    lines.collect::<Vec<_>>().join("\n").into_bytes()
}

#[test]
fn the_acclaim_reader() {
    check_each(&seeds("amc"), amc::check);
}

#[test]
fn the_gltf_reader() {
    check_each(&seeds("gltf"), gltf::check);
}

#[test]
fn the_reader_of_models_of_mmd() {
    check_each(&seeds("model"), model::check);
}

#[test]
fn the_vmd_reader() {
    check_each(&seeds("vmd"), vmd::check);
}

#[cfg(feature = "fbx")]
#[test]
fn the_fbx_reader() {
    check_each(&seeds("fbx"), fbx::check);
}
