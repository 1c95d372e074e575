//! The turn of a body (全身の変わり目) [KT11 §2, §3.1 to §3.4]: how much all of it turns at each frame.
//!
//! The first paper finds turns joint by joint. A drawing is of the whole body, so the same pattern is asked of all that
//! turns and travels together: the velocity of each is smoothed, and where its size is less than a moment before and after
//! it turns. Added up by weight that is one number a frame, and its peaks are the turns of the body.

mod crispness;
mod pattern;
#[cfg(test)]
mod tests;
mod tracks;

use crate::keys::chords::INSTANTS;
use crate::keys::postures::Postures;
use crate::keys::{Reference, Wall};
use crate::motion::lanes::wide;
use crate::motion::{Build, Clip};
use crate::signal::{LowPass, TurnFinder};
use crate::time::Frame;

pub(crate) use crispness::drawn;
use pattern::{LEAST, Pattern, largest_near, summits};
pub(crate) use tracks::{LayerMotion, Tracks};

/// By how much a body has to slow down and speed up for half a turn, in % of its height a second: so much trembles.
const TREMBLE: f64 = 2.0;

/// When a body turns, and when it stops accelerating (壁).
#[derive(Debug, Clone, PartialEq)]
pub struct BodyTurns {
    /// The clip's first frame.
    pub first: Frame,
    /// How much of a turn each frame is, 0 to 1.
    pub evidence: Vec<f64>,
    /// The turns by frame, none nearer to another than a koma.
    pub turns: Vec<Frame>,
    /// The walls by frame, likewise; their strength is in % of body height a second.
    pub walls: Vec<Wall>,
}

impl BodyTurns {
    /// The turns of a clip whose `reference` says how high it is, from where it is seen and how long a koma is: the
    /// velocities are smoothed by `filter` and a turn is to last for the persistence of `finder` to each side, both as
    /// far as the clip is not drawn.
    ///
    /// ```
    /// use genga::keys::{BodyTurns, Reference};
    /// use genga::signal::{LowPass, TurnFinder};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let reference = Reference::of(&clip, clip.clock(24.0));
    /// let body = BodyTurns::of(&clip, &reference, &LowPass::default(), &TurnFinder::default());
    /// assert_eq!(body.turns[0].0, 3, "the first frame at which the body turns");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn of(clip: &Clip, reference: &Reference, filter: &LowPass, finder: &TurnFinder) -> Self {
        let (build, own) = (Build::of(clip), vec![1.0; clip.skeleton().len()]);
        let clock = clip.clock(INSTANTS as f64 * reference.clock().koma_rate);
        let look = (reference.screen(), reference.height());
        let postures = Postures::of(clip, &build, clock, look, &own);
        let motion = LayerMotion {
            clip,
            build: &build,
            heard: &own,
            judged: &own,
            screen: reference.screen(),
            height: reference.height(),
            acting: postures.acting(),
        };
        let tracks = Tracks::of(&motion);
        let drawn = finder.drawn.share(drawn(tracks.crispness()));
        let (filter, persistence) = finder.of_body(filter, drawn, clip.rate());
        BodySpeeds::of(&tracks, &filter).turns(persistence, reference.clock().frames_in_koma())
    }
}

/// The speeds of all that turns and travels in a layer, smoothed: another persistence needs no new ones.
#[derive(Debug, Clone)]
pub(crate) struct BodySpeeds(Pattern);

impl BodySpeeds {
    /// Smooths them.
    pub(crate) fn of(tracks: &Tracks, filter: &LowPass) -> Self {
        Self::over(None, tracks, filter)
    }

    /// The same in the place of others.
    pub(crate) fn over(last: Option<Self>, tracks: &Tracks, filter: &LowPass) -> Self {
        let room = last.map_or_else(Vec::new, |Self(last)| last.into_speeds());
        Self(Pattern::of(tracks, filter, room))
    }

    /// The turns that last for `persistence` frames to each side, `apart` frames from each other at the least.
    pub(crate) fn turns(&self, persistence: f64, apart: f64) -> BodyTurns {
        let (valleys, hills) = wide(
            #[inline(always)]
            || self.0.bends(persistence),
        );
        let reach = (persistence.round() as usize).min(valleys.len());
        let near = largest_near(&valleys, reach);
        let evidence = valleys.iter().zip(&near).map(|(own, near)| evidence(*own, *near));
        let first = self.0.first();
        let frame = |row: usize| Frame(first.0 + row);
        // Where somebody cut the clip it has drawings anyway.
        let inner = |(row, _): &(usize, f64)| (1..valleys.len() - 1).contains(row);
        let turns = summits(&valleys, apart).into_iter().filter(inner).map(|(row, _)| frame(row));
        let walls = summits(&hills, apart).into_iter().filter(inner);
        BodyTurns {
            first,
            turns: turns.collect(),
            walls: walls.map(|(row, strength)| Wall { frame: frame(row), strength }).collect(),
            evidence: evidence.collect(),
        }
    }
}

/// How much of a turn a frame is whose bend is `own`, where the largest about it is `near`.
fn evidence(own: f64, near: f64) -> f64 {
    if near >= LEAST { (own / near).powi(2) * own / (own + TREMBLE) } else { 0.0 }
}
