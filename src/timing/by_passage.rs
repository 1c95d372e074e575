//! Settings that change along the sheet (区間ごと): some in each passage, others elsewhere.

use std::ops::Range;

/// A value for each koma of a sheet, constant over stretches. A drawing takes the value of its first koma.
#[derive(Debug, Clone, PartialEq)]
pub struct ByPassage<T> {
    /// The first koma of each stretch, with the value that holds from there. The first begins on koma 0, and no two
    /// neighbours are equal.
    stretches: Vec<(usize, T)>,
}

impl<T> From<T> for ByPassage<T> {
    /// Creates a value that is the same everywhere.
    fn from(value: T) -> Self {
        Self { stretches: vec![(0, value)] }
    }
}

impl<T: PartialEq> ByPassage<T> {
    /// Creates a value that changes at the ends of some ranges of koma. `value` gives it for each koma at which one
    /// begins or ends.
    pub fn new(passages: &[Range<usize>], value: impl Fn(usize) -> T) -> Self {
        let mut begins: Vec<usize> =
            passages.iter().flat_map(|koma| [koma.start, koma.end]).chain([0]).collect();
        begins.sort_unstable();
        let mut stretches: Vec<(usize, T)> =
            begins.into_iter().map(|koma| (koma, value(koma))).collect();
        stretches.dedup_by(|next, before| next.1 == before.1);
        Self { stretches }
    }
}

impl<T> ByPassage<T> {
    /// Returns the value of a koma.
    pub fn at(&self, koma: usize) -> &T {
        let stretch = self.stretches.partition_point(|(begin, _)| *begin <= koma);
        &self.stretches[stretch - 1].1
    }

    /// Returns every value in the order of the koma.
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.stretches.iter().map(|(_, value)| value)
    }

    /// Returns the koma at which the value changes.
    pub fn changes(&self) -> impl Iterator<Item = usize> {
        self.stretches.iter().skip(1).map(|(begin, _)| *begin)
    }

    /// Derives another value from each.
    pub fn map<U>(&self, derive: impl Fn(&T) -> U) -> ByPassage<U> {
        let derived = |(begin, value): &(usize, T)| (*begin, derive(value));
        ByPassage { stretches: self.stretches.iter().map(derived).collect() }
    }

    /// Whether the value stays the same from one koma up to, not including, another.
    pub fn is_one(&self, from: usize, to: usize) -> bool {
        !self.changes().any(|begin| from < begin && begin < to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_holds_from_the_begin_of_its_stretch_up_to_the_next() {
        let by = ByPassage::new(&[4..9, 6..12], |koma| match koma {
            4..6 => 'a',
            6..12 => 'b',
            _ => '-',
        });
        let line: String = (0..14).map(|koma| by.at(koma)).collect();
        assert_eq!(line, "----aabbbbbb--");
        assert_eq!(by.values().collect::<String>(), "-ab-", "equal neighbours are one");
        let ends = [(0, 4), (4, 6), (5, 6), (7, 12), (3, 5), (11, 13)];
        assert_eq!(
            ends.map(|(from, to)| by.is_one(from, to)),
            [true, true, true, true, false, false]
        );
        assert_eq!(by.map(|value| *value == '-').at(9), &false);
        assert_eq!(ByPassage::from(7).at(usize::MAX), &7);
    }
}
