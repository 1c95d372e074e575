//! The discrete Fourier transform of any length, the same on every processor.
//!
//! Multiplying all numbers by a chirp makes it a convolution (Bluestein 1970). The convolution uses transforms whose
//! length is a power of two: `Real` knows their cosines.

use std::f64::consts::PI;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};

use super::portable_float::Real;
use crate::maths;

/// A Fourier transform of a fixed length.
#[derive(Clone)]
pub(super) struct Fourier {
    /// exp(−iπn²/N).
    chirp: Vec<Complex<Real>>,
    /// The transform of exp(iπn²/N), n from 1 − N to N − 1, over its length.
    convolver: Vec<Complex<Real>>,
    forth: Arc<dyn Fft<Real>>,
    back: Arc<dyn Fft<Real>>,
}

/// The buffers of a transform.
pub(super) struct Room {
    padded: Vec<Complex<Real>>,
    scratch: Vec<Complex<Real>>,
}

/// Returns exp(iα).
pub(super) fn turn(angle: f64) -> Complex<Real> {
    let (sin, cos) = maths::sin_cos(angle);
    Complex::new(Real(cos), Real(sin))
}

impl Fourier {
    /// Plans the transform of so many numbers, at least one.
    pub(super) fn new(len: usize) -> Self {
        let padded = (2 * len - 1).next_power_of_two();
        let mut planner = FftPlannerScalar::new();
        let forth = planner.plan_fft_forward(padded);
        let back = planner.plan_fft_inverse(padded);
        // Whole turns are subtracted while the numbers are still integers.
        let half_turns = |n: usize| (n as u128 * n as u128 % (2 * len as u128)) as f64 / len as f64;
        let chirp: Vec<_> = (0..len).map(|n| turn(-PI * half_turns(n))).collect();
        let mut convolver = vec![Complex::new(Real(0.0), Real(0.0)); padded];
        for (n, number) in chirp.iter().enumerate() {
            convolver[n] = number.conj().unscale(Real(padded as f64));
            convolver[(padded - n) % padded] = convolver[n];
        }
        forth.process(&mut convolver);
        Self { chirp, convolver, forth, back }
    }

    pub(super) fn room(&self) -> Room {
        let zeros = |len| vec![Complex::new(Real(0.0), Real(0.0)); len];
        let scratch = [&self.forth, &self.back].map(|fft| fft.get_inplace_scratch_len());
        Room { padded: zeros(self.convolver.len()), scratch: zeros(scratch[0].max(scratch[1])) }
    }

    /// Replaces z[k] by Σ z[n] exp(−2πikn/N).
    pub(super) fn transform(&self, numbers: &mut [Complex<Real>], room: &mut Room) {
        let Room { padded, scratch } = room;
        let (filled, rest) = padded.split_at_mut(numbers.len());
        for ((place, number), chirp) in filled.iter_mut().zip(&*numbers).zip(&self.chirp) {
            *place = number * chirp;
        }
        rest.fill(Complex::new(Real(0.0), Real(0.0)));
        self.forth.process_with_scratch(padded, scratch);
        for (wave, factor) in padded.iter_mut().zip(&self.convolver) {
            *wave = *wave * factor;
        }
        self.back.process_with_scratch(padded, scratch);
        for ((number, place), chirp) in numbers.iter_mut().zip(&*padded).zip(&self.chirp) {
            *number = place * chirp;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_transform_of_any_length_is_the_sum_that_defines_it() {
        for len in [1_usize, 2, 3, 4, 5, 8, 13, 64, 97, 100] {
            let numbers: Vec<_> = (0..len)
                .map(|n| Complex::new(Real((n * n % 7) as f64), Real((n % 5) as f64 - 2.0)))
                .collect();
            let fourier = Fourier::new(len);
            let mut room = fourier.room();
            let mut found = numbers.clone();
            fourier.transform(&mut found, &mut room);
            for (k, found) in found.iter().enumerate() {
                let term =
                    |n: usize| numbers[n] * turn(-2.0 * PI * (k * n % len) as f64 / len as f64);
                let expected: Complex<Real> = (0..len).map(term).sum();
                let off = found - expected;
                assert!(off.re.0.hypot(off.im.0) < 1e-12, "{k} of {len}");
            }
            let mut again = numbers.clone();
            fourier.transform(&mut again, &mut room);
            fourier.transform(&mut found.clone(), &mut room);
            assert_eq!(again, found_of(&fourier, &numbers), "whatever was in the room");
        }
    }

    fn found_of(fourier: &Fourier, numbers: &[Complex<Real>]) -> Vec<Complex<Real>> {
        let mut found = numbers.to_vec();
        fourier.transform(&mut found, &mut fourier.room());
        found
    }
}
