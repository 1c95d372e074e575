//! The actions of a take, as a table.

use crate::{csv_table, number};
use genga::error::Error;
use genga::keys::Actions;
use genga::time::FrameRate;

/// Writes `action,file,from_frame,past_frame,seconds,why`, one row per action. Actions count from 1. Frames count
/// from 0, as in the take's own file; `past_frame` is the one after the last. `why` is empty for the first.
/// `files` holds the name of each action's own file.
///
/// # Errors
/// Fails only if memory runs out.
pub fn actions_csv(actions: &Actions, rate: FrameRate, files: &[String]) -> Result<String, Error> {
    let rows = actions.iter().zip(files).enumerate().map(|(at, (action, file))| {
        let frames = action.past.0 - action.from.0;
        [
            (at + 1).to_string(),
            file.clone(),
            action.from.to_string(),
            action.past.to_string(),
            number(frames as f64 / rate.fps()),
            action.why.map_or("", |why| why.word()).into(),
        ]
    });
    csv_table(&["action", "file", "from_frame", "past_frame", "seconds", "why"], rows)
}
