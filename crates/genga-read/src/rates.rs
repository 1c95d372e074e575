//! Derives a frame rate from the times of keys, for formats that store only seconds, and cuts off stray
//! keys.

use genga::error::{Error, Place, Warning};
use genga::time::{FrameRate, USUAL_RATES};

/// Warning that keys lie closer together than the sampled frames.
pub(super) const KEYS_FINER: &str = "W_KEYS_FINER";

/// Warning that a key lies too far behind the others to belong to the motion.
pub const KEY_FAR: &str = "W_KEY_FAR";

/// Farthest a key may lie from a whole frame, in frames: some programs round to milliseconds.
const NEAR: f64 = 0.02;

/// Most keys examined; more add no information.
const MOST: usize = 100_000;

/// Lowest rate for keys that fit no usual rate.
const OTHERWISE: f64 = 60.0;

/// Longest gap between keys within one motion, in seconds. A key behind a longer gap is a mistake, and
/// every frame before it would cost time and memory.
pub(super) const GAP: f64 = 1200.0;

/// Finds the lowest usual rate with a frame at every key, counted from the first key. Whole rates come
/// first, because a short take at 24 also fits 23.976. Returns `None` if no usual rate fits.
pub(super) fn of_keys(times: &[f64]) -> Option<FrameRate> {
    let first = times.iter().copied().reduce(f64::min)?;
    let (whole, broken): (Vec<f64>, Vec<f64>) =
        USUAL_RATES.iter().partition(|rate| rate.fract() == 0.0);
    let rate = whole.into_iter().chain(broken).find(|rate| are_frames(times, first, *rate))?;
    FrameRate::new(rate).ok()
}

/// Whether every key lies on a frame of a rate, counted from `begin`.
fn are_frames(times: &[f64], begin: f64, rate: f64) -> bool {
    times.iter().take(MOST).all(|time| {
        let frame = (time - begin) * rate;
        (frame - frame.round()).abs() < NEAR
    })
}

/// Chooses a rate for keys that fit no usual rate: the lowest usual one, of at least 60, that skips hardly
/// any key. `times` must be sorted and unique.
pub(super) fn otherwise(times: &[f64]) -> Result<FrameRate, Error> {
    let dense = density(times).unwrap_or(OTHERWISE);
    let enough = |rate: &f64| *rate >= OTHERWISE && *rate >= (1.0 - NEAR) * dense;
    let highest = USUAL_RATES[USUAL_RATES.len() - 1];
    FrameRate::new(USUAL_RATES.into_iter().find(enough).unwrap_or(highest))
}

/// Warns if keys lie closer together than the frames of a rate, counted from `begin`: either their own rate
/// is higher, or half of the gaps between them are shorter. `times` must be sorted.
pub(super) fn finer(times: &[f64], begin: f64, rate: FrameRate) -> Option<Warning> {
    if are_frames(times, begin, rate.fps()) {
        return None;
    }
    let meant = of_keys(times).map(|keys| (keys.fps(), keys.to_string()));
    let (dense, keys) =
        meant.or_else(|| density(times).map(|keys| (keys, format!("{keys:.0}"))))?;
    ((1.0 - NEAR) * dense > rate.fps()).then(|| {
        let message = format!(
            "{rate} frames a second are read and the keys lie {keys} a second; --fps {keys} reads them all"
        );
        Warning::new(KEYS_FINER, message)
    })
}

/// Number of keys a second, by the median gap.
fn density(times: &[f64]) -> Option<f64> {
    let mut gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.get(gaps.len() / 2).map(|gap| 1.0 / gap).filter(|dense| dense.is_finite())
}

/// Number of keys that belong to one motion: those before the first gap longer than [`GAP`]. `times` must
/// be sorted.
fn together(times: &[f64]) -> usize {
    let gap = times.windows(2).position(|pair| pair[1] - pair[0] > GAP);
    gap.map_or(times.len(), |before| before + 1)
}

/// Number of keys that belong to one motion, and a warning about the others; `called` describes a key's
/// time in words. `times` must be sorted.
///
/// # Errors
/// Errors of [`far`].
pub(super) fn cut(
    times: &[f64],
    place: Place,
    called: impl Fn(usize) -> String,
) -> Result<(usize, Option<Warning>), Error> {
    let near = together(times);
    let is_cut = near < times.len();
    let told = is_cut.then(|| far(near, &called(near), &called(near - 1), place));
    Ok((near, told.transpose()?))
}

/// Builds the warning about the key `at`, which lies behind such a gap; the motion is read up to the key
/// `end`.
///
/// # Errors
/// [`Error::Motion`] at `place` if only a single key is left.
fn far(left: usize, at: &str, end: &str, place: Place) -> Result<Warning, Error> {
    let minutes = GAP / 60.0;
    if left < 2 {
        let message = format!(
            "there is no key between {end} and {at}: no motion goes on for {minutes} minutes without one"
        );
        return Err(Error::Motion { place, message });
    }
    let message = format!(
        "a key stands at {at}, more than {minutes} minutes behind the one before it: the motion is read up to {end}"
    );
    Ok(Warning::new(KEY_FAR, message))
}

/// Number of frames at a rate in a span of seconds, both ends included.
pub(super) fn frames(seconds: f64, rate: FrameRate) -> usize {
    // Rounding of single-precision floats may put the last frame slightly too early; it still counts.
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
    fn keys_that_mean_no_rate_are_sampled_as_close_as_they_lie() {
        let rate = |times: &[f64]| otherwise(times).unwrap().fps();
        let (coarse, fine, finest) = (keys(17.3, 1, 99), keys(144.0, 1, 99), keys(1000.0, 1, 99));
        assert_eq!([rate(&coarse), rate(&fine), rate(&finest)], [60.0, 240.0, 240.0]);
        assert_eq!(rate(&keys(75.0, 1, 99)), 90.0);
        assert_eq!([rate(&[]), rate(&[1.0])], [60.0; 2]);
        assert_eq!(told(&fine, 240.0), None);
        let told = told(&finest, 240.0).unwrap();
        assert!(told.contains("the keys lie 1000 a second; --fps 1000"), "{told}");
    }

    fn told(times: &[f64], rate: f64) -> Option<String> {
        finer(times, times[0], FrameRate::new(rate).unwrap()).map(|told| told.to_string())
    }

    #[test]
    fn keys_on_the_frames_of_their_own_rate_are_not_finer() {
        for rate in [1.0, 8.0, 10.0, 12.0, 12.5, 15.0, 20.0, 24.0, 29.97, 30.0, 60.0, 240.0] {
            for step in 1..4 {
                assert_eq!(told(&keys(rate, step, 99), rate), None, "{rate} a second, by {step}");
            }
        }
        for (keys_at, rate) in
            [(24.0, 12.0), (30.0, 24.0), (60.0, 30.0), (29.97, 24.0), (30.0, 1.0)]
        {
            let told = told(&keys(keys_at, 1, 3000), rate).unwrap();
            assert!(told.contains(&format!("--fps {keys_at}")), "{told}");
        }
    }

    #[test]
    fn a_key_behind_a_gap_that_no_motion_has_is_not_of_it() {
        assert_eq!(together(&[0.0, 1.0, 1201.0, 1202.0]), 4);
        assert_eq!(together(&[0.0, 1.0, 1202.0, 1203.0]), 2);
        assert_eq!(together(&[5000.0]), 1);
        assert_eq!(together(&[]), 0);
        let told = |left| far(left, "2 s", "1 s", Place::Whole);
        assert_eq!(told(2).unwrap().code, KEY_FAR);
        assert!(told(1).is_err(), "a pose and no motion");
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
