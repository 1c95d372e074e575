//! The real clips, which this repository does not hold: where they are, and a record of what was not tested without them
//! or without a program by others.
//!
//! Included by path in every test program that looks at them. `tests/what_was_left_out.rs` counts the records.

#![allow(dead_code, reason = "no test program needs all of it")]

use std::env;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread;

/// The clips that `docs/lab/evidence.md` describes. Other files of the folder are not looked at.
pub(crate) const NAMES: [&str; 15] = [
    "cmu-01_06-playground-long",
    "cmu-02_04-jump-balance",
    "cmu-02_05-punch-strike",
    "cmu-02_07-swordplay",
    "cmu-05_11-dance-pirouette",
    "cmu-06_15-dribble-shoot",
    "cmu-07_01-walk",
    "cmu-09_01-run",
    "cmu-10_03-soccer-kick",
    "cmu-11_01-soccer-kick",
    "cmu-131_03-start-hop-stop",
    "cmu-135_04-front-kick",
    "optitrack-arena-louise",
    "rokoko-jesse-dance",
    "threejs-pirouette",
];

/// The root of the repository, whichever of its packages has these tests.
pub(crate) fn repository() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let is_root = |folder: &&Path| folder.join("data/kick.bvh").is_file();
    package.ancestors().find(is_root).expect("a package lies in the repository").to_owned()
}

/// The folder of the clips: `GENGA_CLIPS`, or `../shared/data/bvh` beside the repository.
pub(crate) fn folder() -> PathBuf {
    let Some(named) = env::var_os("GENGA_CLIPS") else {
        return repository().join("../shared/data/bvh");
    };
    let folder = PathBuf::from(named);
    assert!(folder.is_dir(), "GENGA_CLIPS names {}, which is no folder", folder.display());
    folder
}

fn path(name: &str) -> PathBuf {
    folder().join(format!("{name}.bvh"))
}

/// The paths of all clips that are there, sorted by name. The others are recorded as left out of the running test.
pub(crate) fn all() -> Vec<PathBuf> {
    let (there, missing): (Vec<_>, Vec<_>) =
        NAMES.into_iter().partition(|name| path(name).is_file());
    record(&missing);
    there.into_iter().map(path).collect()
}

/// The BVH clips of the folder that `GENGA_MORE_CLIPS` names, for laws that hold on any clip; none where it names none.
pub(crate) fn more() -> Vec<PathBuf> {
    let Some(folder) = env::var_os("GENGA_MORE_CLIPS") else { return Vec::new() };
    let entries = fs::read_dir(&folder).expect("GENGA_MORE_CLIPS names a folder");
    let paths = entries.map(|entry| entry.expect("a folder can be listed").path());
    let mut paths: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "bvh")).collect();
    paths.sort();
    paths
}

/// Runs a test on all clips that are there. Without any it does not run.
pub(crate) fn with_all(test: impl FnOnce(Vec<PathBuf>)) {
    let clips = all();
    if !clips.is_empty() {
        test(clips);
    }
}

/// Runs a test on the clips of these names. Where one is missing it does not run, and is recorded as left out.
pub(crate) fn with<const N: usize>(names: [&'static str; N], test: impl FnOnce([PathBuf; N])) {
    assert!(names.iter().all(|name| NAMES.contains(name)), "{names:?} are not all in the list");
    let missing: Vec<_> = names.into_iter().filter(|name| !path(name).is_file()).collect();
    match missing.is_empty() {
        true => test(names.map(path)),
        false => record(&missing),
    }
}

/// The file in which a run of `cargo test` records what it leaves out: a line a clip or a
/// program that was missing: test program, test, what it is called.
///
/// Runs are told apart by the process of cargo, which starts all test programs.
pub(crate) fn records() -> PathBuf {
    #[cfg(unix)]
    let run = std::os::unix::process::parent_id();
    #[cfg(not(unix))]
    let run = 0;
    built().join(format!("left-out-{run}.txt"))
}

/// The folder of a profile, such as `target/debug`. Test programs lie in a folder of it.
pub(crate) fn built() -> PathBuf {
    let program = env::current_exe().expect("a test program knows where it is");
    program.ancestors().nth(2).expect("it lies in target/debug/deps").to_owned()
}

/// Records that the running test went without a program, or gave up a part for want of one.
pub(crate) fn without(program: &'static str) {
    record(&[program]);
}

fn record(missing: &[&str]) {
    let program = env::current_exe().expect("a test program knows where it is");
    let program = program.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    // Cargo puts a hash behind the name.
    let program = program.rsplit_once('-').map_or(&program[..], |(name, _)| name);
    let test = thread::current().name().unwrap_or("?").to_owned();
    let lines: String = missing.iter().map(|what| format!("{program} {test} {what}\n")).collect();
    let mut file = OpenOptions::new()
        .create(true)
        .append(true)
        .open(records())
        .expect("the folder of the build can be written");
    // In one write, for tests run side by side.
    file.write_all(lines.as_bytes()).expect("the folder of the build can be written");
}

/// The bytes of a clip.
pub(crate) fn bytes(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The name of a clip.
pub(crate) fn name(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
