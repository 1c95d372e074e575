//! Maps columns of the motion table to channels of the skeleton.

use std::ops::Range;

use crate::motion::{Axis, Channel};

/// The columns of a file's motion table. Columns of an unknown channel, of an End Site or of an unwanted
/// tree are skipped.
#[derive(Debug, Default)]
pub(super) struct Columns {
    width: usize,
    /// Ranges of the kept columns, in order and never adjacent; an ordinary file has a single range.
    kept: Vec<Range<usize>>,
}

impl Columns {
    /// Number of columns in the file.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Adds a column on the right.
    pub(super) fn push(&mut self, is_kept: bool) {
        let column = self.width;
        self.width += 1;
        match self.kept.last_mut() {
            _ if !is_kept => {}
            Some(range) if range.end == column => range.end += 1,
            _ => self.kept.push(column..column + 1),
        }
    }

    /// Keeps only a range of channels, counted among the kept ones.
    pub(super) fn select(&mut self, channels: Range<usize>) {
        let mut first = 0;
        for range in &mut self.kept {
            let (begin, length) = (range.start, range.len());
            let within = |channel: usize| channel.clamp(first, first + length) - first;
            *range = begin + within(channels.start)..begin + within(channels.end);
            first += length;
        }
        self.kept.retain(|range| !range.is_empty());
    }

    /// The channel index of a column of the file, counted among the kept ones.
    pub(super) fn channel(&self, column: usize) -> Option<usize> {
        let mut first = 0;
        for range in &self.kept {
            if range.contains(&column) {
                return Some(first + column - range.start);
            }
            first += range.len();
        }
        None
    }

    /// Removes the skipped columns from a table of whole rows.
    pub(super) fn compact(&self, values: &mut Vec<f64>) {
        if matches!(&self.kept[..], [all] if *all == (0..self.width)) {
            return;
        }
        let mut length = 0;
        for row in (0..values.len()).step_by(self.width.max(1)) {
            for range in &self.kept {
                values.copy_within(row + range.start..row + range.end, length);
                length += range.len();
            }
        }
        values.truncate(length);
    }
}

/// Parses a channel name, in upper or lower case.
pub(super) fn channel(name: &[u8]) -> Option<Channel> {
    let (axis, kind) = name.split_first()?;
    let axis = match axis.to_ascii_uppercase() {
        b'X' => Axis::X,
        b'Y' => Axis::Y,
        b'Z' => Axis::Z,
        _ => return None,
    };
    if kind.eq_ignore_ascii_case(b"position") {
        Some(Channel::Position(axis))
    } else if kind.eq_ignore_ascii_case(b"rotation") {
        Some(Channel::Rotation(axis))
    } else {
        None
    }
}

/// Whether a word looks like a channel name, known or unknown, such as `Xscale`.
pub(super) fn is_like_a_channel(name: &[u8]) -> bool {
    match name {
        [b'X' | b'Y' | b'Z' | b'x' | b'y' | b'z', kind @ ..] => {
            !kind.is_empty() && kind.iter().all(u8::is_ascii_alphabetic)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(kept: &str) -> Columns {
        let mut columns = Columns::default();
        kept.bytes().for_each(|letter| columns.push(letter == b'k'));
        columns
    }

    fn compacted(columns: &Columns, rows: usize) -> Vec<f64> {
        let mut values = (0..rows * columns.width()).map(|value| value as f64).collect();
        columns.compact(&mut values);
        values
    }

    #[test]
    fn columns_that_are_not_kept_are_taken_out_of_every_row() {
        assert_eq!(compacted(&columns("kkk"), 2), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(compacted(&columns("-k-kk-"), 2), [1.0, 3.0, 4.0, 7.0, 9.0, 10.0]);
        assert!(compacted(&columns("--"), 2).is_empty());
        assert!(compacted(&columns("-k"), 0).is_empty());
    }

    #[test]
    fn a_selection_counts_among_the_kept() {
        let mut columns = columns("k-kk-kkk");
        assert_eq!([3, 5].map(|column| columns.channel(column)), [Some(2), Some(3)]);
        columns.select(2..4);
        assert_eq!(compacted(&columns, 1), [3.0, 5.0]);
        assert_eq!((0..8).map(|column| columns.channel(column)).filter(Option::is_some).count(), 2);
    }
}
