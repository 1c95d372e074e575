//! Changes (動きの変化): moments at which other parts of the body take over the movement.

use std::ops::RangeInclusive;

use crate::keys::Chords;
use crate::maths;

/// Seconds before and after a moment over which the movement is laid side by side.
const WINDOW: f64 = 1.5;

/// Seconds within which a moment is where the movement changes most.
const APART: f64 = 0.5;

/// % of body height a second of a body that rests: a side with no more movement says little.
const REST: f64 = 15.0;

/// Columns of a posture that are one part: a point's three coordinates.
const PART: usize = 3;

/// The instants at which the movement changes most, by time, each with how much: see
/// [`Movement::change`]. None in sight of a rest: that parts what was before from what comes after.
pub(super) fn changes(chords: &Chords, rests: &[RangeInclusive<usize>]) -> Vec<(usize, f64)> {
    let per_second = chords.clock().koma_rate;
    let movement = Movement::of(chords);
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

/// How much each part of the body moves.
struct Movement {
    parts: usize,
    /// Instants × parts: the squared steps summed up to the one into each instant.
    sums: Vec<f64>,
    /// What a resting body adds in an instant.
    rest: f64,
}

impl Movement {
    fn of(chords: &Chords) -> Self {
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

    /// −ln of the share of the movement before that goes on in the same parts of the body, times the share
    /// of that after that was there before: ln 4 where half goes and half is new.
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

    /// How much each part moves from one instant to another.
    fn between(&self, from: usize, to: usize) -> impl Iterator<Item = f64> {
        let row = |instant: usize| &self.sums[instant * self.parts..(instant + 1) * self.parts];
        row(to).iter().zip(row(from)).map(|(to, from)| to - from)
    }
}
