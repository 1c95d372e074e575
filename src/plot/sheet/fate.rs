//! What omission did to the drawings of a sheet.

use crate::sheet::{Drawing, Layer, Role};

/// What became of a drawing of the sheet before omission.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plot) enum Fate {
    Stays,
    /// By naka-nashi.
    LeftOut,
    /// By koma-dori.
    Held,
}

/// Koma, role and fate of the drawings that a layer had before omission.
pub(super) fn row_before(before: &Layer, now: &Layer) -> Vec<(usize, Role, Fate)> {
    let fates = fates(before, now);
    before
        .timed()
        .map(|(koma, shown)| (koma, before.drawings[shown.drawing].role, fates[shown.drawing]))
        .collect()
}

/// What became of each drawing: those of the same place in the source are the same. Of those missing
/// after a drawing, as many as it is held for went by koma-dori, the others by naka-nashi.
pub(in crate::plot) fn fates(before: &Layer, now: &Layer) -> Vec<Fate> {
    let mut left = now.drawings.iter().peekable();
    let mut held = 0;
    let fate = |drawing: &Drawing| {
        let place = drawing.source.place();
        while left.next_if(|next| next.source.place() < place - 1e-6).is_some() {}
        if let Some(same) = left.next_if(|next| next.source.place() <= place + 1e-6) {
            held = same.why.held_for;
            Fate::Stays
        } else if held > 0 {
            held -= 1;
            Fate::Held
        } else {
            Fate::LeftOut
        }
    };
    before.drawings.iter().map(fate).collect()
}
