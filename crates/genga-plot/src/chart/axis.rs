//! Defines the values along one side of a chart, and their labels.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::ticks::round_values;

/// An axis of a chart.
#[derive(Clone)]
pub(crate) struct Axis {
    low: f64,
    high: f64,
    /// Values and their labels.
    pub(super) ticks: Vec<(f64, String)>,
    /// Whether a line runs through the chart at each tick.
    pub(super) lines: bool,
    /// Name written below the axis.
    pub(super) name: String,
}

impl Axis {
    /// Builds an axis with a label and a line at each of some values. A range without extent is widened by 1.
    /// A range that is not finite becomes 0 to 1.
    pub(crate) fn labelled((low, high): (f64, f64), ticks: Vec<(f64, String)>) -> Self {
        let is_finite = low.is_finite() && high.is_finite();
        let (low, high) = if is_finite { (low, high) } else { (0.0, 1.0) };
        let high = if high > low { high } else { low + 1.0 };
        Self { low, high, ticks, lines: true, name: String::new() }
    }

    /// Builds an axis of round values, at most `most` or 2, whichever is greater.
    pub(crate) fn round(range: (f64, f64), most: f64) -> Self {
        let axis = Self::labelled(range, vec![]);
        let values = round_values((axis.low, axis.high), most.max(2.0) as usize);
        let ticks = values.into_iter().map(|value| (value, number(value))).collect();
        Self { ticks, ..axis }
    }

    /// Replaces the labels by those that `word` gives.
    pub(crate) fn written(mut self, word: impl Fn(f64) -> String) -> Self {
        self.ticks.iter_mut().for_each(|(value, words)| *words = word(*value));
        self
    }

    /// Removes the lines through the chart.
    pub(crate) fn plain(self) -> Self {
        Self { lines: false, ..self }
    }

    /// Adds a name below the axis.
    pub(crate) fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    /// Returns the place of a value between two px.
    pub(crate) fn at(&self, value: f64, (from, to): (f64, f64)) -> f64 {
        from + (value - self.low) / (self.high - self.low) * (to - from)
    }
}

/// Lets the chart library use the axis.
impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        self.at(*value, (f64::from(from), f64::from(to))).round() as i32
    }

    /// Returns the ticks. Finer lines do not exist.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let is_finer = hint.weight().allow_light_points();
        if is_finer { Vec::new() } else { self.ticks.iter().map(|tick| tick.0).collect() }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().find(|tick| tick.0 == *value);
        tick.map(|tick| tick.1.clone()).unwrap_or_default()
    }
}

/// Formats a number with no more decimals than it needs.
pub(crate) fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

/// Returns the top of a scale that a glitch does not set: the greatest of some values or, if that is more than twice
/// the value that a fiftieth of them and at least `lasting` of them reach, a quarter above that value.
///
/// Values below 0 count as 0.
pub(crate) fn robust_top(values: impl IntoIterator<Item = f64>, lasting: usize) -> f64 {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let mut values: Vec<f64> = finite.map(|value| value.max(0.0)).collect();
    let count = lasting.max(values.len() / 50).clamp(1, values.len().max(1));
    if values.is_empty() {
        return 0.0;
    }
    values.sort_unstable_by(|a, b| b.total_cmp(a));
    let (greatest, reached) = (values[0], values[count - 1]);
    if reached > 0.0 && greatest > 2.0 * reached { 1.25 * reached } else { greatest }
}

/// Returns the range of some values, 0 included; 0 to 1 if all of them are 0.
pub(crate) fn range_with_zero(values: &[f64]) -> (f64, f64) {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let (low, high) =
        finite.fold((0.0, 0.0), |(low, high): (f64, f64), value| (low.min(value), high.max(value)));
    if low == high { (0.0, 1.0) } else { (low, high) }
}
