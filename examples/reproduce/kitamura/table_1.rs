//! Table 1: what was asked of the four actions, and what was done.

use genga::time::KOMA_RATE;

use crate::part::Part;
use crate::table::Table;
use crate::{Outcome, samples, windows};

/// A row of the paper.
pub(super) struct Action {
    /// The sample that stands for the capture.
    pub(super) sample: &'static str,
    /// The paper's name.
    pub(super) name: &'static str,
    pub(super) koma: usize,
    pub(super) naka_nashi: usize,
    pub(super) koma_dori: usize,
    pub(super) milliseconds: usize,
}

/// The four rows.
pub(super) const ACTIONS: [Action; 4] = [
    row("pitch", "Pitch", [129, 4, 33, 69]),
    row("kick", "Kick", [92, 4, 30, 28]),
    row("tennis", "Tennis", [88, 4, 29, 27]),
    row("swing", "Baseball swing", [120, 6, 40, 63]),
];

const fn row(sample: &'static str, name: &'static str, figures: [usize; 4]) -> Action {
    let [koma, naka_nashi, koma_dori, milliseconds] = figures;
    Action { sample, name, koma, naka_nashi, koma_dori, milliseconds }
}

/// The table.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let header = ["action", ">koma", ">N_io done/asked", ">N_hf done/asked", ">paper's time, ms"];
    let mut table = Table::new(&header);
    for action in ACTIONS {
        let clip = samples::clip(action.sample)?;
        let length = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
        if length != action.koma {
            let (sample, koma) = (action.sample, action.koma);
            return Err(format!("{sample} has {length} koma, the paper's action has {koma}").into());
        }
        let done = windows::omit(&clip, action.naka_nashi, action.koma_dori)?;
        table.row(&[
            action.name.into(),
            action.koma.to_string(),
            format!("{}/{}", done.naka_nashi[0], done.naka_nashi[1]),
            format!("{}/{}", done.koma_dori[0], done.koma_dori[1]),
            action.milliseconds.to_string(),
        ]);
    }
    part.table("table-1-omission", table);
    Ok(())
}
