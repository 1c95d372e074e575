//! Holds (止め): where the drawing on screen stays because the body hardly moves away from it.

use std::ops::RangeInclusive;

use crate::keys::Alike;
use crate::time::{Clock, Frame};
use crate::timing::ByPassage;
use crate::timing::koma_per_drawing::Pace;

/// Poses count as alike at most up to this share of the range of the take's poses: in some takes, breathing is the only
/// movement.
const OF_REACH: f64 = 1.0 / 8.0;

/// Poses closer than this are alike however little moves, in % of body height, unless a recipe says less.
const TREMBLE: f64 = 0.8;

/// Share of the drift that is hardly visible: within it the body has not set out yet, or has arrived.
const SLIGHT: f64 = 0.4;

/// Largest number of koma over which a pose is tested for holding: two seconds on film. Keys are not chosen beyond.
const FAR: usize = 48;

/// Computes which poses of a body are the same on the sheet; `drift` is the allowed difference in % of body height.
pub(crate) fn alike(pace: &Pace<'_>, drift: f64) -> Alike {
    let still = Still { rests: Vec::new(), drift: bounded(drift, pace).into(), pace };
    let last = |koma: usize| {
        let on_the_way = koma + 1..(koma + FAR).min(pace.koma());
        on_the_way
            .take_while(|on_the_way| still.are_alike(koma, *on_the_way))
            .last()
            .unwrap_or(koma)
    };
    Alike::from_last((0..pace.koma()).map(last).collect())
}

/// Bounds the drift by the range of the take's poses.
fn bounded(drift: f64, pace: &Pace<'_>) -> f64 {
    if drift > TREMBLE { drift.min((OF_REACH * pace.reach()).max(TREMBLE)) } else { drift }
}

/// The koma that look alike, and the rests of a layer.
pub(super) struct Still<'a> {
    /// The rests, in koma.
    rests: Vec<RangeInclusive<usize>>,
    /// The difference from which on two poses are distinct, in % of body height, on the koma of the later; 0 if nothing
    /// holds.
    drift: ByPassage<f64>,
    pace: &'a Pace<'a>,
}

impl<'a> Still<'a> {
    pub(super) fn new(
        rests: &[RangeInclusive<Frame>],
        clock: Clock,
        drift: ByPassage<f64>,
        pace: &'a Pace<'a>,
    ) -> Self {
        let koma = |frame: &Frame| clock.koma_from_frame(*frame);
        let rests = rests.iter().map(|rest| koma(rest.start())..=koma(rest.end())).collect();
        Self { rests, drift: drift.map(|drift| bounded(*drift, pace)), pace }
    }

    /// Whether a koma is inside a rest and shows nothing that its begin does not.
    pub(super) fn covers(&self, koma: usize) -> bool {
        let is_within = |rest: &&RangeInclusive<usize>| *rest.start() < koma && koma < *rest.end();
        let mut rests = self.rests.iter().filter(is_within);
        rests.any(|rest| self.are_alike(*rest.start(), koma))
    }

    /// Whether the pose of a koma holds up to a later one: the body stays close to it all the way.
    pub(super) fn holds(&self, shown: usize, koma: usize) -> bool {
        (shown + 1..=koma).all(|on_the_way| self.are_alike(shown, on_the_way))
    }

    /// Returns the koma, between two, on which the body sets out from the pose of `shown`; until then it hardly moves.
    pub(super) fn departure(&self, shown: usize, from: usize, to: usize) -> usize {
        let is_away = |koma: &usize| !self.are_alike(shown, *koma);
        let away = (from + 1..to).find(is_away).unwrap_or(to);
        let is_out = |koma: &usize| self.pace.unlike(shown, *koma) >= SLIGHT * self.drift.at(*koma);
        (from..away).rev().take_while(is_out).last().unwrap_or(away)
    }

    /// Returns the first koma after `from` at which the body has arrived at its pose of `to`.
    pub(super) fn arrival(&self, from: usize, to: usize) -> usize {
        let is_there = |koma: &usize| self.pace.unlike(*koma, to) < SLIGHT * self.drift.at(*koma);
        (from + 1..to).rev().take_while(is_there).last().unwrap_or(to)
    }

    /// Whether a rest ends on a koma or next to it.
    pub(super) fn ends_rest(&self, koma: usize) -> bool {
        self.rests.iter().any(|rest| *rest.start() + 1 < koma && koma.abs_diff(*rest.end()) <= 1)
    }

    /// Whether the whole time between two koma belongs to one rest; each may be one koma off its frame.
    pub(super) fn is_rest(&self, from: usize, to: usize) -> bool {
        self.rests.iter().any(|rest| *rest.start() <= from + 1 && to <= *rest.end() + 1)
    }

    /// Returns those of some koma at which something new is visible: it drops those in a rest that look like the
    /// drawing on screen. `shown` are the koma of the last two drawings on screen.
    pub(super) fn what_moves(&self, mut shown: [usize; 2], mut koma: Vec<usize>) -> Vec<usize> {
        koma.retain(|&koma| {
            let is_in = |rest: &RangeInclusive<usize>| *rest.start() < koma && koma < *rest.end();
            let moves = !self.rests.iter().any(is_in) || !self.stays(shown, koma);
            if moves {
                shown = [shown[1], koma];
            }
            moves
        });
        koma
    }

    /// Whether the body keeps the pose of `to` from `koma` on.
    pub(super) fn leads_to(&self, koma: usize, to: usize) -> bool {
        (koma..to).all(|on_the_way| self.are_alike(on_the_way, to))
    }

    /// Whether a drawing of a rest stays on screen on a later koma: the body is neither elsewhere nor back at its pose
    /// before that drawing. A gesture goes out and comes back, and may be hardly larger than the drift.
    fn stays(&self, [before, shown]: [usize; 2], koma: usize) -> bool {
        let [from_before, from_shown] = [before, shown].map(|own| self.pace.unlike(own, koma));
        let drift = *self.drift.at(koma);
        from_shown < drift && from_shown <= from_before + SLIGHT * drift
    }

    /// Whether the poses of two koma are nearly the same.
    fn are_alike(&self, a: usize, b: usize) -> bool {
        self.pace.unlike(a, b) < *self.drift.at(a.max(b))
    }
}
