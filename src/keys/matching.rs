//! Matches the keys of two lists: pairs that lie near each other, each key in at most one pair.

use std::cmp::Reverse;

use crate::time::Frame;

/// Two lists of keys matched to each other (照合).
///
/// Of all ways to pair keys no further apart than a tolerance, it is one with the most pairs and, among those, with the
/// least total distance. `pairs`, `lost` and `gained` give the counts for precision, recall and F1.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Matching {
    /// Pairs by frame: a key of the first list and its partner in the second.
    pub pairs: Vec<(Frame, Frame)>,
    /// Keys without a partner in the first list, by frame.
    pub lost: Vec<Frame>,
    /// Keys without a partner in the second list, by frame.
    pub gained: Vec<Frame>,
}

impl Matching {
    /// Matches two lists, both sorted by frame, within a tolerance in frames (inclusive).
    ///
    /// Two pairs that cross may be uncrossed: both stay within the tolerance, and their total distance does not grow.
    /// So only matchings in order need be looked at, by dynamic programming. A gap wider than the tolerance cuts the
    /// work in two.
    pub fn between(before: &[Frame], after: &[Frame], tolerance: f64) -> Self {
        debug_assert!(before.is_sorted() && after.is_sorted());
        let mut matching = Self::default();
        let (mut before, mut after) = (before, after);
        while !before.is_empty() || !after.is_empty() {
            let (these, those) = first_cluster(before, after, tolerance);
            matching.add(&before[..these], &after[..those], tolerance);
            (before, after) = (&before[these..], &after[those..]);
        }
        matching
    }

    /// Number of keys in both lists together.
    pub fn len(&self) -> usize {
        2 * self.pairs.len() + self.lost.len() + self.gained.len()
    }

    /// Whether both lists are empty.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether every key of each list has a partner in the other.
    pub fn is_whole(&self) -> bool {
        self.lost.is_empty() && self.gained.is_empty()
    }

    /// Returns the share of keys of both lists that are in a pair, 0 to 1 (F1); 1 for two empty lists.
    pub fn kept(&self) -> f64 {
        if self.is_empty() { 1.0 } else { (2 * self.pairs.len()) as f64 / self.len() as f64 }
    }

    /// Returns how far the keys of each pair are apart, in frames.
    pub fn moves(&self) -> impl Iterator<Item = usize> + '_ {
        self.pairs.iter().map(|(before, after)| before.0.abs_diff(after.0))
    }

    /// Returns how far a key moves on average, in frames; `None` without a pair.
    pub fn mean_move(&self) -> Option<f64> {
        let sum: usize = self.moves().sum();
        (!self.pairs.is_empty()).then(|| sum as f64 / self.pairs.len() as f64)
    }

    /// Returns how far a key moves at most, in frames; `None` without a pair.
    pub fn largest_move(&self) -> Option<usize> {
        self.moves().max()
    }

    /// Adds the best matching of two short lists.
    fn add(&mut self, before: &[Frame], after: &[Frame], tolerance: f64) {
        let wide = after.len() + 1;
        // Best matching of the keys from each pair of places on: number of pairs, and their total distance.
        let mut best = vec![(0usize, Reverse(0usize)); (before.len() + 1) * wide];
        let pair = |i: usize, j: usize, best: &[(usize, Reverse<usize>)]| {
            let way = before[i].0.abs_diff(after[j].0);
            let (pairs, Reverse(ways)) = best[(i + 1) * wide + j + 1];
            (way as f64 <= tolerance).then_some((pairs + 1, Reverse(ways + way)))
        };
        for i in (0..before.len()).rev() {
            for j in (0..after.len()).rev() {
                let alone = best[(i + 1) * wide + j].max(best[i * wide + j + 1]);
                best[i * wide + j] = pair(i, j, &best).map_or(alone, |paired| paired.max(alone));
            }
        }
        let (mut i, mut j) = (0, 0);
        while i < before.len() && j < after.len() {
            let now = best[i * wide + j];
            if pair(i, j, &best) == Some(now) {
                self.pairs.push((before[i], after[j]));
                (i, j) = (i + 1, j + 1);
            } else if best[(i + 1) * wide + j] == now {
                self.lost.push(before[i]);
                i += 1;
            } else {
                self.gained.push(after[j]);
                j += 1;
            }
        }
        self.lost.extend(&before[i..]);
        self.gained.extend(&after[j..]);
    }
}

