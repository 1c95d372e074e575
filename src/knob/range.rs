//! The valid range of a knob's numbers.

use std::fmt;
use std::ops::Bound::{self, Excluded, Included, Unbounded};
use std::ops::RangeBounds;

/// A range of valid numbers; infinity is excluded unless `to` is unbounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    pub(super) from: Bound<f64>,
    /// `Unbounded` also admits infinity.
    pub(super) to: Bound<f64>,
}

impl Range {
    /// 0 or more.
    pub(super) const LENGTH: Self = Self { from: Included(0.0), to: Excluded(f64::INFINITY) };

    /// Returns the lower bound.
    pub const fn least(self) -> f64 {
        end(self.from)
    }

    /// Returns the upper bound; infinity if there is none.
    pub const fn most(self) -> f64 {
        end(self.to)
    }

    /// Whether the range contains a number.
    pub fn contains(self, number: f64) -> bool {
        (self.from, self.to).contains(&number)
    }
}

const fn end(bound: Bound<f64>) -> f64 {
    match bound {
        Included(end) | Excluded(end) => end,
        Unbounded => f64::INFINITY,
    }
}

/// Describes the range in words, as `2 to 1000` or `0 or more`.
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_open = matches!(self.from, Excluded(_));
        write!(f, "{}{}", if is_open { "above " } else { "" }, self.least())?;
        match self.to {
            Excluded(f64::INFINITY) if is_open => Ok(()),
            Excluded(f64::INFINITY) => write!(f, " or more"),
            Included(most) => write!(f, " to {most}"),
            Excluded(bound) => write!(f, " to below {bound}"),
            Unbounded => write!(f, ", or inf for no limit"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_says_what_it_contains() {
        let length = Range::LENGTH;
        let (inf, nan) = (f64::INFINITY, f64::NAN);
        let range = |from, to| Range { from, to };
        for (range, words, inside, outside) in [
            (length, "0 or more", [0.0, 1e300], [-0.1, inf]),
            (range(Excluded(0.0), Excluded(inf)), "above 0", [1e-300, 5.0], [0.0, inf]),
            (range(Included(2.0), Included(1e3)), "2 to 1000", [2.0, 1e3], [1.9, 1000.1]),
            (range(Included(0.0), Excluded(1.0)), "0 to below 1", [0.0, 0.99], [-0.1, 1.0]),
            (
                range(Excluded(0.0), Unbounded),
                "above 0, or inf for no limit",
                [0.1, inf],
                [0.0, -inf],
            ),
        ] {
            assert_eq!(range.to_string(), words);
            assert!(inside.into_iter().all(|number| range.contains(number)), "{words}");
            assert!(
                !outside.into_iter().chain([nan]).any(|number| range.contains(number)),
                "{words}"
            );
        }
    }
}
