//! The pattern of a turn: slower now than a moment before and after [KT11 §3.3].

use crate::keys::peaks::{peaks, strongest_apart};
use crate::motion::lanes::wide;
use crate::signal::LowPass;
use crate::time::Frame;

use super::tracks::Tracks;

/// Change of a bend below which it is rounding, in % of body height a second.
const DUST: f64 = 1e-9;

/// Least bend of a turn or wall, in % of body height a second: nobody sees less.
pub(super) const LEAST: f64 = 0.1;

/// The speeds of all tracks, searched for turns.
#[derive(Debug, Clone)]
pub(super) struct Pattern {
    first: Frame,
    frames: usize,
    /// Tracks × frames.
    speeds: Vec<f64>,
    /// One a track.
    weights: Vec<f64>,
}

impl Pattern {
    /// Smooths the steps and computes each track's speed at each frame. Reuses the memory of `room`.
    pub(super) fn from_steps(
        Tracks { steps, weights, .. }: &Tracks,
        filter: &LowPass,
        room: Vec<f64>,
    ) -> Self {
        let count = steps.frames();
        let mut speeds = room;
        speeds.clear();
        speeds.reserve_exact((count + 1) * weights.len());
        filter.each::<3>(steps, |track| {
            wide(
                #[inline(always)]
                || add_speeds(track, count, &mut speeds),
            );
        });
        let first = steps.unfiltered().first;
        Self { first, frames: count + 1, speeds, weights: weights.clone() }
    }

    /// Returns the speeds alone, for reuse of their memory.
    pub(super) fn into_speeds(self) -> Vec<f64> {
        self.speeds
    }

    /// Takes given speeds, one track after the other.
    #[cfg(test)]
    pub(super) fn from_speeds(speeds: Vec<f64>, weights: Vec<f64>) -> Self {
        Self { first: Frame(0), frames: speeds.len() / weights.len(), speeds, weights }
    }

    /// Returns the clip's first frame.
    pub(super) fn first(&self) -> Frame {
        self.first
    }

    /// Returns how much slower the body is at each frame than `reach` frames before and after, and how much faster.
    /// Both are weighted sums over the tracks; each track counts only as far as it is slower, or faster, itself. Beyond
    /// its ends the clip is mirrored.
    #[inline(always)]
    pub(super) fn bends(&self, reach: f64) -> (Vec<f64>, Vec<f64>) {
        let (mut valleys, mut hills) = (vec![0.0; self.frames], vec![0.0; self.frames]);
        let reach = reach.min((self.frames - 1) as f64);
        let tracks = self.speeds.chunks_exact(self.frames).zip(&self.weights);
        for (speeds, weight) in tracks {
            add_bends(speeds, *weight, reach, &mut valleys, &mut hills);
        }
        (valleys, hills)
    }
}

/// Adds the speed of a track at each frame, from its steps along three axes.
#[inline(always)]
fn add_speeds(track: &[f64], count: usize, speeds: &mut Vec<f64>) {
    let [x, y, z] = [0, 1, 2].map(|axis| &track[axis * count..(axis + 1) * count]);
    // The velocity at a frame is the mean of the steps into and out of it: time has no direction.
    let speed = |before: usize, after: usize| {
        let mean = |axis: &[f64]| 0.5 * (axis[before] + axis[after]);
        (mean(x).powi(2) + mean(y).powi(2) + mean(z).powi(2)).sqrt()
    };
    speeds.push(speed(0, 0));
    speeds.extend((1..count).map(|at| speed(at - 1, at)));
    speeds.push(speed(count - 1, count - 1));
}

/// Adds the bends of a track.
#[inline(always)]
fn add_bends(speeds: &[f64], weight: f64, reach: f64, valleys: &mut [f64], hills: &mut [f64]) {
    let last = speeds.len() - 1;
    let (near, share) = (reach.floor() as usize, reach.fract());
    let far = (near + 1).min(last);
    let mut add = |at: usize, [before, further, after, beyond]: [f64; 4]| {
        // Speeds between two frames are interpolated linearly.
        let ends = (before + share * (further - before)) + (after + share * (beyond - after));
        let bend = weight * (0.5 * ends - speeds[at]);
        valleys[at] += bend.max(0.0);
        hills[at] += (-bend).max(0.0);
    };
    let mirrored = |at: usize, by: usize| {
        let after = if at + by > last { 2 * last - (at + by) } else { at + by };
        (speeds[at.abs_diff(by)], speeds[after])
    };
    let inside = far.min(last)..(last + 1).saturating_sub(far).max(far.min(last));
    for at in (0..inside.start).chain(inside.end..last + 1) {
        let ((before, after), (further, beyond)) = (mirrored(at, near), mirrored(at, far));
        add(at, [before, further, after, beyond]);
    }
    for at in inside {
        add(at, [speeds[at - near], speeds[at - far], speeds[at + near], speeds[at + far]]);
    }
}

/// Returns the largest value up to `reach` places to each side of every place.
pub(super) fn largest_near(values: &[f64], reach: usize) -> Vec<f64> {
    // Places whose value is above all later ones, the largest first.
    let mut leading = std::collections::VecDeque::new();
    let mut next = 0;
    let largest = |at: usize| {
        while next < values.len() && next <= at + reach {
            while leading.back().is_some_and(|last: &usize| values[*last] <= values[next]) {
                leading.pop_back();
            }
            leading.push_back(next);
            next += 1;
        }
        while leading.front().is_some_and(|first| first + reach < at) {
            leading.pop_front();
        }
        values[leading[0]]
    };
    (0..values.len()).map(largest).collect()
}

/// Returns the peaks of a bend by row, with their height. Of peaks nearer to each other than `apart`, the highest
/// stays.
pub(super) fn summits(bend: &[f64], apart: f64) -> Vec<(usize, f64)> {
    let found = peaks(bend, DUST).into_iter().map(|row| (row, bend[row]));
    strongest_apart(found.filter(|(_, height)| *height >= LEAST).collect(), apart)
}
