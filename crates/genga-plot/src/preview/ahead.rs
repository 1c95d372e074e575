//! Draws koma on all cores, a few ahead of the one that is shown, while a GIF or a film is packed.

use std::sync::mpsc;
use std::thread;

use rayon::prelude::*;

use super::scene::{Cast, Moment, Scene};
use crate::pixels::Pixels;
use genga::error::Error;

/// Number of pictures for each core that are drawn at once: enough to keep it busy, and little memory.
const FOR_A_CORE: usize = 4;

/// Draws all koma of a scene and passes them to `show`, in order.
///
/// # Errors
/// Any error of `show`.
pub(super) fn play(
    scene: &Scene,
    mut cast: Cast<'_>,
    mut show: impl FnMut(usize, &Pixels) -> Result<(), Error>,
) -> Result<(), Error> {
    let at_once = (FOR_A_CORE * rayon::current_num_threads()).min(scene.koma);
    // Pictures that have been shown are drawn on again.
    let (give, drawn) = mpsc::sync_channel::<Vec<Pixels>>(1);
    let (give_back, shown) = mpsc::channel::<Vec<Pixels>>();
    let begins = || (0..scene.koma).step_by(at_once.max(1));
    let koma = |begin: usize| begin..scene.koma.min(begin + at_once);
    thread::scope(|scope| {
        scope.spawn(move || {
            for begin in begins() {
                let moments: Vec<Moment> = koma(begin).map(|koma| cast.at(koma)).collect();
                let fresh = || vec![scene.backdrop().clone(); at_once];
                let mut pictures = shown.try_recv().unwrap_or_else(|_| fresh());
                let pairs = pictures.par_iter_mut().zip(&moments);
                pairs.for_each(|(pixels, moment)| scene.draw(moment, pixels));
                if give.send(pictures).is_err() {
                    // Nobody looks any more.
                    return;
                }
            }
        });
        for (begin, pictures) in begins().zip(drawn) {
            koma(begin).zip(&pictures).try_for_each(|(koma, pixels)| show(koma, pixels))?;
            // The last ones come back when nothing is drawn any more.
            let _ = give_back.send(pictures);
        }
        Ok(())
    })
}
