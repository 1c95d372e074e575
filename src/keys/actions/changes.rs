//! Changes (動きの変化): moments at which other parts of the body take over the movement.

use std::ops::RangeInclusive;

use crate::keys::Chords;
use crate::maths;

/// Seconds before and after a moment whose movements are compared.
const WINDOW: f64 = 1.5;

/// Seconds around a change in which no other is larger.
const APART: f64 = 0.5;

/// Speed of a resting body, in % of body height a second: a side with no more movement says little.
const REST: f64 = 15.0;

/// Columns of a posture that form one part: a point's three coordinates.
const PART: usize = 3;

/// Finds the instants at which the movement changes most, by time, each with the size of the change: see
/// [`Movement::change`]. Instants in sight of a rest are left out: the rest already separates before from after.
pub(super) fn changes(chords: &Chords, rests: &[RangeInclusive<usize>]) -> Vec<(usize, f64)> {
    let per_second = chords.clock().koma_rate;
    let movement = Movement::new(chords);
    let window = (WINDOW * per_second).round() as usize;
    let changes: Vec<f64> =
        (0..chords.len()).map(|instant| movement.change(instant, window)).collect();
    let apart = (APART * per_second).round() as usize;
    let is_most = |at: usize| {
        let near = &changes[at.saturating_sub(apart)..(at + apart + 1).min(changes.len())];
        changes[at] > 0.0 && near.iter().all(|other| *other <= changes[at])
    };
    let is_in_sight = |at: usize| {
        let sees = |rest: &RangeInclusive<usize>| {
            rest.start().saturating_sub(window) <= at && at <= rest.end() + window
        };
        rests.iter().any(sees)
    };
    let found = (0..changes.len()).filter(|at| is_most(*at) && !is_in_sight(*at));
    found.map(|at| (at, changes[at])).collect()
}

/// The movement of each part of the body.
struct Movement {
    parts: usize,
    /// Instants × parts: the squared steps summed up to the one into each instant.
    sums: Vec<f64>,
    /// Movement of a resting body in an instant.
    rest: f64,
}

impl Movement {
    fn new(chords: &Chords) -> Self {
        let (postures, per_second) = (chords.postures(), chords.clock().koma_rate);
        let parts = if postures.len() == 0 { 0 } else { postures.row(0).chunks(PART).count() };
        let mut sums = vec![0.0; parts * postures.len()];
        for instant in 1..postures.len() {
            let before = postures.row(instant - 1).chunks(PART);
            let ways = postures.row(instant).chunks(PART).zip(before).map(|(now, before)| {
                now.iter().zip(before).map(|(now, before)| (now - before).powi(2)).sum::<f64>()
            });
            for (part, way) in ways.enumerate() {
                let at = instant * parts + part;
                sums[at] = sums[at - parts] + way;
            }
        }
        Self { parts, sums, rest: (REST / per_second).powi(2) }
    }

    /// Returns −ln of a product of two shares: the share of the movement before that goes on in the same parts of the
    /// body, and the share of the movement after that was there before. It is ln 4 if half goes and half is new, and
    /// less if either side moves little.
    fn change(&self, instant: usize, window: usize) -> f64 {
        let last = self.sums.len() / self.parts.max(1) - 1;
        let (from, past) = (instant.saturating_sub(window), (instant + window).min(last));
        let before = || self.between(from, instant);
        let after = || self.between(instant, past);
        let (all_before, all_after): (f64, f64) = (before().sum(), after().sum());
        let less = all_before.min(all_after);
        if less <= 0.0 {
            return 0.0;
        }
        let shares = before().zip(after());
        let kept: f64 = shares.map(|(a, b)| (a / all_before).min(b / all_after)).sum();
        let word = less / (less + self.rest * window as f64);
        -2.0 * maths::ln((1.0 - word * (1.0 - kept.min(1.0))).max(f64::MIN_POSITIVE))
    }

    /// Returns the movement of each part between two instants.
    fn between(&self, from: usize, to: usize) -> impl Iterator<Item = f64> {
        let row = |instant: usize| &self.sums[instant * self.parts..(instant + 1) * self.parts];
        row(to).iter().zip(row(from)).map(|(to, from)| to - from)
    }
}
