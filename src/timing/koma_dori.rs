//! Koma-dori (コマ撮り): holding a drawing in place of a small movement (KKMFT §3.3, Algorithm 2).

use crate::timing::drawing_list::{Link, Strip};
use crate::timing::report::Shortfall;
use crate::timing::tournament::{OUT, Tournament};

/// The result of the stage.
#[derive(Default)]
pub(super) struct Replaced {
    /// The removed drawings, in the order they went.
    pub(super) gone: Vec<usize>,
    pub(super) shortfall: Option<Shortfall>,
}

/// Replaces `count` of some drawings by the one before them, the smallest movements first; none with an SSD above
/// `small`.
pub(super) fn run(
    count: usize,
    small: f64,
    has: impl Fn(usize) -> bool,
    strip: &mut Strip<'_>,
) -> Replaced {
    let mut replaced = Replaced::default();
    let mut refused = false;
    if count == 0 {
        return replaced;
    }
    let own = |at: usize, link: &Link| if has(at) { smallness(link) } else { OUT };
    let mut smallest =
        Tournament::new(strip.links.iter().enumerate().map(|(at, link)| own(at, link)));
    while replaced.gone.len() < count {
        let Some((drawing, step)) = smallest.best() else {
            replaced.shortfall = Some(why_not_more(strip, &has, refused));
            break;
        };
        if step > small {
            replaced.shortfall = Some(Shortfall::NoneSmall);
            break;
        }
        smallest.set(drawing, OUT);
        let Link { before, after, koma, .. } = strip.links[drawing];
        // The refusal is final: the drawing before only grows, and so does the distance to it.
        if strip.links[before].koma + koma > strip.links[before].bound {
            refused = true;
            continue;
        }
        strip.links[before].koma += strip.remove(drawing);
        strip.links[before].held_for += 1;
        replaced.gone.push(drawing);
        smallest.set(before, OUT);
        smallest.set(after, own(after, &strip.links[after]));
    }
    replaced
}

/// Explains why no more were replaced; `refused` says whether a hold would have grown too long.
fn why_not_more(strip: &Strip<'_>, has: impl Fn(usize) -> bool, refused: bool) -> Shortfall {
    match strip.inbetweens(&has) > 0 {
        false => strip.none_left(has),
        true if refused => Shortfall::NoRoom,
        true => Shortfall::AllHolds,
    }
}

/// Returns the SSD to the drawing before. Kept drawings stay, and replacing one that is itself held longer would only
/// shift the hold.
fn smallness(link: &Link) -> f64 {
    let out = link.kept || link.koma == 0 || link.given > 0 || link.held_for > 0;
    if out { OUT } else { link.step }
}
