//! Crispness (鋭さ): how suddenly a layer changes its velocities. Keys with straight inbetweens change them only at the
//! keys; a captured body changes them all the time.

use super::tracks::Tracks;

/// Distance to each side within which a change is compared with others, in seconds.
const REACH: f64 = 0.1;

/// Largest crispness of a capture. A capture that counts as drawn loses its smoothing: this is the constant to guard.
const CAPTURED: f64 = 0.03;

/// Additional crispness at which a clip counts as fully drawn.
const RAMP: f64 = 0.02;

/// Longest interval between the kinks that sampling leaves, in seconds.
const SAMPLED: f64 = 0.125;

/// Speed up to which a body counts as standing still, in % of body height a second: rounding.
const STANDS: f64 = 1e-6;

/// Returns the share of a layer with that crispness that is drawn, 0 to 1.
pub(crate) fn drawn(crispness: f64) -> f64 {
    ((crispness - CAPTURED) / RAMP).clamp(0.0, 1.0)
}

/// Computes the crispness of some tracks: below 0.03 for practically all captures, up to 1 for nothing but kinks.
///
/// Motion that was sampled from fewer frames a second has a kink at each of them, at even distances. Summed over such a
/// distance, its changes are as smooth as the original motion. So they are summed over several distances, and the
/// smallest crispness counts.
pub(super) fn crispness(tracks: &Tracks) -> f64 {
    let rate = tracks.steps.rate().fps();
    let sampled = ((SAMPLED * rate).round() as usize).max(1);
    let as_it_is = vec![Share::WHOLE; tracks.steps.frames()];
    let spread = spread(&speeds(tracks), sampled);
    let of = |shares: &[Share]| {
        let sums = sums(changes(tracks, shares));
        let together = 1..=sampled.min(sums.len());
        let crisp = together.map(|together| {
            let reach = (REACH * rate / together as f64).round() as usize;
            concentration(&sums, together, reach.max(1))
        });
        crisp.fold(f64::INFINITY, f64::min)
    };
    let own = of(&as_it_is);
    if spread == as_it_is { own } else { own.min(of(&spread)) }
}

/// A share of a step that stands for one frame's step.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Share {
    /// How many steps later that step is.
    later: usize,
    part: f64,
}

impl Share {
    const WHOLE: Self = Self { later: 0, part: 1.0 };
}

/// Gives frames that repeat up to `most` times equal shares of the step that follows.
fn spread(speeds: &[f64], most: usize) -> Vec<Share> {
    let mut shares = vec![Share::WHOLE; speeds.len()];
    let mut repeated = 0;
    for (at, speed) in speeds.iter().enumerate() {
        if *speed <= STANDS {
            repeated += 1;
            continue;
        }
        if repeated <= most {
            let part = 1.0 / (repeated + 1) as f64;
            for later in 0..=repeated {
                shares[at - later] = Share { later, part };
            }
        }
        repeated = 0;
    }
    shares
}

/// Returns the tracks of the body, three columns each, with their weights. Parts that act while the rest is quiet are
/// left out: their tracks begin and end with the quiet, and nobody drew that.
fn of_body(tracks: &Tracks) -> impl Iterator<Item = (&[f64], f64)> {
    let columns = 3 * tracks.steps.frames();
    let values = tracks.steps.unfiltered().values.as_slice();
    let weights = tracks.weights[..tracks.of_body].iter().copied();
    values.chunks_exact(columns.max(1)).zip(weights)
}

/// Returns the body's speed in each step.
fn speeds(tracks: &Tracks) -> Vec<f64> {
    let steps = tracks.steps.frames();
    let mut speeds = vec![0.0; steps];
    for (track, weight) in of_body(tracks) {
        let [x, y, z] = [0, 1, 2].map(|axis| &track[axis * steps..][..steps]);
        for (at, speed) in speeds.iter_mut().enumerate() {
            *speed += weight * (x[at] * x[at] + y[at] * y[at] + z[at] * z[at]).sqrt();
        }
    }
    speeds
}

