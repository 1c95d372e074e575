//! Several numbers side by side, so that the compiler works on them with one instruction: lanes are
//! frames, koma, drawings or joints, whichever stand next to each other.
//!
//! Plain arrays and plain loops: a lane's result does not depend on what the other lanes hold.

mod euler;
mod quat;
mod trig;
mod wide;

use std::array;
use std::ops::{Add, Mul, Sub};

pub(crate) use euler::ThreeAxes;
pub(crate) use quat::{Arc, LaneQuat, LaneVec};
#[cfg(test)]
pub(crate) use wide::narrow::narrow;
pub(crate) use wide::{pieces, wide};

/// Numbers side by side: one register of most processors, two of the oldest.
pub(crate) const LANES: usize = 4;

/// A number a lane.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Lanes(pub(crate) [f64; LANES]);

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);
    pub(crate) const ONE: Self = Self([1.0; LANES]);

    #[inline(always)]
    pub(crate) fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub(crate) fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Self(array::from_fn(value))
    }

    #[inline(always)]
    pub(crate) fn map(self, of: impl Fn(f64) -> f64) -> Self {
        Self::from_fn(|lane| of(self.0[lane]))
    }

    #[inline(always)]
    pub(crate) fn with(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self::from_fn(|lane| of(self.0[lane], other.0[lane]))
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The lesser of each lane; plain comparisons, as no lane is ever NaN.
    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.with(other, |a, b| if b < a { b } else { a })
    }

    /// The greater of each lane.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(other, |a, b| if b > a { b } else { a })
    }

    /// Each lane takes what the one before it holds, the first takes `first`.
    #[inline(always)]
    pub(crate) fn shifted(self, first: f64) -> Self {
        Self::from_fn(|lane| if lane == 0 { first } else { self.0[lane - 1] })
    }
}

impl Add for Lanes {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for Lanes {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul for Lanes {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}
