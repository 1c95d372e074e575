//! Hits: whether keys stand where a body turns.

use genga::time::{Clock, Frame};

/// Largest distance between a key and a moment that counts as a hit, in koma.
const WITHIN: f64 = 1.0;

/// Hits (命中): keys compared with the moments at which a body turns.
///
/// Counts the moments that have a key, and not the keys that have a moment: with more keys than moments, most keys
/// cannot have one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hits {
    /// The share of the moments that have a key within a koma.
    pub(super) share: f64,
    /// The mean share when the same keys are rotated around the clip by 1, 2, 3 … koma: the hits of equally many,
    /// equally spaced keys unrelated to the motion.
    pub(super) by_chance: f64,
    /// The mean distance from a moment to the nearest key, in koma; `None` without a key.
    pub(super) off: Option<f64>,
}

impl Hits {
    /// Compares sorted keys with moments, given by koma, in a clip of `koma` koma. `None` without a moment, and if the
    /// clip is too short to be rotated.
    pub(super) fn new(
        keys: &[Frame],
        moments: &[usize],
        clock: Clock,
        koma: usize,
    ) -> Option<Self> {
        if moments.is_empty() || koma < 2 {
            return None;
        }
        // Moments are known only by koma, so keys are rounded to koma too. Otherwise a key between two koma would be
        // within a koma of two moments' places, and a key on a koma of three.
        let places: Vec<f64> = keys.iter().map(|key| clock.koma_from_frame(*key) as f64).collect();
        let turned = |by: usize| {
            let mut turned: Vec<f64> =
                places.iter().map(|place| (place + by as f64) % koma as f64).collect();
            turned.sort_by(f64::total_cmp);
            share(&turned, moments)
        };
        let off: f64 = moments.iter().map(|moment| nearest(&places, *moment)).sum();
        Some(Self {
            share: share(&places, moments),
            by_chance: (1..koma).map(turned).sum::<f64>() / (koma - 1) as f64,
            off: (!keys.is_empty()).then(|| off / moments.len() as f64),
        })
    }
}

/// Returns the share of the moments that have a key within a koma.
fn share(keys: &[f64], moments: &[usize]) -> f64 {
    let hit = moments.iter().filter(|moment| nearest(keys, **moment) <= WITHIN).count();
    hit as f64 / moments.len() as f64
}

/// Returns the distance in koma from a moment to the nearest of the sorted keys; infinite without keys.
fn nearest(keys: &[f64], moment: usize) -> f64 {
    let moment = moment as f64;
    let after = keys.partition_point(|key| *key < moment);
    let near = keys[after.saturating_sub(1)..].iter().take(2);
    near.map(|key| (key - moment).abs()).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use genga::time::FrameRate;

    fn hits(keys: &[usize], moments: &[usize], fps: f64, koma: usize) -> Option<Hits> {
        let frame_rate = FrameRate::new(fps).unwrap();
        let clock = Clock { first: Frame(0), frame_rate, koma_rate: 24.0 };
        let keys: Vec<Frame> = keys.iter().copied().map(Frame).collect();
        Hits::new(&keys, moments, clock, koma)
    }

    #[test]
    fn a_moment_is_hit_by_a_key_within_a_koma_and_more_keys_do_no_harm() {
        let all = hits(&[1, 3, 5, 6, 8, 10, 12, 15, 17, 20, 23, 26], &[4, 16, 25], 24.0, 30);
        assert_eq!(all.unwrap().share, 1.0);
        let one = hits(&[5, 12], &[4, 16, 25], 24.0, 30).unwrap();
        assert_eq!((one.share, one.off), (1.0 / 3.0, Some(6.0)));
        assert_eq!(hits(&[27], &[4], 120.0, 30).unwrap().share, 1.0, "nearest to koma 5");
        assert_eq!(hits(&[28], &[4], 120.0, 30).unwrap().share, 0.0, "nearest to koma 6");
        assert_eq!(hits(&[3], &[1], 30.0, 30).unwrap().share, 1.0, "the frame of koma 2");
    }

    #[test]
    fn chance_is_what_the_same_keys_hit_elsewhere() {
        // Of the 9 other places of one key on 10 koma, two hit the moment.
        let found = hits(&[5], &[5], 24.0, 10).unwrap();
        assert_eq!((found.share, found.by_chance), (1.0, 2.0 / 9.0));
        let even = hits(&[2, 4, 6, 8], &[3, 7], 24.0, 10).unwrap();
        assert!((even.by_chance - 8.0 / 9.0).abs() < 0.2, "{even:?}");
    }

    #[test]
    fn keys_between_koma_have_the_chance_of_those_on_koma() {
        let chance = |by: usize| hits(&[50 + by], &[4, 15], 120.0, 30).unwrap().by_chance;
        for by in 1..5 {
            assert!((chance(by) - chance(0)).abs() < 0.04, "{by}");
        }
    }

    #[test]
    fn without_moments_nothing_is_measured_and_without_keys_nothing_is_hit() {
        assert_eq!(hits(&[1, 2], &[], 24.0, 9), None);
        assert_eq!(hits(&[], &[0], 24.0, 1), None);
        let none = hits(&[], &[4], 24.0, 9).unwrap();
        assert_eq!((none.share, none.by_chance, none.off), (0.0, 0.0, None));
    }
}
