//! Finds what omission did to the drawings of a sheet.

use crate::canvas::Canvas;
use crate::legend::Entry;
use crate::paper_point::Point;
use crate::style;
use genga::sheet::{Drawing, Layer, Role};

/// The fate of a drawing of the sheet before omission.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fate {
    Stays,
    /// Left out by naka-nashi.
    LeftOut,
    /// Replaced by a hold, by koma-dori.
    Held,
    /// Replaced by a hold that a person set.
    HeldByHand,
}

/// Legend entry of drawings under a hold that a person set.
pub(crate) const BY_HAND: Entry =
    ("held by hand 手動の止め", |canvas, at| held_by_hand(canvas, at, 3.25));

/// Draws the sign of a drawing under a hold that a person set: filled, as the number of a pinned genga is.
pub(crate) fn held_by_hand(canvas: &mut Canvas, at: Point, radius: f64) {
    canvas.disc(at, radius, style::FAINT);
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
/// drawings missing after one that stays, the first `held_for` were held, by hand if a person set how long it
/// stays and else by koma-dori. The others were left out by naka-nashi.
pub(crate) fn fates(before: &Layer, now: &Layer) -> Vec<Fate> {
    let mut left = now.drawings.iter().peekable();
    let (mut held, mut by) = (0, Fate::Held);
    let fate = |drawing: &Drawing| {
        let place = drawing.source.place();
        while left.next_if(|next| next.source.place() < place - 1e-6).is_some() {}
        if let Some(same) = left.next_if(|next| next.source.place() <= place + 1e-6) {
            held = same.why.held_for;
            by = if same.why.hold_set { Fate::HeldByHand } else { Fate::Held };
            Fate::Stays
        } else if held > 0 {
            held -= 1;
            by
        } else {
            Fate::LeftOut
        }
    };
    before.drawings.iter().map(fate).collect()
}
