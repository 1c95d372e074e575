//! Says if a run is of another part of a take than the run before it: a recipe holds no `--trim`.

use std::fs;
use std::path::Path;

use genga::motion::Clip;
use serde::Deserialize;

/// What is read of a sheet.
#[derive(Deserialize)]
struct Made {
    clip: Part,
}

#[derive(Deserialize)]
struct Part {
    first_frame: usize,
    frames: usize,
}

/// Compares the frames of a clip with those of the sheet in a folder. `None` if they are the same, or if there is no
/// sheet.
pub(super) fn other(folder: &Path, clip: &Clip) -> Option<String> {
    let path = folder.join("sheet.json");
    let Made { clip: before } = serde_json::from_slice(&fs::read(&path).ok()?).ok()?;
    let was = (before.first_frame, before.first_frame + before.frames);
    let is = (clip.first().0, clip.first().0 + clip.len());
    let last = |(from, past): (usize, usize)| format!("{from} to {}", past.saturating_sub(1));
    (was != is).then(|| {
        format!(
            "{} was of frames {}, and this run is of {}; a recipe holds no part of a take: --trim {}..{} runs that part again",
            path.display(), last(was), last(is), was.0, was.1
        )
    })
}
