//! Scales: from values to px, and the round numbers to write beside them.

/// A straight scale from values to px.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// `low` stands at `from`, `high` at `to`. A range without extent is widened by 1.
    pub(super) fn new((low, high): (f64, f64), (from, to): (f64, f64)) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Self { low, high, from, to }
    }

    /// The px of a value.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Round values in the range, at least `px` apart.
    pub(super) fn ticks(&self, px: f64) -> Vec<f64> {
        let most = ((self.to - self.from).abs() / px).max(1.0);
        let step = round_step((self.high - self.low) / most);
        let first = (self.low / step - 1e-9).ceil();
        let count = ((self.high / step + 1e-9).floor() - first).max(-1.0) as usize;
        // Multiples of the step, not sums of it, so that 0.3 is 0.3.
        (0..=count)
            .map(|tick| (first + tick as f64) * step)
            .filter(|tick| *tick <= self.high * (1.0 + 1e-9) + 1e-12)
            .collect()
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is no smaller.
pub(super) fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.max(1e-12).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0];
    steps
        .into_iter()
        .map(|step| step * power)
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

/// The number with no more decimals than it needs.
pub(super) fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

/// The range of some values, 0 included; 0 to 1 when there is nothing but 0.
pub(super) fn range_with_zero(values: &[f64]) -> (f64, f64) {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let (low, high) =
        finite.fold((0.0, 0.0), |(low, high): (f64, f64), value| (low.min(value), high.max(value)));
    if low == high { (0.0, 1.0) } else { (low, high) }
}
