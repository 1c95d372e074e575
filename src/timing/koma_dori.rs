//! Koma-dori (コマ撮り): holding a drawing instead of showing a small movement (KKMFT §3.3,
//! Algorithm 2).

use crate::timing::report::Shortfall;
use crate::timing::strip::{Link, Strip};
use crate::timing::tournament::{OUT, Tournament};

/// What the stage did.
#[derive(Default)]
pub(super) struct Replaced {
    /// Drawings that are gone, in the order they went.
    pub(super) gone: Vec<usize>,
    pub(super) shortfall: Option<Shortfall>,
}

/// Replaces `count` drawings by the one before them, the smallest movements first, none with an SSD above `small`.
pub(super) fn run(count: usize, small: f64, strip: &mut Strip<'_>) -> Replaced {
    let mut replaced = Replaced::default();
    let mut refused = false;
    if count == 0 {
        return replaced;
    }
    let mut smallest = Tournament::new(strip.links.iter().map(smallness));
    while replaced.gone.len() < count {
        let Some((drawing, step)) = smallest.best() else {
            replaced.shortfall = Some(why_not_more(strip, refused));
            break;
        };
        if step > small {
            replaced.shortfall = Some(Shortfall::NoneSmall);
            break;
        }
        smallest.set(drawing, OUT);
        let Link { before, after, koma, .. } = strip.links[drawing];
        // For good: the one before only grows, and so does what stands before it.
        if strip.links[before].koma + koma > strip.bound {
            refused = true;
            continue;
        }
        strip.links[before].koma += strip.remove(drawing);
        strip.links[before].held_for += 1;
        replaced.gone.push(drawing);
        smallest.set(before, OUT);
        smallest.set(after, smallness(&strip.links[after]));
    }
    replaced
}

/// `refused`: whether a hold would have grown too long.
fn why_not_more(strip: &Strip<'_>, refused: bool) -> Shortfall {
    match strip.links.iter().any(|link| link.koma > 0 && !link.kept) {
        false => Shortfall::NoneLeft,
        true if refused => Shortfall::NoRoom,
        true => Shortfall::AllHolds,
    }
}

/// SSD to the drawing before. Kept drawings stay, and replacing one that is itself held longer would
/// only shift the hold.
fn smallness(link: &Link) -> f64 {
    let out = link.kept || link.koma == 0 || link.given > 0 || link.held_for > 0;
    if out { OUT } else { link.step }
}
