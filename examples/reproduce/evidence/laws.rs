//! Checks what must never happen on any clip: lost genga, false holds, drawings of a lead-in.

use genga::motion::bvh;

use crate::Outcome;
use crate::table::Table;
use crate::takes::{Run, Take, kept};

/// A table with one row per clip; every count must be 0.
pub(crate) fn table(takes: &[Take]) -> Outcome<String> {
    let mut table = Table::new(&[
        "clip",
        ">genga and ends before omission",
        ">lost or replaced",
        ">moved",
        ">koma of limited.bvh that are not the sheet's",
        ">drawings from a lead-in",
    ]);
    for take in takes {
        let run = take.default();
        let (before, after) = (kept(&run.spaced), kept(&run.sheet));
        // A genga is the same if its role and its source frame are.
        let same = |place: f64, role| {
            after.iter().find(|shown| shown.place == place && shown.role == role)
        };
        let found: Vec<_> =
            before.iter().filter_map(|old| Some((old, same(old.place, old.role)?))).collect();
        let moved = found.iter().filter(|(old, new)| old.koma != new.koma).count();
        table.row(&[
            take.name.clone(),
            before.len().to_string(),
            (before.len() - found.len()).to_string(),
            moved.to_string(),
            disagreements(take, run)?.to_string(),
            from_lead_in(take, run).to_string(),
        ]);
    }
    Ok(table.text())
}

/// Number of koma at which the written motion, read back, repeats its row while the sheet does not hold, or the other
/// way round, plus the difference in length.
fn disagreements(take: &Take, run: &Run) -> Outcome<usize> {
    let back = bvh::read(run.limited_bvh.as_bytes())
        .map_err(|error| format!("{}: limited.bvh: {error}", take.name))?
        .clip;
    let drawings: Vec<usize> = run.sheet.layers[0].koma().collect();
    let rows: Vec<&[f64]> = back.rows().collect();
    let repeats = rows.windows(2).map(|pair| pair[0] == pair[1]);
    let holds = drawings.windows(2).map(|pair| pair[0] == pair[1]);
    let wrong = repeats.zip(holds).filter(|(repeats, holds)| repeats != holds).count();
    Ok(wrong + rows.len().abs_diff(drawings.len()))
}

/// Number of drawings, kept or left out by naka-nashi, that come from frames before the motion.
fn from_lead_in(take: &Take, run: &Run) -> usize {
    let first = take.clip.first().0 as f64;
    let shown = run.sheet.layers[0].drawings.iter().map(|drawing| drawing.source.place());
    shown.chain(run.omitted.iter().copied()).filter(|place| *place < first).count()
}
