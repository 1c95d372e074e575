//! Stillness (静止): how long a speed stays below a limit.

use std::ops::Range;

/// Least duration of a stillness, in seconds.
pub(super) const LEAST: f64 = 0.5;

/// Seconds over which a speed is averaged, so that one tremble does not cut a stillness in two.
pub(super) const SMOOTH: f64 = 0.125;

/// Converts seconds to steps.
pub(super) fn steps(seconds: f64, steps_a_second: f64) -> usize {
    (seconds * steps_a_second).round() as usize
}

/// Returns the runs of places at which a condition holds.
pub(super) fn runs(len: usize, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for at in (0..len).filter(|at| holds(*at)) {
        match runs.last_mut() {
            Some(run) if run.end == at => run.end = at + 1,
            _ => runs.push(at..at + 1),
        }
    }
    runs
}

/// Returns a centred mean over `over` + 1 values, over fewer at the ends.
pub(super) fn smoothed(values: &[f64], over: usize) -> Vec<f64> {
    let mean = |at: usize| {
        let near = &values[at.saturating_sub(over / 2)..(at + over / 2 + 1).min(values.len())];
        near.iter().sum::<f64>() / near.len() as f64
    };
    (0..values.len()).map(mean).collect()
}
