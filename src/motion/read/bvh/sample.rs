//! BVH texts and clips for tests.

use std::fs;
use std::path::PathBuf;

/// A small file: Hips with six channels, Spine with three, and the rows given.
pub(crate) fn text(frame_time: &str, rows: &[&str]) -> String {
    let frames = rows.len();
    let rows = rows.join("\n");
    format!("{HIERARCHY}MOTION\nFrames: {frames}\nFrame Time: {frame_time}\n{rows}\n")
}

/// Its hierarchy.
pub(crate) const HIERARCHY: &str = "\
HIERARCHY
ROOT Hips
{
\tOFFSET 0 1 0
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Spine
\t{
\t\tOFFSET 0 2 0
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0 3 0
\t\t}
\t}
}
";

/// A row of the small file.
pub(crate) const ROW: &str = "0 1 0 10 20 30 40 50 60";

/// The names and bytes of the real clips, sorted by name; none when the folder is not there, which
/// is an error in CI.
#[expect(clippy::print_stderr, reason = "a test says what it left out")]
pub(crate) fn real_clips() -> Vec<(String, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data/bvh");
    let Ok(entries) = fs::read_dir(&folder) else {
        let missing =
            format!("NO REAL CLIPS: {} is not there, nothing was tested", folder.display());
        assert!(std::env::var_os("CI").is_none(), "{missing}");
        eprintln!("{missing}");
        return Vec::new();
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "bvh"));
    paths.sort();
    let name = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
    paths.iter().map(|path| (name(path), fs::read(path).unwrap())).collect()
}
