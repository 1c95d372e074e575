//! Extrema of the paths of a body's wrists, ankles and head in the world.
//!
//! An animator's extremes (極端ポーズ) are the poses at which a hand, a foot or the head is furthest. They are found in
//! world positions, one coordinate at a time. Neither joint speeds nor reconstruction errors are used, so that no
//! method of choosing keys is judged by its own objective.

use glam::DVec3;

use genga::motion::{Clip, Landmarks, landmarks};
use genga::time::Clock;

/// How far a coordinate must travel before and after a turn, in % of body height. Smaller movements are noise.
const SWING: f64 = 4.0;

/// How close to its extremum a coordinate counts as being there, in % of body height.
const THERE: f64 = 0.4;

/// Seconds that a coordinate must be there for the extremum to be held; arriving and leaving then count separately.
const HELD: f64 = 0.25;

/// Moments closer than this, in koma, are one.
const ONE: usize = 1;

/// A moment at which a body turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Its koma.
    pub koma: usize,
    /// How far everything that turns there travels, in % of body height: the sum, over the turning coordinates of all
    /// landmarks, of the shorter way before or after.
    pub weight: f64,
}

/// The moments at which wrists, ankles and head of a body turn in the world (極値).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extrema {
    /// Sorted by weight, heaviest first, then by time. No two lie within a koma of each other.
    pub moments: Vec<Moment>,
}

impl Extrema {
    /// Examines the path of each landmark, smoothed over three koma (¼ ½ ¼), along each axis of the file. A turn counts
    /// if the coordinate travels 4 % of the body's height or more before and after it. If it stays within 0.4 % of its
    /// extremum for a quarter of a second, the moments are the arrival and the departure; otherwise the moment is the
    /// middle between the two.
    ///
    /// Turns of all coordinates and landmarks within a koma form one moment, at the heaviest koma.
    pub fn new(clip: &Clip, clock: Clock) -> Self {
        let found = Landmarks::new(clip);
        if found.height <= 0.0 {
            return Self::default();
        }
        let paths = landmarks::paths(clip, clock, &found.points());
        let held = (HELD * clock.koma_rate).round() as usize;
        let mut turns = Vec::new();
        for path in &paths {
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let along: Vec<f64> =
                    path.iter().map(|position| 100.0 * position.dot(axis) / found.height).collect();
                turns.extend(coordinate_turns(&smoothed(&along), held));
            }
        }
        Self { moments: merged(&turns, paths.first().map_or(0, Vec::len)) }
    }

    /// Returns the koma of the heaviest moments, sorted.
    pub fn heaviest(&self, count: usize) -> Vec<usize> {
        let mut koma: Vec<usize> =
            self.moments.iter().take(count).map(|moment| moment.koma).collect();
        koma.sort_unstable();
        koma
    }
}

/// Smooths values with ¼ ½ ¼; the ends stay.
fn smoothed(values: &[f64]) -> Vec<f64> {
    let mut smoothed = values.to_vec();
    for (smooth, near) in smoothed.iter_mut().skip(1).zip(values.windows(3)) {
        *smooth = 0.25 * near[0] + 0.5 * near[1] + 0.25 * near[2];
    }
    smoothed
}

/// Returns the turns of a coordinate in %: koma and weight.
fn coordinate_turns(values: &[f64], held: usize) -> Vec<(usize, f64)> {
    let pivots = pivots(values);
    let mut turns = Vec::new();
    for near in pivots.windows(3) {
        let [before, at, after] = [near[0], near[1], near[2]].map(|koma| values[koma]);
        let weight = (at - before).abs().min((at - after).abs());
        let is_there = |value: &f64| (value - at).abs() <= THERE;
        let begin = near[1] - values[..near[1]].iter().rev().take_while(|v| is_there(v)).count();
        let end = near[1] + values[near[1] + 1..].iter().take_while(|v| is_there(v)).count();
        if end - begin > held {
            turns.extend([(begin, weight), (end, weight)]);
        } else {
            turns.push((begin.midpoint(end), weight));
        }
    }
    turns
}

