//! Interpolates a value over time between the keys that set it.

/// Three values over time: minimum-jerk pieces between keys.
///
/// Between two rests a piece is the minimum-jerk curve of human reaching. At a key that is passed through, the slope is
/// the harmonic mean of the slopes on both sides, so a value never overshoots a key.
#[derive(Default)]
pub(crate) struct Track {
    times: Vec<f64>,
    values: Vec<[f64; 3]>,
    slopes: Vec<[f64; 3]>,
}

impl Track {
    /// Builds a track through keys in order of time.
    pub(crate) fn new(keys: &[(f64, [f64; 3])]) -> Self {
        let times: Vec<f64> = keys.iter().map(|key| key.0).collect();
        let values: Vec<[f64; 3]> = keys.iter().map(|key| key.1).collect();
        let rise = |from: usize, axis: usize| {
            (values[from + 1][axis] - values[from][axis]) / (times[from + 1] - times[from])
        };
        let slope = |at: usize, axis: usize| {
            if at == 0 || at + 1 == times.len() {
                return 0.0;
            }
            let (before, after) = (rise(at - 1, axis), rise(at, axis));
            if before * after <= 0.0 { 0.0 } else { 2.0 * before * after / (before + after) }
        };
        let slopes = (0..times.len()).map(|at| [0, 1, 2].map(|axis| slope(at, axis))).collect();
        Self { times, values, slopes }
    }

    /// The value at a time; constant before the first key and after the last.
    pub(crate) fn at(&self, time: f64) -> [f64; 3] {
        let next = self.times.partition_point(|&at| at <= time);
        if next == 0 {
            return self.values[0];
        }
        if next == self.times.len() {
            return self.values[next - 1];
        }
        let (from, span) = (next - 1, self.times[next] - self.times[next - 1]);
        let share = (time - self.times[from]) / span;
        [0, 1, 2].map(|axis| {
            quintic(
                self.values[from][axis],
                self.slopes[from][axis] * span,
                self.values[next][axis],
                self.slopes[next][axis] * span,
                share,
            )
        })
    }
}

/// Interpolates from one value and slope to another in unit time, without acceleration at either end.
fn quintic(from: f64, from_slope: f64, to: f64, to_slope: f64, u: f64) -> f64 {
    let rise = to - from;
    let (u3, u4, u5) = (u * u * u, u * u * u * u, u * u * u * u * u);
    from + from_slope * u
        + (10.0 * rise - 6.0 * from_slope - 4.0 * to_slope) * u3
        + (-15.0 * rise + 8.0 * from_slope + 7.0 * to_slope) * u4
        + (6.0 * rise - 3.0 * from_slope - 3.0 * to_slope) * u5
}

/// Rises from 0 to 1 over `from..to` along a minimum-jerk curve.
pub(crate) fn ease(time: f64, from: f64, to: f64) -> f64 {
    quintic(0.0, 0.0, 1.0, 0.0, ((time - from) / (to - from)).clamp(0.0, 1.0))
}
