//! The rate that keys of curves mean, whose format has seconds alone.

use crate::time::{FrameRate, USUAL_RATES};

/// How far from a whole frame a key may stand, in frames: some programs write milliseconds.
const NEAR: f64 = 0.02;

/// Keys that are looked at: more tell nothing new.
const MOST: usize = 100_000;

/// The lowest usual rate that has a frame at every key, counted from the first. Whole rates come first: a short take
/// at 24 also fits 23.976. `None` where no usual rate does.
pub(super) fn of_keys(times: &[f64]) -> Option<FrameRate> {
    let first = times.iter().copied().reduce(f64::min)?;
    let fits = |rate: f64| {
        times.iter().take(MOST).all(|time| {
            let frame = (time - first) * rate;
            (frame - frame.round()).abs() < NEAR
        })
    };
    let (whole, broken): (Vec<f64>, Vec<f64>) =
        USUAL_RATES.iter().partition(|rate| rate.fract() == 0.0);
    let rate = whole.into_iter().chain(broken).find(|rate| fits(*rate))?;
    FrameRate::new(rate).ok()
}

/// How many frames of a rate there are from one instant to another, both among them.
pub(super) fn frames(seconds: f64, rate: FrameRate) -> usize {
    // A last frame that single floats have made a hair early is one.
    (seconds.max(0.0) * rate.fps() + NEAR).floor().min(1e15) as usize + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(rate: f64, step: usize, count: usize) -> Vec<f64> {
        (0..count).map(|key| f64::from(((7 + key * step) as f64 / rate) as f32)).collect()
    }

    #[test]
    fn the_rate_is_the_lowest_that_meets_every_key() {
        let rate = |times: &[f64]| of_keys(times).map(FrameRate::fps);
        for usual in [24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 60.0, 90.0, 100.0, 120.0, 240.0] {
            assert_eq!(rate(&keys(usual, 1, 3000)), Some(usual));
        }
        assert_eq!(rate(&keys(23.976, 1, 3000)), Some(23.976));
        assert_eq!(rate(&keys(24.0, 1, 5)), Some(24.0), "a short take");
        assert_eq!(rate(&keys(15.0, 1, 300)), Some(30.0));
        assert_eq!(rate(&keys(12.0, 1, 300)), Some(24.0));
        assert_eq!(rate(&[0.0, 0.0333, 0.0667, 0.1]), Some(30.0), "written as milliseconds");
        assert_eq!(rate(&[0.0, 0.013, 0.029]), None);
        assert_eq!(rate(&[]), None);
    }

    #[test]
    fn frames_are_counted_from_both_ends() {
        let rate = FrameRate::new(30.0).unwrap();
        assert_eq!(frames(0.0, rate), 1);
        assert_eq!(frames(f64::from(99.0f32 / 30.0), rate), 100);
        assert_eq!(frames(-1.0, rate), 1);
        assert_eq!(frames(f64::NAN, rate), 1);
        assert!(frames(f64::INFINITY, rate) > 1 << 40);
    }
}