/// Counts the keys of each list before the first gap that no pair can bridge; at least one in all.
fn first_cluster(before: &[Frame], after: &[Frame], tolerance: f64) -> (usize, usize) {
    let (mut i, mut j) = (0, 0);
    let mut last: Option<Frame> = None;
    loop {
        let next = match (before.get(i), after.get(j)) {
            (Some(these), Some(those)) => *these.min(those),
            (Some(frame), None) | (None, Some(frame)) => *frame,
            (None, None) => return (i, j),
        };
        if last.is_some_and(|last| (next.0 - last.0) as f64 > tolerance) {
            return (i, j);
        }
        if before.get(i) == Some(&next) {
            i += 1;
        } else {
            j += 1;
        }
        last = Some(next);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn frames(numbers: &[usize]) -> Vec<Frame> {
        numbers.iter().copied().map(Frame).collect()
    }

    fn matching(before: &[usize], after: &[usize], tolerance: f64) -> Matching {
        Matching::between(&frames(before), &frames(after), tolerance)
    }

    /// Finds the most pairs and the least distance by trying every partner for every key, in any order.
    fn by_force(before: &[Frame], after: &[Frame], tolerance: f64) -> (usize, Reverse<usize>) {
        let Some((first, rest)) = before.split_first() else { return (0, Reverse(0)) };
        let mut best = by_force(rest, after, tolerance);
        for (at, partner) in after.iter().enumerate() {
            let way = first.0.abs_diff(partner.0);
            if way as f64 <= tolerance {
                let others = [&after[..at], &after[at + 1..]].concat();
                let (pairs, Reverse(ways)) = by_force(rest, &others, tolerance);
                best = best.max((pairs + 1, Reverse(ways + way)));
            }
        }
        best
    }

    #[test]
    fn keys_that_moved_are_paired_and_the_others_named() {
        let found = matching(&[10, 50, 90], &[12, 88, 130], 5.0);
        assert_eq!(found.pairs, [(Frame(10), Frame(12)), (Frame(90), Frame(88))]);
        assert_eq!((&found.lost[..], &found.gained[..]), (&[Frame(50)][..], &[Frame(130)][..]));
        assert_eq!((found.mean_move(), found.largest_move()), (Some(2.0), Some(2)));
        assert_eq!(found.kept(), 4.0 / 6.0);
        assert!(!found.is_whole());
        assert!(!matching(&[10], &[10, 50], 5.0).is_whole(), "one alone in the second list");
        assert!(!matching(&[10, 50], &[10], 5.0).is_whole(), "one alone in the first list");
    }

    #[test]
    fn the_tolerance_is_included_and_may_be_a_part_of_a_frame() {
        assert_eq!(matching(&[10], &[15], 5.0).pairs.len(), 1);
        assert_eq!(matching(&[10], &[15], 4.99).pairs.len(), 0);
        assert!(matching(&[7, 9], &[7, 9], 0.0).is_whole());
    }

    #[test]
    fn more_pairs_come_before_nearer_ones() {
        // 12 is nearest to 13, but then 10 would have no partner.
        assert_eq!(
            matching(&[10, 13], &[12, 17], 4.0).pairs,
            [(Frame(10), Frame(12)), (Frame(13), Frame(17))]
        );
        // A chain in which every key must take the next one.
        assert_eq!(matching(&[0, 5, 10, 15], &[5, 10, 15, 20], 5.0).pairs.len(), 4);
    }

    #[test]
    fn empty_lists_are_the_same() {
        let nothing = matching(&[], &[], 5.0);
        assert!(nothing.is_empty() && nothing.is_whole());
        assert_eq!(
            (nothing.kept(), nothing.mean_move(), nothing.largest_move()),
            (1.0, None, None)
        );
        assert_eq!(matching(&[3], &[], 5.0).kept(), 0.0);
    }

    proptest! {
        #[test]
        fn no_other_matching_is_better(
            mut before in prop::collection::vec(0usize..40, 0..7),
            mut after in prop::collection::vec(0usize..40, 0..7),
            tolerance in prop_oneof![Just(0.0), 0.0..12.0, Just(100.0)],
        ) {
            before.sort_unstable();
            after.sort_unstable();
            let (before, after) = (frames(&before), frames(&after));
            let found = Matching::between(&before, &after, tolerance);
            let way = found.moves().sum();
            prop_assert_eq!((found.pairs.len(), Reverse(way)), by_force(&before, &after, tolerance));
            prop_assert!(found.moves().all(|way| way as f64 <= tolerance));
            let mut again: Vec<Frame> = found.pairs.iter().map(|pair| pair.0).collect();
            again.extend(&found.lost);
            again.sort_unstable();
            prop_assert_eq!(again, before);
            let mut again: Vec<Frame> = found.pairs.iter().map(|pair| pair.1).collect();
            again.extend(&found.gained);
            again.sort_unstable();
            prop_assert_eq!(again, after);
        }
    }
}
