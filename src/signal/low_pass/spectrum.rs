//! A clip of signals as cosines (DCT-II), and back.
//!
//! A transform of N mirrored frames takes one real FFT of length N: the even frames followed by the
//! odd ones backwards, then a turn by k quarter steps (Makhoul 1980).

use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

use nalgebra::DMatrix;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use crate::signal::Signals;
use crate::time::FrameRate;

/// Spectrum (周波数成分) of signals: made when the first filter asks for it, then any number of filters
/// are products with it.
#[derive(Clone)]
pub struct Spectrum {
    signals: Signals,
    cosines: OnceLock<Cosines>,
}

#[derive(Clone)]
struct Cosines {
    /// Σ x[n] cos(πk(2n + 1)/2N), k × joints.
    values: DMatrix<f64>,
    /// exp(iπk/2N), k = 0 … N/2.
    quarter_steps: Vec<Complex<f64>>,
    back: Arc<dyn ComplexToReal<f64>>,
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
    /// The spectrum of every joint.
    pub fn of(signals: &Signals) -> Self {
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

    /// The signals it was made of.
    pub fn unfiltered(&self) -> &Signals {
        &self.signals
    }

    /// The signals whose k-th cosine is `gains[k]` times as large; of at least one frame.
    pub(super) fn times(&self, gains: &[f64]) -> Signals {
        let cosines = self.cosines.get_or_init(|| Cosines::of(&self.signals));
        Signals { values: cosines.times(gains), ..self.signals }
    }
}

impl Cosines {
    fn of(signals: &Signals) -> Self {
        let frames = signals.frames();
        let mut planner = RealFftPlanner::new();
        let mut cosines = Self {
            values: DMatrix::zeros(frames, signals.joints()),
            quarter_steps: (0..=frames / 2)
                .map(|k| Complex::cis(PI * k as f64 / (2 * frames) as f64))
                .collect(),
            back: planner.plan_fft_inverse(frames),
        };
        cosines.fill(signals, planner.plan_fft_forward(frames).as_ref());
        cosines
    }

    fn fill(&mut self, signals: &Signals, forth: &dyn RealToComplex<f64>) {
        let frames = signals.frames();
        let mut shuffled = forth.make_input_vec();
        let mut waves = forth.make_output_vec();
        let mut scratch = forth.make_scratch_vec();
        let joints = signals.values.as_slice().chunks_exact(frames);
        for (joint, cosines) in joints.zip(self.values.as_mut_slice().chunks_exact_mut(frames)) {
            for (n, value) in joint.iter().enumerate() {
                shuffled[shuffled_place(n, frames)] = *value;
            }
            forth
                .process_with_scratch(&mut shuffled, &mut waves, &mut scratch)
                .expect("the plan made the buffers");
            for (k, (wave, step)) in waves.iter().zip(&self.quarter_steps).enumerate() {
                let turned = wave * step.conj();
                cosines[k] = turned.re;
                if k > 0 {
                    cosines[frames - k] = -turned.im;
                }
            }
        }
    }

    fn times(&self, gains: &[f64]) -> DMatrix<f64> {
        let (frames, joints) = self.values.shape();
        let back = &self.back;
        let mut values = DMatrix::zeros(frames, joints);
        let mut waves = back.make_input_vec();
        let mut shuffled = back.make_output_vec();
        let mut scratch = back.make_scratch_vec();
        let gains: Vec<f64> = gains.iter().map(|gain| gain / frames as f64).collect();
        let joints = self.values.as_slice().chunks_exact(frames);
        for (cosines, joint) in joints.zip(values.as_mut_slice().chunks_exact_mut(frames)) {
            self.waves_from_cosines(cosines, &gains, &mut waves);
            back.process_with_scratch(&mut waves, &mut shuffled, &mut scratch)
                .expect("the plan made the buffers, and what must be real is");
            for (n, value) in joint.iter_mut().enumerate() {
                *value = shuffled[shuffled_place(n, frames)];
            }
        }
        values
    }

    fn waves_from_cosines(&self, cosines: &[f64], gains: &[f64], waves: &mut [Complex<f64>]) {
        let frames = cosines.len();
        waves[0] = Complex::new(cosines[0] * gains[0], 0.0);
        for (k, wave) in waves.iter_mut().enumerate().skip(1) {
            let turned =
                Complex::new(cosines[k] * gains[k], -cosines[frames - k] * gains[frames - k]);
            *wave = turned * self.quarter_steps[k];
        }
        if frames.is_multiple_of(2) {
            // Real but for rounding, and the transform insists.
            waves[frames / 2].im = 0.0;
        }
    }
}

/// Where frame n stands before the transform: the even frames first, the odd ones behind, backwards.
fn shuffled_place(n: usize, frames: usize) -> usize {
    if n.is_multiple_of(2) { n / 2 } else { frames - 1 - n / 2 }
}
