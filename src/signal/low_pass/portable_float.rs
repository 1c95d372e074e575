//! A number whose Fourier transforms are the same on every processor.
//!
//! `rustfft` takes sines and cosines from the system and converts each to the number type that it transforms. A
//! transform of 2ᵏ numbers uses only whole fractions of a turn. The value shows which fraction is meant, whatever its
//! last digits, so its cosine is computed anew.

use std::f64::consts::TAU;
use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

use rustfft::num_traits::{FromPrimitive, Num, One, Signed, Zero};

use crate::maths;

/// Parts of a turn that are told apart; near 0, the cosines of smaller parts are the same number.
const TURN: u32 = 1 << 26;

/// Largest distance of a number from the cosine of a whole part to count as that cosine.
const NEAR: f64 = 1e-13;

/// An `f64` whose FFT twiddle factors come from libm, identical on every processor.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct Real(pub(super) f64);

impl FromPrimitive for Real {
    fn from_i64(whole: i64) -> Option<Self> {
        Some(Self(whole as f64))
    }

    fn from_u64(whole: u64) -> Option<Self> {
        Some(Self(whole as f64))
    }

    fn from_f64(number: f64) -> Option<Self> {
        let parts = (maths::acos(number.clamp(-1.0, 1.0)) * (f64::from(TURN) / TAU)).round() as u32;
        let sure = cosine(parts);
        Some(Self(if (sure - number).abs() <= NEAR { sure } else { number }))
    }
}

/// Returns the cosine of so many parts, up to half a turn; exact at quarters.
fn cosine(parts: u32) -> f64 {
    let angle = |parts: u32| f64::from(parts) * (TAU / f64::from(TURN));
    match parts {
        _ if parts > TURN / 4 => -cosine(TURN / 2 - parts),
        _ if parts > TURN / 8 => maths::sin(angle(TURN / 4 - parts)),
        _ => maths::cos(angle(parts)),
    }
}

macro_rules! as_any_other {
    ($($op:ident $verb:ident),*) => {$(
        impl $op for Real {
            type Output = Self;

            #[inline(always)]
            fn $verb(self, other: Self) -> Self {
                Self(self.0.$verb(other.0))
            }
        }
    )*};
}

as_any_other!(Add add, Sub sub, Mul mul, Div div, Rem rem);

impl Neg for Real {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Real {
    #[inline(always)]
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Real {
    #[inline(always)]
    fn one() -> Self {
        Self(1.0)
    }
}

impl Num for Real {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;

    fn from_str_radix(digits: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(digits, radix).map(Self)
    }
}

impl Signed for Real {
    fn abs(&self) -> Self {
        Self(self.0.abs())
    }

    fn abs_sub(&self, other: &Self) -> Self {
        Self((self.0 - other.0).max(0.0))
    }

    fn signum(&self) -> Self {
        Self(self.0.signum())
    }

    fn is_positive(&self) -> bool {
        self.0 > 0.0
    }

    fn is_negative(&self) -> bool {
        self.0 < 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digits_of_a_cosine_do_not_matter() {
        for power in 0..=26 {
            let parts = 1_u32 << power;
            for part in [1, 3, 5, parts / 8 + 1, parts / 4 + 1, parts / 3, parts / 2, parts - 1] {
                let angle = TAU / f64::from(parts) * f64::from(part);
                for right in [angle.cos(), angle.sin()] {
                    let of = |number| Real::from_f64(number).unwrap().0;
                    let found = of(right);
                    assert!((found - right).abs() < 2e-15, "{part}/{parts}: {found} for {right}");
                    assert_eq!(found, of(right.next_up()), "{part}/{parts}");
                    assert_eq!(found, of(right.next_down()), "{part}/{parts}");
                }
            }
        }
    }

    #[test]
    fn quarters_are_exact_and_other_numbers_stay() {
        for (number, expected) in
            [(1.0, 1.0), (-1.0, -1.0), (6e-17, 0.0), (-2e-16, 0.0), (0.5, 0.5), (3.7, 3.7)]
        {
            assert_eq!(Real::from_f64(number).unwrap().0, expected);
        }
    }
}
