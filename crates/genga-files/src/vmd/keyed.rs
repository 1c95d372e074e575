//! Keys at the genga with MMD's own curves (補間曲線) between them.

mod ease;
mod legs;
mod motion;
mod span;

use super::record::VmdKey;
use crate::humanoid::retarget::Retarget;
use genga::motion::Clip;
pub(super) use legs::IkLegs;
use motion::Motion;
use span::Span;

/// A motion with keys on some frames.
pub(super) struct KeyedMotion {
    /// Keys of all bones, by frame.
    pub(super) keys: Vec<VmdKey>,
    /// Number of frames with keys.
    pub(super) frames: usize,
    /// Number of those that are no genga.
    pub(super) added: usize,
    /// Largest distance from the take with the genga alone, as a share of body height.
    pub(super) error_of_genga: f64,
    /// Largest distance of a knee from the take on account of its IK, as a share of body height.
    pub(super) error_of_knees: f64,
}

/// Keys a motion on the frames of its genga, and adds frames until no bone is off the take by more than `error` of
/// body height. `retarget` has a drawing on every frame.
pub(super) fn keyed(
    clip: &Clip,
    (retarget, legs): (&mut Retarget<'_>, &IkLegs<'_>),
    (genga, length): (&[u32], usize),
    error: f64,
) -> KeyedMotion {
    let motion = Motion::new(clip, retarget, legs, length);
    let mut frames = genga.to_vec();
    let mut error_of_genga = 0.0;
    let mut open: Vec<[usize; 2]> =
        genga.windows(2).map(|ends| [ends[0] as usize, ends[1] as usize]).collect();
    // A curve ends at its keys, so a new key changes no other span.
    for at in 0.. {
        let Some(ends) = open.get(at).copied() else { break };
        let (frame, off) = Span::new(&motion, ends).worst(&motion);
        if at + 1 < genga.len() {
            error_of_genga = f64::max(error_of_genga, off);
        }
        if off > error {
            frames.push(frame as u32);
            open.extend([[ends[0], frame], [frame, ends[1]]]);
        }
    }
    frames.sort_unstable();
    KeyedMotion {
        keys: motion.keys(&frames),
        frames: frames.len(),
        added: frames.len() - genga.len(),
        error_of_genga,
        error_of_knees: motion.error_of_knees,
    }
}