/// Returns the turns of a coordinate, alternating highs and lows. Each is [`SWING`] or more from its neighbours. The
/// first and the last are only the ends of those ways.
fn pivots(values: &[f64]) -> Vec<usize> {
    let mut pivots = Vec::new();
    let (mut low, mut high) = (0, 0);
    // Whether the coordinate rose last; `None` before the first way of that length.
    let mut rising: Option<bool> = None;
    for (koma, value) in values.iter().enumerate() {
        if *value > values[high] {
            high = koma;
        }
        if *value < values[low] {
            low = koma;
        }
        if rising != Some(true) && value - values[low] >= SWING {
            pivots.push(low);
            (rising, high) = (Some(true), koma);
        } else if rising != Some(false) && values[high] - value >= SWING {
            pivots.push(high);
            (rising, low) = (Some(false), koma);
        }
    }
    pivots.extend(rising.map(|rising| if rising { high } else { low }));
    pivots
}

/// Merges turns within a koma of each other into one moment, the heaviest first.
fn merged(turns: &[(usize, f64)], koma: usize) -> Vec<Moment> {
    let mut weights = vec![0.0; koma];
    for (koma, weight) in turns {
        weights[*koma] += weight;
    }
    let mut moments = Vec::new();
    loop {
        let near = |koma: usize| {
            weights[koma.saturating_sub(ONE)..(koma + ONE + 1).min(weights.len())]
                .iter()
                .sum::<f64>()
        };
        // Of koma with the same sum, prefer the one with the most weight of its own.
        let heavier = |a: &usize, b: &usize| {
            let own = |koma: &usize| (near(*koma), weights[*koma]);
            own(a).partial_cmp(&own(b)).expect("weights are numbers").then(b.cmp(a))
        };
        let heaviest = (0..weights.len()).filter(|koma| weights[*koma] > 0.0).max_by(heavier);
        let Some(koma) = heaviest else { return moments };
        moments.push(Moment { koma, weight: near(koma) });
        let end = (koma + ONE + 1).min(weights.len());
        weights[koma.saturating_sub(ONE)..end].fill(0.0);
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn a_wave_turns_at_its_crests_and_dust_does_not() {
        let wave: Vec<f64> =
            (0..60).map(|koma| 10.0 * (f64::from(koma) * TAU / 20.0).sin()).collect();
        let koma: Vec<usize> = coordinate_turns(&wave, 6).into_iter().map(|turn| turn.0).collect();
        assert_eq!(koma, [5, 15, 25, 35, 45, 55]);
        let weights = coordinate_turns(&wave, 6).into_iter().map(|turn| turn.1);
        // The last way ends with the wave.
        let near = [10.0, 20.0, 20.0, 20.0, 20.0, 7.0].map(|way| way - 0.2..way + 0.1);
        assert!(weights.zip(near).all(|(weight, near)| near.contains(&weight)));
        let dust: Vec<f64> = wave.iter().map(|value| 0.15 * value).collect();
        assert!(coordinate_turns(&dust, 6).is_empty());
    }

    #[test]
    fn what_is_held_is_reached_and_left() {
        let way = |from: i32, to: i32| (from..to).map(f64::from);
        let back = |from: i32, to: i32| (to..from).rev().map(f64::from);
        let path: Vec<f64> =
            way(0, 20).chain([20.0; 12]).chain(back(20, 0)).chain(way(0, 20)).collect();
        let turns = coordinate_turns(&path, 6);
        assert_eq!(turns[..2], [(20, 20.0), (31, 20.0)]);
        assert_eq!(turns.len(), 3, "{turns:?}");
    }

    #[test]
    fn turns_within_a_koma_are_one_moment_and_the_heaviest_comes_first() {
        let found = merged(&[(10, 6.0), (11, 7.0), (12, 5.0), (30, 10.0), (13, 9.0)], 40);
        assert_eq!(found[0], Moment { koma: 12, weight: 21.0 });
        assert_eq!(found[1], Moment { koma: 30, weight: 10.0 });
        assert_eq!(found[2], Moment { koma: 10, weight: 6.0 });
        let extrema = Extrema { moments: found };
        assert_eq!(extrema.heaviest(2), [12, 30]);
        assert_eq!(extrema.heaviest(9).len(), 3);
    }

    #[test]
    fn nothing_turns_where_nothing_is() {
        assert!(pivots(&[]).is_empty() && pivots(&[1.0]).is_empty());
        assert_eq!(coordinate_turns(&[0.0, 9.0, 0.0], 6), [(1, 9.0)]);
        assert!(merged(&[], 0).is_empty());
        assert!(smoothed(&[]).is_empty());
        assert_eq!(smoothed(&[0.0, 4.0, 0.0]), [0.0, 2.0, 0.0]);
    }
}
