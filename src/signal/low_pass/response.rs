//! Computes how much of each frequency a filter lets through, in closed form.
//!
//! A mirrored clip of N frames repeats every 2N frames. A symmetric kernel of any width, even wider than the clip,
//! therefore only scales its N cosines by the kernel's transform at ω = πk/N.

use std::f64::consts::{PI, TAU};

use super::FilterKind;
use super::moving::{Taps, taps};
use crate::maths;

impl FilterKind {
    /// Returns the gain of each cosine of a clip, k = 0 … `frames` − 1, for a width in frames above 0. The first gain
    /// is exactly 1.
    pub(super) fn response(self, width: f64, frames: usize) -> Vec<f64> {
        let omega = |k: usize| PI * k as f64 / frames as f64;
        let mut gains: Vec<f64> = match self {
            Self::Box => (0..frames).map(|k| moving_average(width, omega(k))).collect(),
            Self::Gaussian => {
                let whole = gaussian(width / 6.0, 0.0);
                (0..frames).map(|k| gaussian(width / 6.0, omega(k)) / whole).collect()
            }
            Self::Ideal => (0..frames).map(|k| brick_wall(width, k, frames)).collect(),
            Self::Butterworth => (0..frames).map(|k| butterworth(width, omega(k))).collect(),
        };
        if let Some(steady) = gains.first_mut() {
            *steady = 1.0;
        }
        gains
    }
}

/// Computes the gain of the box: the weights of its window, each at its distance.
fn moving_average(width: f64, omega: f64) -> f64 {
    let (reach, Taps { middle, inner, outer }) = taps(width);
    let sum = maths::sin((reach + 0.5) * omega) / maths::sin(omega / 2.0);
    let pair = |distance: f64| 2.0 * maths::cos(distance * omega);
    middle * sum + inner * pair(reach + 1.0) + outer * pair(reach + 2.0)
}

/// Computes the gain of the Gaussian. Sampling the kernel repeats its transform every 2π; this sums all copies that
/// still count.
fn gaussian(sigma: f64, omega: f64) -> f64 {
    // exp(−x²/2) is below 1e−17 beyond 9.
    let copies = (9.0 / (sigma * TAU)).ceil() as i32 + 1;
    let copy = |at: i32| maths::exp(-0.5 * (sigma * (omega + TAU * f64::from(at))).powi(2));
    (-copies..=copies).map(copy).sum()
}

/// Computes the gain of the ideal filter. The k-th cosine of N frames has a period of 2N/k frames.
fn brick_wall(width: f64, k: usize, frames: usize) -> f64 {
    if 2.0 * frames as f64 >= k as f64 * width { 1.0 } else { 0.0 }
}

/// Computes the gain of the Butterworth filter: the bilinear transform of the analogue one, squared by the run back.
fn butterworth(width: f64, omega: f64) -> f64 {
    1.0 / (1.0 + (maths::tan(omega / 2.0) / maths::tan(PI / width)).powi(4))
}
