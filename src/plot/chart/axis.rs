//! The values along one side of a chart, and what is written beside them.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::ticks::round_values;

/// One side of a chart.
#[derive(Clone)]
pub(in crate::plot) struct Axis {
    low: f64,
    high: f64,
    /// Values with what is written beside each.
    pub(super) ticks: Vec<(f64, String)>,
    /// Whether a line goes through the chart at each.
    pub(super) lines: bool,
    /// What is written below all.
    pub(super) name: String,
}

impl Axis {
    /// Words at some values, with a line at each. A range without extent is widened by 1; one that is no number is 0 to 1.
    pub(in crate::plot) fn labelled((low, high): (f64, f64), ticks: Vec<(f64, String)>) -> Self {
        let is_finite = low.is_finite() && high.is_finite();
        let (low, high) = if is_finite { (low, high) } else { (0.0, 1.0) };
        let high = if high > low { high } else { low + 1.0 };
        Self { low, high, ticks, lines: true, name: String::new() }
    }

    /// Round values: at most as many as `most`, where that is more than 2.
    pub(in crate::plot) fn round(range: (f64, f64), most: f64) -> Self {
        let axis = Self::labelled(range, vec![]);
        let values = round_values((axis.low, axis.high), most.max(2.0) as usize);
        let ticks = values.into_iter().map(|value| (value, number(value))).collect();
        Self { ticks, ..axis }
    }

    /// The same with other words at its values.
    pub(in crate::plot) fn written(mut self, word: impl Fn(f64) -> String) -> Self {
        self.ticks.iter_mut().for_each(|(value, words)| *words = word(*value));
        self
    }

    /// The same without lines through the chart.
    pub(in crate::plot) fn plain(self) -> Self {
        Self { lines: false, ..self }
    }

    /// The same with words below it.
    pub(in crate::plot) fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    /// Where a value stands between two px.
    pub(in crate::plot) fn at(&self, value: f64, (from, to): (f64, f64)) -> f64 {
        from + (value - self.low) / (self.high - self.low) * (to - from)
    }
}

/// The axis as the library has it.
impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        self.at(*value, (f64::from(from), f64::from(to))).round() as i32
    }

    /// There are no lines but those at the ticks.
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

/// The number with no more decimals than it needs.
pub(in crate::plot) fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

/// The range of some values, 0 included; 0 to 1 when there is nothing but 0.
pub(in crate::plot) fn range_with_zero(values: &[f64]) -> (f64, f64) {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let (low, high) =
        finite.fold((0.0, 0.0), |(low, high): (f64, f64), value| (low.min(value), high.max(value)));
    if low == high { (0.0, 1.0) } else { (low, high) }
}
