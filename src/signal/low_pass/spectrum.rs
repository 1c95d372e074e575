//! Transforms a clip of signals to cosines (DCT-II) and back.
//!
//! A transform of N mirrored frames takes one Fourier transform of length N: the even frames followed by the
//! odd ones backwards, then a turn by k quarter steps (Makhoul 1980).

use std::f64::consts::PI;
use std::sync::OnceLock;

use nalgebra::DMatrix;
use rustfft::num_complex::Complex;

use super::fourier::{Fourier, turn};
use super::portable_float::Real;
use crate::signal::Signals;
use crate::time::FrameRate;

/// Spectrum (周波数成分) of signals. It is computed when the first filter needs it; after that, filters are products with
/// it.
#[derive(Clone)]
pub struct Spectrum {
    signals: Signals,
    cosines: OnceLock<Cosines>,
}

#[derive(Clone)]
struct Cosines {
    /// Σ x[n] cos(πk(2n + 1)/2N), k × joints.
    values: DMatrix<f64>,
    /// exp(iπk/2N), k = 0 … N − 1.
    quarter_steps: Vec<Complex<Real>>,
    fourier: Fourier,
}

impl std::fmt::Debug for Spectrum {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (frames, joints) = self.signals.values.shape();
        write!(f, "Spectrum({frames} frames × {joints} joints)")
    }
}

impl From<Signals> for Spectrum {
    fn from(signals: Signals) -> Self {
        Self { signals, cosines: OnceLock::new() }
    }
}

impl Spectrum {
    /// Creates the spectrum of every joint.
    pub fn new(signals: &Signals) -> Self {
        signals.clone().into()
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.signals.frames()
    }

    /// Frames a second.
    pub fn rate(&self) -> FrameRate {
        self.signals.rate
    }

    /// Returns the signals it was made of.
    pub fn unfiltered(&self) -> &Signals {
        &self.signals
    }

    /// Returns the signals with the k-th cosine multiplied by `gains[k]`. Needs at least one frame.
    pub(super) fn times(&self, gains: &[f64]) -> Signals {
        let cosines = self.cosines.get_or_init(|| Cosines::new(&self.signals));
        Signals { values: cosines.times(gains), ..self.signals }
    }
}

impl Cosines {
    fn new(signals: &Signals) -> Self {
        let frames = signals.frames();
        let step = PI / (2 * frames) as f64;
        let mut cosines = Self {
            values: DMatrix::zeros(frames, signals.joints()),
            quarter_steps: (0..frames).map(|k| turn(step * k as f64)).collect(),
            fourier: Fourier::new(frames),
        };
        cosines.fill(signals);
        cosines
    }

    fn fill(&mut self, signals: &Signals) {
        let frames = signals.frames();
        let mut room = self.fourier.room();
        let mut waves = vec![Complex::new(Real(0.0), Real(0.0)); frames];
        let joints = signals.values.as_slice().chunks_exact(frames);
        for (joint, cosines) in joints.zip(self.values.as_mut_slice().chunks_exact_mut(frames)) {
            for (n, value) in joint.iter().enumerate() {
                waves[shuffled_place(n, frames)] = Complex::new(Real(*value), Real(0.0));
            }
            self.fourier.transform(&mut waves, &mut room);
            for (cosine, (wave, step)) in
                cosines.iter_mut().zip(waves.iter().zip(&self.quarter_steps))
            {
                *cosine = (wave * step.conj()).re.0;
            }
        }
    }

    fn times(&self, gains: &[f64]) -> DMatrix<f64> {
        let (frames, joints) = self.values.shape();
        let mut values = DMatrix::zeros(frames, joints);
        let mut room = self.fourier.room();
        let mut waves = vec![Complex::new(Real(0.0), Real(0.0)); frames];
        let gains: Vec<f64> = gains.iter().map(|gain| gain / frames as f64).collect();
        let joints = self.values.as_slice().chunks_exact(frames);
        for (cosines, joint) in joints.zip(values.as_mut_slice().chunks_exact_mut(frames)) {
            self.waves_from_cosines(cosines, &gains, &mut waves);
            self.fourier.transform(&mut waves, &mut room);
            for (n, value) in joint.iter_mut().enumerate() {
                *value = waves[shuffled_place(n, frames)].re.0;
            }
        }
        values
    }

    /// Computes the waves of the shuffled frames, conjugated: their forward transform equals the inverse transform.
    fn waves_from_cosines(&self, cosines: &[f64], gains: &[f64], waves: &mut [Complex<Real>]) {
        let frames = cosines.len();
        let scaled = |k: usize| Real(cosines[k] * gains[k]);
        waves[0] = Complex::new(scaled(0), Real(0.0));
        for (k, (wave, step)) in waves.iter_mut().zip(&self.quarter_steps).enumerate().skip(1) {
            *wave = Complex::new(scaled(k), scaled(frames - k)) * step.conj();
        }
    }
}

/// Returns the place of frame n before the transform: the even frames first, then the odd ones backwards.
fn shuffled_place(n: usize, frames: usize) -> usize {
    if n.is_multiple_of(2) { n / 2 } else { frames - 1 - n / 2 }
}
