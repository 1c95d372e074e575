//! A winner tree: the least of many values, over all or over a range, while single values change.

use std::ops::Range;

/// The value of an excluded entry.
pub(super) const OUT: f64 = f64::INFINITY;

/// The least of many values, in O(log n) per change or query; of equal values, the earliest.
///
/// A complete binary tree in one flat table: node `i` has the children `2i` and `2i + 1` and holds
/// the lesser of their values; the entries are its leaves, padded to a power of two with [`OUT`].
pub(super) struct Tournament {
    leaves: usize,
    least: Vec<f64>,
}

impl Tournament {
    /// Builds a tree of values.
    pub(super) fn new(values: impl ExactSizeIterator<Item = f64>) -> Self {
        let leaves = values.len().next_power_of_two();
        let mut least = vec![OUT; 2 * leaves];
        for (leaf, value) in least[leaves..].iter_mut().zip(values) {
            *leaf = value;
        }
        for node in (1..leaves).rev() {
            least[node] = lesser(least[2 * node], least[2 * node + 1]);
        }
        Self { leaves, least }
    }

    /// Changes one value.
    pub(super) fn set(&mut self, entry: usize, value: f64) {
        let mut node = self.leaves + entry;
        self.least[node] = value;
        while node > 1 {
            node /= 2;
            let least = lesser(self.least[2 * node], self.least[2 * node + 1]);
            if self.least[node] == least {
                return;
            }
            self.least[node] = least;
        }
    }

    /// Returns the entry with the least value, and that value; `None` if all are [`OUT`].
    pub(super) fn best(&self) -> Option<(usize, f64)> {
        self.winner(1)
    }

    /// Like [`Self::best`], among the entries of a range.
    pub(super) fn best_in(&self, range: Range<usize>) -> Option<(usize, f64)> {
        let (mut from, mut past) = (self.leaves + range.start, self.leaves + range.end);
        // The range is a row of whole subtrees, taken from its left and right end on the way up.
        let (mut left, mut right) = (None, None);
        while from < past {
            if from % 2 == 1 {
                left = self.earlier(left, Some(from));
                from += 1;
            }
            if past % 2 == 1 {
                past -= 1;
                right = self.earlier(Some(past), right);
            }
            from /= 2;
            past /= 2;
        }
        self.winner(self.earlier(left, right)?)
    }

    /// Returns the node with the lesser value; the first on a tie.
    fn earlier(&self, first: Option<usize>, second: Option<usize>) -> Option<usize> {
        match (first, second) {
            (Some(a), Some(b)) => Some(if self.least[b] < self.least[a] { b } else { a }),
            _ => first.or(second),
        }
    }

    /// Returns the first entry below a node that holds the node's value.
    fn winner(&self, mut node: usize) -> Option<(usize, f64)> {
        let value = self.least[node];
        if value == OUT {
            return None;
        }
        while node < self.leaves {
            node *= 2;
            if self.least[node] != value {
                node += 1;
            }
        }
        Some((node - self.leaves, value))
    }
}

fn lesser(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn slow(values: &[f64], range: Range<usize>) -> Option<(usize, f64)> {
        let mut best = None;
        for entry in range {
            let value = values[entry];
            if value != OUT && best.is_none_or(|(_, least)| value < least) {
                best = Some((entry, value));
            }
        }
        best
    }

    #[test]
    fn a_tree_of_nothing_has_no_best() {
        let tree = Tournament::new([].into_iter());
        assert_eq!(tree.best(), None);
        assert_eq!(tree.best_in(0..0), None);
        assert_eq!(Tournament::new([OUT; 3].into_iter()).best(), None);
        assert_eq!(Tournament::new([2.0].into_iter()).best(), Some((0, 2.0)));
    }

    fn value() -> impl Strategy<Value = f64> {
        prop_oneof![4 => (-2..3i32).prop_map(f64::from), 1 => Just(OUT)]
    }

    proptest! {
        #[test]
        fn the_tree_answers_as_a_search_through_all_values(
            mut values in prop::collection::vec(value(), 1..40),
            changes in prop::collection::vec((any::<prop::sample::Index>(), value()), 0..40),
        ) {
            let mut tree = Tournament::new(values.iter().copied());
            for (entry, value) in changes {
                let entry = entry.index(values.len());
                values[entry] = value;
                tree.set(entry, value);
                prop_assert_eq!(tree.best(), slow(&values, 0..values.len()));
                for begin in 0..=values.len() {
                    for end in begin..=values.len() {
                        prop_assert_eq!(tree.best_in(begin..end), slow(&values, begin..end));
                    }
                }
            }
        }
    }
}
