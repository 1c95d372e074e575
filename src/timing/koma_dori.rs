//! Koma-dori (コマ撮り): holding a drawing instead of showing a small movement (KKMFT §3.3,
//! Algorithm 2).

use crate::timing::report::Shortfall;
use crate::timing::strip::{Cell, Strip};
use crate::timing::tournament::{OUT, Tournament};

/// What the stage did.
#[derive(Default)]
pub(super) struct Replaced {
    /// Drawings that are gone, in the order they went.
    pub(super) gone: Vec<usize>,
    pub(super) shortfall: Option<Shortfall>,
}

/// Replaces `count` drawings by the one before them, the smallest movements first.
pub(super) fn run(count: usize, strip: &mut Strip<'_>) -> Replaced {
    let mut replaced = Replaced::default();
    let mut refused = false;
    if count == 0 {
        return replaced;
    }
    let mut smallest = Tournament::new(strip.cells.iter().map(smallness));
    while replaced.gone.len() < count {
        let Some((drawing, _)) = smallest.best() else {
            replaced.shortfall = Some(why_not_more(strip, refused));
            break;
        };
        smallest.set(drawing, OUT);
        let Cell { before, after, koma, .. } = strip.cells[drawing];
        // For good: the one before only grows, and so does what stands before it.
        if strip.cells[before].koma + koma > strip.bound {
            refused = true;
            continue;
        }
        strip.cells[before].koma += strip.remove(drawing);
        strip.cells[before].held_for += 1;
        replaced.gone.push(drawing);
        smallest.set(before, OUT);
        smallest.set(after, smallness(&strip.cells[after]));
    }
    replaced
}

/// `refused`: whether a hold would have grown too long.
fn why_not_more(strip: &Strip<'_>, refused: bool) -> Shortfall {
    match strip.cells.iter().any(|cell| cell.koma > 0 && !cell.kept) {
        false => Shortfall::NoneLeft,
        true if refused => Shortfall::NoRoom,
        true => Shortfall::AllHolds,
    }
}

/// SSD to the drawing before. Kept drawings stay, and replacing one that is itself held longer would
/// only shift the hold.
fn smallness(cell: &Cell) -> f64 {
    let out = cell.kept || cell.koma == 0 || cell.given > 0 || cell.held_for > 0;
    if out { OUT } else { cell.step }
}
