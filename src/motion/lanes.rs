//! Groups of numbers that the compiler processes with one instruction (SIMD). Lanes hold frames, koma, drawings or
//! joints, whichever are adjacent.
//!
//! Uses plain arrays and plain loops. The result of a lane does not depend on the other lanes.

mod euler;
mod quat;
mod trig;
mod wide;

use std::array;
use std::ops::{Add, Mul, Sub};

pub use euler::ThreeAxes;
pub use quat::{Arc, LaneQuat, LaneVec};
#[cfg(test)]
pub(crate) use wide::narrow::narrow;
pub use wide::{pieces, wide};

/// Number of lanes: one register of most processors, two of the oldest.
pub const LANES: usize = 4;

/// One number per lane.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Lanes(pub [f64; LANES]);

impl Lanes {
    pub const ZERO: Self = Self([0.0; LANES]);
    pub const ONE: Self = Self([1.0; LANES]);

    #[inline(always)]
    pub fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Self(array::from_fn(value))
    }

    #[inline(always)]
    pub fn map(self, of: impl Fn(f64) -> f64) -> Self {
        Self::from_fn(|lane| of(self.0[lane]))
    }

    #[inline(always)]
    pub fn with(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self::from_fn(|lane| of(self.0[lane], other.0[lane]))
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// Returns the lesser of each lane. Plain comparisons suffice, as no lane is ever NaN.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.with(other, |a, b| if b < a { b } else { a })
    }

    /// Returns the greater of each lane.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.with(other, |a, b| if b > a { b } else { a })
    }

    /// Shifts the values by one lane towards the end and puts `first` into the first lane.
    #[inline(always)]
    pub fn shifted(self, first: f64) -> Self {
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