/// Returns how much the body changes its velocity from each step to the next, with the steps divided into shares.
fn changes(tracks: &Tracks, shares: &[Share]) -> Vec<f64> {
    let steps = shares.len();
    let mut changes = vec![0.0; steps.saturating_sub(1)];
    for (track, weight) in of_body(tracks) {
        let axes = [0, 1, 2].map(|axis| &track[axis * steps..][..steps]);
        for (at, change) in changes.iter_mut().enumerate() {
            let [before, after] = [at, at + 1].map(|at| (at + shares[at].later, shares[at].part));
            let by = axes.map(|axis| after.1 * axis[after.0] - before.1 * axis[before.0]);
            *change += weight * by.map(|by| by * by).iter().sum::<f64>().sqrt();
        }
    }
    changes
}

/// Returns the running sums, beginning with 0.
fn sums(values: Vec<f64>) -> Vec<f64> {
    let mut sum = 0.0;
    let after = values.into_iter().map(|value| {
        sum += value;
        sum
    });
    [0.0].into_iter().chain(after).collect()
}

/// Returns how much larger than its neighbours a change is on average, from 0 (all alike) to 1 (each stands alone).
/// Changes are summed in groups of `together`, and each group is compared with `reach` groups on either side. Groups
/// too near to an end only serve as neighbours. Groups weigh by their square roots, or a few changes of a quick
/// movement would dominate.
fn concentration(sums: &[f64], together: usize, reach: usize) -> f64 {
    let (width, count) = (2 * reach + 1, (sums.len() - 1) / together);
    let even = 1.0 / width as f64;
    let (mut sharp, mut all) = (0.0, 0.0);
    for from in 0..(count + 1).saturating_sub(width) {
        let sum = |from: usize, to: usize| sums[to * together] - sums[from * together];
        let own = sum(from + reach, from + reach + 1);
        if own > 0.0 {
            let share = own / sum(from, from + width).max(own);
            sharp += own.sqrt() * (share - even) / (1.0 - even);
            all += own.sqrt();
        }
    }
    if all > 0.0 { sharp / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;
    use crate::keys::tests::swing;
    use crate::motion::{Build, Screen};
    use crate::time::FrameRate;

    fn crispness(angles: &[f64], fps: f64) -> f64 {
        let clip = swing(angles).with_rate(FrameRate::new(fps).unwrap());
        Tracks::of_all(&clip, &Build::new(&clip), &Screen::WORLD, 2.0).crispness()
    }

    /// The angles of an arm that swings naturally, for five seconds.
    fn swung(fps: f64) -> Vec<f64> {
        let angle = |second: f64| 40.0 * (TAU * second).cos() + 15.0 * (TAU * 2.3 * second).sin();
        (0..(5.0 * fps) as usize).map(|at| angle(at as f64 / fps)).collect()
    }

    /// Resamples angles to other frames: interpolated linearly, or each repeated.
    fn resampled(angles: &[f64], by: f64, straight: bool) -> Vec<f64> {
        let count = ((angles.len() - 1) as f64 * by) as usize;
        let angle = |at: usize| {
            let place = at as f64 / by;
            let (before, share) = (angles[place as usize], place.fract());
            let after = angles[(place as usize + 1).min(angles.len() - 1)];
            before + if straight { share * (after - before) } else { 0.0 }
        };
        (0..count).map(angle).collect()
    }

    /// Returns straight inbetweens between keys, given by their frames and angles.
    fn keyed(keys: &[(usize, f64)]) -> Vec<f64> {
        let way = |pair: &[(usize, f64)]| {
            let ((from, begin), (to, end)) = (pair[0], pair[1]);
            let angle = move |at| begin + (end - begin) * at as f64 / (to - from) as f64;
            (0..to - from).map(angle).collect::<Vec<f64>>()
        };
        keys.windows(2).flat_map(way).collect()
    }

    #[test]
    fn straight_inbetweens_are_crisp_and_a_swing_is_not() {
        let keys = [(0, 0.0), (11, 60.0), (31, -20.0), (40, 10.0), (66, 80.0), (90, 0.0)];
        let fast = keys.map(|(frame, angle)| (5 * frame, angle));
        for (keys, fps) in [(keys, 24.0), (fast, 120.0)] {
            let crisp = crispness(&keyed(&keys), fps);
            assert!(drawn(crisp) == 1.0, "{fps}: {crisp}");
        }
        for fps in [24.0, 30.0, 60.0, 120.0] {
            let smooth = crispness(&swung(fps), fps);
            assert!(drawn(smooth) == 0.0, "{fps}: {smooth}");
        }
        assert_eq!(
            [0.0, 0.03, 0.04, 0.05, 1.0].map(|own| (drawn(own) * 8.0).round()),
            [0.0, 0.0, 4.0, 8.0, 8.0]
        );
    }

    #[test]
    fn kinks_of_sampling_are_no_keys() {
        for (fps, to) in
            [(30.0, 60.0), (30.0, 120.0), (24.0, 60.0), (24.0, 30.0), (15.0, 60.0), (15.0, 30.0)]
        {
            for straight in [true, false] {
                let own = crispness(&resampled(&swung(fps), to / fps, straight), to);
                assert!(own < CAPTURED, "{fps} to {to}, straight {straight}: {own}");
            }
        }
        let swung = swung(24.0);
        let twos: Vec<f64> = (0..swung.len()).map(|at| swung[at / 2 * 2]).collect();
        assert!(crispness(&twos, 24.0) < CAPTURED, "{}", crispness(&twos, 24.0));
    }

    #[test]
    fn a_frame_that_is_repeated_now_and_then_is_no_key() {
        let mut angles = swung(30.0);
        for at in [7, 20, 31, 50, 58, 79, 101, 118, 140] {
            angles[at] = angles[at - 1];
        }
        assert!(crispness(&angles, 30.0) < CAPTURED, "{}", crispness(&angles, 30.0));
    }

    #[test]
    fn what_stands_or_is_short_is_not_drawn() {
        assert_eq!(crispness(&[5.0; 100], 24.0), 0.0);
        for short in 1..6 {
            assert_eq!(
                crispness(&keyed(&[(0, 0.0), (2, 50.0), (short + 2, 0.0)])[..short], 24.0),
                0.0
            );
        }
        let hasty = crispness(&swung(1e6)[..3000], 1e6);
        assert_eq!(hasty, 0.0, "fewer frames than are compared");
    }

    #[test]
    fn repeated_frames_take_their_shares() {
        let shares = |speeds: &[f64]| -> Vec<(usize, f64)> {
            spread(speeds, 2).iter().map(|share| (share.later, share.part)).collect()
        };
        assert_eq!(shares(&[1.0, 0.0, 2.0]), [(0, 1.0), (1, 0.5), (0, 0.5)]);
        assert_eq!(shares(&[0.0, 0.0, 0.0, 2.0]), [(0, 1.0); 4], "that is a hold");
        assert_eq!(shares(&[3.0, 0.0, 0.0]), [(0, 1.0); 3], "nothing comes behind");
    }

    /// Computes the concentration directly from its definition.
    fn slow(changes: &[f64], together: usize, reach: usize) -> f64 {
        let sums: Vec<f64> =
            changes.chunks_exact(together).map(|changes| changes.iter().sum()).collect();
        let even = 1.0 / (2 * reach + 1) as f64;
        let (mut sharp, mut all) = (0.0, 0.0);
        for at in 0..sums.len() {
            if at < reach || at + reach >= sums.len() || sums[at] == 0.0 {
                continue;
            }
            let near: f64 = (at - reach..=at + reach).map(|at| sums[at]).sum();
            sharp += sums[at].sqrt() * (sums[at] / near - even) / (1.0 - even);
            all += sums[at].sqrt();
        }
        if all == 0.0 { 0.0 } else { sharp / all }
    }

    proptest! {
        #[test]
        fn concentration_is_what_its_words_say(
            changes in prop::collection::vec(prop_oneof![Just(0.0), 0.0..50.0], 0..80),
            together in 1usize..9,
            reach in 1usize..9,
        ) {
            let found = concentration(&sums(changes.clone()), together, reach);
            let slow = slow(&changes, together, reach);
            prop_assert!((found - slow).abs() < 1e-9, "{found} {slow}");
        }
    }
}
