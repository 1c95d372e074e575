//! Gaussian-like smoothing whose cost does not depend on its width.

/// Rounding residue of the running sums, relative to the largest value that went through them.
const DUST: f64 = 1e-11;

/// Three successive moving averages that together have exactly the requested variance: an extended box filter (Gwosdek,
/// Grewenig, Bruhn and Weickert 2011). The outermost samples of each box count fractionally.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Smooth {
    /// Whole samples on each side of the middle.
    reach: usize,
    /// The weight of the samples just beyond them, 0 to 1.
    rest: f64,
}

impl Smooth {
    /// Creates the filter for a standard deviation in samples, above 0.
    pub(super) fn new(sigma: f64) -> Self {
        // The variance of each of the three averages. A window of r samples to each side has the variance r(r + 1)/3.
        let variance = sigma * sigma / 3.0;
        let reach = (((1.0 + 12.0 * variance).sqrt() - 1.0) / 2.0).floor();
        let whole = 2.0 * reach + 1.0;
        let inside = reach * (reach + 1.0) * whole / 3.0;
        let beyond = (reach + 1.0) * (reach + 1.0);
        let rest = (variance * whole - inside) / (2.0 * (beyond - variance));
        Self { reach: reach as usize, rest: rest.clamp(0.0, 1.0) }
    }

    /// Smooths a signal and multiplies it by `gain`. The signal is 0 at both ends and continues beyond them with odd
    /// symmetry (… −c −b 0 b c …). `room` is a buffer.
    pub(super) fn apply(self, signal: &mut [f64], gain: f64, room: &mut Vec<f64>) {
        let largest = signal.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        if largest == 0.0 {
            return;
        }
        for _ in 0..3 {
            self.average(signal, room);
        }
        // A signal at rest far from any movement must stay exactly at rest.
        for value in signal {
            *value = if value.abs() > DUST * largest { gain * *value } else { 0.0 };
        }
    }

    /// Computes one moving average.
    fn average(self, signal: &mut [f64], room: &mut Vec<f64>) {
        let (last, beyond) = (signal.len() - 1, self.reach + 1);
        let whole = 2 * self.reach + 1;
        room.clear();
        room.extend((1..=beyond).rev().map(|at| -folded(signal, at)));
        room.extend_from_slice(signal);
        room.extend((1..=beyond).map(|at| folded(signal, last + at)));
        let mut sum: f64 = room[1..=whole].iter().sum();
        let per_width = 1.0 / (whole as f64 + 2.0 * self.rest);
        for (at, value) in signal.iter_mut().enumerate() {
            let (before, after) = (room[at], room[at + whole + 1]);
            *value = (sum + self.rest * (before + after)) * per_width;
            sum += after - room[at + 1];
        }
        (signal[0], signal[last]) = (0.0, 0.0);
    }
}

/// Returns a signal of two or more samples at a place at or beyond its ends.
fn folded(signal: &[f64], at: usize) -> f64 {
    let last = signal.len() - 1;
    match at % (2 * last) {
        inside if inside <= last => signal[inside],
        turned => -signal[2 * last - turned],
    }
}

#[cfg(test)]
impl Smooth {
    /// Returns the filter's weights by definition: the box convolved three times.
    pub(super) fn bell(self) -> Vec<f64> {
        let mut window = vec![1.0; 2 * self.reach + 3];
        let last = window.len() - 1;
        (window[0], window[last]) = (self.rest, self.rest);
        let width: f64 = window.iter().sum();
        let mut bell = vec![1.0];
        for _ in 0..3 {
            let mut wider = vec![0.0; bell.len() + window.len() - 1];
            for (at, weight) in bell.iter().enumerate() {
                for (by, other) in window.iter().enumerate() {
                    wider[at + by] += weight * other / width;
                }
            }
            bell = wider;
        }
        bell
    }

    /// Returns the response at `omega` radians per sample, in closed form.
    pub(super) fn response(self, omega: f64) -> f64 {
        let whole = 2.0 * self.reach as f64 + 1.0;
        let middle = (0.5 * whole * omega).sin() / (0.5 * omega).sin();
        let outer = 2.0 * self.rest * ((self.reach as f64 + 1.0) * omega).cos();
        ((middle + outer) / (whole + 2.0 * self.rest)).powi(3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bell_has_the_variance_that_is_asked_for() {
        for sigma in [0.2, 0.5, 1.0, 1.7, 3.0, 12.34, 60.0] {
            let bell = Smooth::new(sigma).bell();
            let middle = (bell.len() / 2) as f64;
            let sum: f64 = bell.iter().sum();
            let spread = bell.iter().enumerate().map(|(at, w)| w * (at as f64 - middle).powi(2));
            assert!((sum - 1.0).abs() < 1e-12);
            assert!((spread.sum::<f64>().sqrt() - sigma).abs() < 1e-9, "{sigma}");
        }
    }

    #[test]
    fn running_sums_are_the_convolution_of_the_definition_even_beyond_the_clip() {
        for (len, sigma) in [(2, 3.0), (3, 0.4), (9, 2.0), (40, 3.3), (40, 25.0), (41, 41.0)] {
            let mut signal: Vec<f64> = (0..len).map(|at| (at as f64 * 1.3).sin() + 0.2).collect();
            (signal[0], signal[len - 1]) = (0.0, 0.0);
            let bell = Smooth::new(sigma).bell();
            let middle = bell.len() as isize / 2;
            let period = 2 * (len as isize - 1);
            let odd = |at: isize| match at.rem_euclid(period) as usize {
                inside if inside < len => signal[inside],
                turned => -signal[period as usize - turned],
            };
            let slow = |at: usize| -> f64 {
                let near = bell.iter().enumerate();
                near.map(|(by, w)| 2.0 * w * odd(at as isize + by as isize - middle)).sum()
            };
            let slow: Vec<f64> = (0..len).map(slow).collect();
            Smooth::new(sigma).apply(&mut signal, 2.0, &mut Vec::new());
            for (fast, slow) in signal.iter().zip(&slow) {
                assert!((fast - slow).abs() < 1e-10, "{len} {sigma}: {fast} {slow}");
            }
        }
    }

    #[test]
    fn what_is_far_from_any_movement_stays_nothing() {
        let mut signal = vec![0.0; 400];
        signal[50..60].copy_from_slice(&[0.1, 0.7, -0.3, 1e3, 0.1, 5.0, -1e3, 0.2, 0.1, 0.3]);
        Smooth::new(4.0).apply(&mut signal, 1.0, &mut Vec::new());
        assert!(signal[52] != 0.0);
        assert!(signal[90..].iter().all(|value| *value == 0.0), "{:?}", &signal[90..]);
    }
}
