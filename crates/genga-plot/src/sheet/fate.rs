//! Finds what omission did to the drawings of a sheet.

use genga::sheet::{Drawing, Layer, Role};

/// The fate of a drawing of the sheet before omission.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fate {
    Stays,
    /// Left out by naka-nashi.
    LeftOut,
    /// Replaced by a hold, by koma-dori.
    Held,
}

/// Returns koma, role and fate of each drawing that a layer had before omission.
pub(super) fn row_before(before: &Layer, now: &Layer) -> Vec<(usize, Role, Fate)> {
    let fates = fates(before, now);
    before
        .timed()
        .map(|(koma, shown)| (koma, before.drawings[shown.drawing].role, fates[shown.drawing]))
        .collect()
}

/// Returns the fate of each drawing. Drawings at the same place in the source count as the same. Of the
/// drawings missing after one that stays, the first `held_for` were held by koma-dori, the others left out by
/// naka-nashi.
pub(crate) fn fates(before: &Layer, now: &Layer) -> Vec<Fate> {
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
