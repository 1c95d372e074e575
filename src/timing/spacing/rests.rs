//! Rests (止め) on the sheet: where the drawing on screen holds.

use std::ops::RangeInclusive;

use crate::time::{Clock, Frame};
use crate::timing::on::Pace;

/// The rests of a layer in koma, and how far the body may go in them.
pub(super) struct Rests<'a> {
    koma: Vec<RangeInclusive<usize>>,
    /// In % of body height; 0 where nothing is held.
    drift: f64,
    pace: &'a Pace<'a>,
}

impl<'a> Rests<'a> {
    pub(super) fn of(
        frames: &[RangeInclusive<Frame>],
        clock: Clock,
        drift: f64,
        pace: &'a Pace<'a>,
    ) -> Self {
        let koma = |frame: &Frame| clock.koma_from_frame(*frame);
        let koma = frames.iter().map(|rest| koma(rest.start())..=koma(rest.end())).collect();
        Self { koma, drift, pace }
    }

    /// Whether a koma is inside of a rest and shows nothing that its begin does not.
    pub(super) fn cover(&self, koma: usize) -> bool {
        let is_within = |rest: &&RangeInclusive<usize>| *rest.start() < koma && koma < *rest.end();
        let mut rests = self.koma.iter().filter(is_within);
        rests.any(|rest| self.pace.apart(*rest.start(), koma) < self.drift)
    }

    /// Whether what a koma shows holds up to another in a rest: the body is hardly elsewhere there.
    pub(super) fn hold(&self, shown: usize, koma: usize) -> bool {
        let is_in = |rest: &RangeInclusive<usize>| *rest.start() < koma && rest.contains(&koma);
        self.koma.iter().any(is_in) && self.pace.apart(shown, koma) < self.drift
    }

    /// Of the koma between two stations those at which something new is to be seen.
    pub(super) fn what_moves(&self, from: usize, koma: &[usize]) -> Vec<usize> {
        let mut shown = from;
        let mut kept = Vec::with_capacity(koma.len());
        for &koma in koma {
            if !self.hold(shown, koma) {
                kept.push(koma);
                shown = koma;
            }
        }
        kept
    }
}
