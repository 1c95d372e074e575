//! Timing: keys compared with reference keys.

use serde::Serialize;

use genga::keys::Matching;
use genga::time::{Clock, Frame};

/// Tolerance added in frames, so that three tenths of a koma are three frames of 240 fps despite rounding.
const HAIR: f64 = 1e-9;

/// Keys compared with reference keys (照合) by frame, with all distances in koma.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Timing {
    /// Number of reference keys.
    pub reference: usize,
    /// Number of found keys.
    pub found: usize,
    /// Number of pairs within the tolerance, each key in at most one.
    pub pairs: usize,
    /// The share of the found keys that are in a pair; `None` without found or reference keys.
    pub precision: Option<f64>,
    /// The share of the reference keys that are in a pair; `None` if there are none.
    pub recall: Option<f64>,
    /// The harmonic mean of both: the share of all keys that are in a pair; `None` without a reference key.
    pub f1: Option<f64>,
    /// The mean distance from a reference key to the nearest found key, in koma, independent of the tolerance; `None`
    /// if either side has no keys.
    pub mean_off: Option<f64>,
    /// The 95th percentile of that distance, in koma.
    pub off_95: Option<f64>,
}

impl Timing {
    /// Compares keys with reference keys, both in any order, within a tolerance in koma. A repeated key counts once. Nothing is rounded to koma
    /// first: two keys that lie half a koma apart stay so, whichever koma they are nearest to.
    pub fn new(found: &[Frame], reference: &[Frame], clock: Clock, tolerance: f64) -> Self {
        let [found, reference] = [found, reference].map(|keys| {
            let mut keys = keys.to_vec();
            keys.sort_unstable();
            keys.dedup();
            keys
        });
        let frames_in_koma = clock.frames_in_koma();
        let matching = Matching::between(&reference, &found, tolerance * frames_in_koma + HAIR);
        let pairs = matching.pairs.len();
        let is_measured = !reference.is_empty();
        let share =
            |of: &[Frame]| (is_measured && !of.is_empty()).then(|| pairs as f64 / of.len() as f64);
        let off = distances(&reference, &found);
        let in_koma = |frames: f64| frames / frames_in_koma;
        Self {
            reference: reference.len(),
            found: found.len(),
            pairs,
            precision: share(&found),
            recall: share(&reference),
            f1: is_measured.then(|| matching.kept()),
            mean_off: (!off.is_empty())
                .then(|| in_koma(off.iter().sum::<usize>() as f64 / off.len() as f64)),
            off_95: percentile(&off, 0.95).map(|off| in_koma(off as f64)),
        }
    }
}

/// Returns the distance from each key of one sorted list to the nearest of another, in ascending order; empty if the
/// other list is empty.
fn distances(of: &[Frame], to: &[Frame]) -> Vec<usize> {
    let nearest = |key: &Frame| {
        let after = to.partition_point(|other| other < key);
        to[after.saturating_sub(1)..].iter().take(2).map(|other| other.0.abs_diff(key.0)).min()
    };
    let mut distances: Vec<usize> = of.iter().filter_map(nearest).collect();
    distances.sort_unstable();
    distances
}

/// Returns the least value that a share of a sorted list does not exceed.
fn percentile(sorted: &[usize], share: f64) -> Option<usize> {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.saturating_sub(1)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use genga::time::FrameRate;

    /// Compares keys, given by frame, at a frame rate.
    fn timing(found: &[usize], reference: &[usize], fps: f64, tolerance: f64) -> Timing {
        let frame_rate = FrameRate::new(fps).unwrap();
        let clock = Clock { first: Frame(0), frame_rate, koma_rate: 24.0 };
        let frames = |keys: &[usize]| keys.iter().copied().map(Frame).collect::<Vec<_>>();
        Timing::new(&frames(found), &frames(reference), clock, tolerance)
    }

    #[test]
    fn precision_is_of_what_was_found_and_recall_of_what_should_be() {
        let timing = timing(&[10, 21, 30], &[10, 20, 50, 90], 24.0, 1.0);
        assert_eq!((timing.found, timing.reference, timing.pairs), (3, 4, 2));
        assert_eq!((timing.precision, timing.recall), (Some(2.0 / 3.0), Some(0.5)));
        assert_eq!(timing.f1, Some(4.0 / 7.0));
        // 0, 1, 20 and 60 koma.
        assert_eq!((timing.mean_off, timing.off_95), (Some(20.25), Some(60.0)));
    }

    #[test]
    fn the_tolerance_holds_between_koma_too() {
        // 5 frames are a koma. If rounded to koma first, 12 and 13 would be a whole koma apart.
        let apart =
            |by: usize, tolerance| timing(&[12 + by, 112 + by], &[12, 112], 120.0, tolerance);
        assert_eq!((apart(2, 0.5).f1, apart(2, 0.5).mean_off), (Some(1.0), Some(0.4)));
        assert_eq!((apart(3, 0.5).f1, apart(3, 0.6).f1), (Some(0.0), Some(1.0)));
        assert_eq!((apart(5, 1.0).f1, apart(6, 1.0).f1), (Some(1.0), Some(0.0)));
        assert_eq!(apart(6, 1.0).off_95, Some(1.2));
        for frames in 1..20 {
            let whole = timing(&[100 + frames], &[100], 240.0, 0.1 * frames as f64);
            assert_eq!(whole.pairs, 1, "{frames}");
        }
    }

    #[test]
    fn a_key_is_in_one_pair_at_the_most() {
        assert_eq!(timing(&[10], &[9, 11], 24.0, 1.0).pairs, 1);
        assert_eq!(timing(&[9, 10, 11], &[10], 24.0, 1.0).precision, Some(1.0 / 3.0));
    }

    #[test]
    fn without_keys_nothing_is_measured() {
        let nothing = timing(&[], &[], 24.0, 1.0);
        assert_eq!((nothing.precision, nothing.recall, nothing.f1), (None, None, None));
        assert_eq!((nothing.mean_off, nothing.off_95), (None, None));
        let none_found = timing(&[], &[5], 24.0, 1.0);
        assert_eq!((none_found.precision, none_found.recall), (None, Some(0.0)));
        assert_eq!((none_found.f1, none_found.mean_off), (Some(0.0), None));
        let no_reference = timing(&[5], &[], 24.0, 1.0);
        assert_eq!((no_reference.precision, no_reference.f1), (None, None));
    }

    #[test]
    fn all_but_one_in_twenty_are_nearer_than_the_95_per_cent() {
        let reference: Vec<usize> = (0..20).map(|key| 100 * key).collect();
        let found: Vec<usize> = (0..20).map(|key| 100 * key + key).collect();
        assert_eq!(timing(&found, &reference, 24.0, 0.0).off_95, Some(18.0));
    }
}
