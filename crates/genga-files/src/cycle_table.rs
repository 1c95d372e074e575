//! The table of a take's cycles.

use crate::{csv_table, number};
use genga::error::Error;
use genga::keys::Cycle;
use genga::time::FrameRate;

/// Writes `cycle,file,from_frame,to_frame,koma,pose,speed`, one row per cycle, the closest first. Cycles count from 1.
/// Frames count from 0, as in the take's own file; `to_frame` shows the pose of `from_frame` again. `koma` is the time
/// between them. `pose` and `speed` say how far the two are apart, in % of body height and in % of it a second.
/// `files` holds the name of each cycle's own file.
///
/// # Errors
/// Fails only if memory runs out.
pub fn cycles_csv(cycles: &[Cycle], rate: FrameRate, files: &[String]) -> Result<String, Error> {
    let rows = cycles.iter().zip(files).enumerate().map(|(at, (cycle, file))| {
        [
            (at + 1).to_string(),
            file.clone(),
            cycle.first.to_string(),
            cycle.last.to_string(),
            number(cycle.koma(rate)),
            number(cycle.pose),
            number(cycle.speed),
        ]
    });
    csv_table(&["cycle", "file", "from_frame", "to_frame", "koma", "pose", "speed"], rows)
}
