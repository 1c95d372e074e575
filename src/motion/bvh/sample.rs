//! BVH texts and clips for tests. Included by path in the tests of other packages.

#![allow(dead_code, reason = "no test program needs all of it")]

use crate::real;

/// A small file: Hips with six channels, Spine with three, and the given rows.
pub(crate) fn text(frame_time: &str, rows: &[&str]) -> String {
    let frames = rows.len();
    let rows = rows.join("\n");
    format!("{HIERARCHY}MOTION\nFrames: {frames}\nFrame Time: {frame_time}\n{rows}\n")
}

/// The hierarchy of the small file.
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

/// The names and bytes of the available real clips, sorted by name.
pub(crate) fn real_clips() -> Vec<(String, Vec<u8>)> {
    real::all().iter().map(|path| (real::name(path), real::bytes(path))).collect()
}
