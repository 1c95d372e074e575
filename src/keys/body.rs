//! Turns of the body (全身の変わり目) [KT11 §2, §3.1 to §3.4]: how much the whole body turns at each frame.
//!
//! The first paper finds turns joint by joint. A drawing shows the whole body, so the same pattern is looked for in all
//! rotations and movements together. Each velocity is smoothed; a dip of its speed, lower than a moment before and
//! after, is a turn. The weighted sum over all is one number a frame, and its peaks are the turns of the body.

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

/// Dip of the body's speed that is half a turn, in % of body height a second: the size of a tremble.
const TREMBLE: f64 = 2.0;

/// The turns of a body, and its walls (壁), where it stops accelerating.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyTurns {
    /// The clip's first frame.
    pub first: Frame,
    /// J: how much slower the body is at each frame than before and after it, in % of body height a second.
    pub dips: Vec<f64>,
    /// Strength of the turn at each frame, 0 to 1.
    pub evidence: Vec<f64>,
    /// Turns by frame, at least a koma apart.
    pub turns: Vec<Frame>,
    /// Walls by frame, at least a koma apart; their strength is in % of body height a second.
    pub walls: Vec<Wall>,
}

impl BodyTurns {
    /// Finds the turns of a clip. `reference` gives the body's height, the screen and the length of a koma. Velocities
    /// are smoothed by `filter`, and a turn must last for the persistence of `finder` on each side. Both shrink as far
    /// as the clip is drawn.
    ///
    /// ```
    /// use genga::keys::{BodyTurns, Reference};
    /// use genga::signal::{LowPass, TurnFinder};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let reference = Reference::new(&clip, clip.clock(24.0));
    /// let body = BodyTurns::new(&clip, &reference, &LowPass::default(), &TurnFinder::default());
    /// assert_eq!(body.turns[0].0, 3, "the first frame at which the body turns");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn new(clip: &Clip, reference: &Reference, filter: &LowPass, finder: &TurnFinder) -> Self {
        let (build, own) = (Build::new(clip), vec![1.0; clip.skeleton().len()]);
        let clock = clip.clock(INSTANTS as f64 * reference.clock().koma_rate);
        let look = (reference.screen(), reference.height());
        let postures = Postures::new(clip, &build, clock, look, &own);
        let motion = LayerMotion {
            clip,
            build: &build,
            heard: &own,
            judged: &own,
            screen: reference.screen(),
            height: reference.height(),
            acting: postures.acting(),
        };
        let tracks = Tracks::new(&motion);
        let drawn = finder.drawn.share(drawn(tracks.crispness()));
        let (filter, persistence) = finder.of_body(filter, drawn, clip.rate());
        BodySpeeds::new(&tracks, &filter).turns(persistence, reference.clock().frames_in_koma())
    }
}

/// The smoothed speeds of everything that turns or moves in a layer. Another persistence needs no new ones.
#[derive(Debug, Clone)]
pub(crate) struct BodySpeeds(Pattern);

impl BodySpeeds {
    /// Smooths the tracks.
    pub(crate) fn new(tracks: &Tracks, filter: &LowPass) -> Self {
        Self::over(None, tracks, filter)
    }

    /// Smooths the tracks into the memory of earlier speeds.
    pub(crate) fn over(last: Option<Self>, tracks: &Tracks, filter: &LowPass) -> Self {
        let room = last.map_or_else(Vec::new, |Self(last)| last.into_speeds());
        Self(Pattern::from_steps(tracks, filter, room))
    }

    /// Finds the turns that last for `persistence` frames on each side, at least `apart` frames from each other.
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
        // The ends of the clip have drawings anyway.
        let inner = |(row, _): &(usize, f64)| (1..valleys.len() - 1).contains(row);
        let turns = summits(&valleys, apart).into_iter().filter(inner).map(|(row, _)| frame(row));
        let walls = summits(&hills, apart).into_iter().filter(inner);
        BodyTurns {
            first,
            turns: turns.collect(),
            walls: walls.map(|(row, strength)| Wall { frame: frame(row), strength }).collect(),
            evidence: evidence.collect(),
            dips: valleys,
        }
    }
}

/// Returns the strength of the turn at a frame with the bend `own`, if the largest bend around it is `near`.
fn evidence(own: f64, near: f64) -> f64 {
    if near >= LEAST { (own / near).powi(2) * own / (own + TREMBLE) } else { 0.0 }
}
