//! Whether keys stand where those of somebody else do.

use serde::Serialize;

use crate::keys::Matching;
use crate::time::Frame;

/// Keys beside reference keys (照合), all by koma.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Timing {
    /// Keys of the reference.
    pub reference: usize,
    /// Keys that were found.
    pub found: usize,
    /// Pairs that are no further apart than the tolerance, each key in one at the most.
    pub pairs: usize,
    /// The share of the found keys that are in a pair; 1 where none was found.
    pub precision: f64,
    /// The share of the reference keys that are in a pair; 1 where there is none.
    pub recall: f64,
    /// The harmonic mean of both: the share of all keys that are in a pair; 1 where there is no key.
    pub f1: f64,
    /// How far the nearest found key is from a reference key in the mean, in koma, whatever the
    /// tolerance; none without keys on both sides.
    pub mean_off: Option<f64>,
    /// How far it is from 95 % of them at the most, in koma.
    pub off_95: Option<f64>,
}

impl Timing {
    /// Lays keys on reference keys, both in koma and in any order, within a tolerance in koma.
    pub fn of(found: &[usize], reference: &[usize], tolerance: f64) -> Self {
        let [found, reference] = [found, reference].map(|keys| {
            let mut keys: Vec<Frame> = keys.iter().copied().map(Frame).collect();
            keys.sort_unstable();
            keys
        });
        let matching = Matching::between(&reference, &found, tolerance);
        let pairs = matching.pairs.len();
        let share = |of: &[Frame]| if of.is_empty() { 1.0 } else { pairs as f64 / of.len() as f64 };
        let off = distances(&reference, &found);
        Self {
            reference: reference.len(),
            found: found.len(),
            pairs,
            precision: share(&found),
            recall: share(&reference),
            f1: matching.kept(),
            mean_off: (!off.is_empty())
                .then(|| off.iter().sum::<usize>() as f64 / off.len() as f64),
            off_95: percentile(&off, 0.95).map(|off| off as f64),
        }
    }
}

/// How far each key of one sorted list is from the nearest of another, the nearest first; nothing where
/// the other has none.
fn distances(of: &[Frame], to: &[Frame]) -> Vec<usize> {
    let nearest = |key: &Frame| {
        let after = to.partition_point(|other| other < key);
        to[after.saturating_sub(1)..].iter().take(2).map(|other| other.0.abs_diff(key.0)).min()
    };
    let mut distances: Vec<usize> = of.iter().filter_map(nearest).collect();
    distances.sort_unstable();
    distances
}

/// The least value that so large a share of a sorted list does not exceed.
fn percentile(sorted: &[usize], share: f64) -> Option<usize> {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.saturating_sub(1)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn precision_is_of_what_was_found_and_recall_of_what_should_be() {
        let timing = Timing::of(&[10, 21, 30], &[10, 20, 50, 90], 1.0);
        assert_eq!((timing.found, timing.reference, timing.pairs), (3, 4, 2));
        assert_eq!((timing.precision, timing.recall), (2.0 / 3.0, 0.5));
        assert_eq!(timing.f1, 4.0 / 7.0);
        // 0, 1, 20 and 60 koma.
        assert_eq!((timing.mean_off, timing.off_95), (Some(20.25), Some(60.0)));
    }

    #[test]
    fn a_key_is_in_one_pair_at_the_most() {
        assert_eq!(Timing::of(&[10], &[9, 11], 1.0).pairs, 1);
        assert_eq!(Timing::of(&[9, 10, 11], &[10], 1.0).precision, 1.0 / 3.0);
    }

    #[test]
    fn without_keys_nothing_is_wrong_and_nothing_is_off() {
        let nothing = Timing::of(&[], &[], 1.0);
        assert_eq!((nothing.precision, nothing.recall, nothing.f1), (1.0, 1.0, 1.0));
        assert_eq!((nothing.mean_off, nothing.off_95), (None, None));
        let none_found = Timing::of(&[], &[5], 1.0);
        assert_eq!((none_found.recall, none_found.f1, none_found.mean_off), (0.0, 0.0, None));
    }

    #[test]
    fn all_but_one_in_twenty_are_nearer_than_the_95_per_cent() {
        let reference: Vec<usize> = (0..20).map(|key| 100 * key).collect();
        let found: Vec<usize> = (0..20).map(|key| 100 * key + key).collect();
        assert_eq!(Timing::of(&found, &reference, 0.0).off_95, Some(18.0));
    }
}
