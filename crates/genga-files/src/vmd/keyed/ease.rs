//! MMD's curve from key to key (補間曲線).

use super::super::record::LINEAR_CURVE;

/// First coordinates of the two handles of a fitted curve, of 127. At a third and two thirds of the time a curve's
/// parameter is the time itself, so that its heights are found by linear least squares.
const THIRDS: [u8; 2] = [42, 85];

/// Weight of a straight line beside the samples of a span. It decides only where there are too few.
const RIDGE: f64 = 1e-6;

/// Part of a whole, unless the whole is nothing.
pub(super) fn share(part: f64, whole: f64) -> Option<f64> {
    (whole.abs() > 1e-9).then_some(part / whole)
}

/// A curve from key to key: the heights of its two handles, of 127; `None` is a straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ease(Option<[u8; 2]>);

impl Ease {
    /// Fits a curve to how much of the way is done on each frame.
    pub(super) fn fit([first, last]: [usize; 2], done: impl Fn(usize) -> Option<f64>) -> Self {
        let (mut early, mut late, mut both) = (RIDGE, RIDGE, 0.0);
        let mut sums = [RIDGE / 3.0, 2.0 * RIDGE / 3.0];
        for frame in first + 1..last {
            let time = (frame - first) as f64 / (last - first) as f64;
            let Some(done) = done(frame) else { return Self(None) };
            let [a, b] = weights(time);
            let rest = done - time.powi(3);
            early += a * a;
            both += a * b;
            late += b * b;
            sums[0] += a * rest;
            sums[1] += b * rest;
        }
        let whole = early * late - both * both;
        let heights =
            [(sums[0] * late - sums[1] * both) / whole, (sums[1] * early - sums[0] * both) / whole];
        let byte = |height: f64| (127.0 * height).round().clamp(0.0, 127.0) as u8;
        let heights = heights.map(byte);
        Self((heights != THIRDS).then_some(heights))
    }

    /// How much of the way is done at a share of the time.
    pub(super) fn done(self, time: f64) -> f64 {
        let Some(heights) = self.0 else { return time };
        let [early, late] = heights.map(|height| f64::from(height) / 127.0);
        let [a, b] = weights(time);
        a * early + b * late + time.powi(3)
    }

    /// The four coordinates of the handles.
    pub(super) fn bytes(self) -> [u8; 4] {
        match self.0 {
            Some([early, late]) => [THIRDS[0], early, THIRDS[1], late],
            None => LINEAR_CURVE,
        }
    }
}

/// Weights of the two handles at a share of the time.
fn weights(time: f64) -> [f64; 2] {
    let rest = 1.0 - time;
    [3.0 * rest * rest * time, 3.0 * rest * time * time]
}
