//! Sines, cosines and arc tangents of all lanes at once, without a branch per lane.

use std::f64::consts::PI;

use super::{LANES, Lanes};
use crate::maths;

/// Adding this to a number below 2⁵¹ rounds it to an integer, which is then in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Angle in degrees beyond which whole turns are removed first: below it, 180 · k is exact.
const FAR: f64 = 1e15;

/// Coefficients of fdlibm (Sun, 1993) for |x| ≤ π/4: (sin x − x)/x³ in powers of x², within 2⁻⁵⁸ of x.
#[allow(clippy::unreadable_literal, clippy::excessive_precision)]
const SINE: [f64; 6] = [
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
];

/// Coefficients of fdlibm for the arc tangent, (x − atan x)/x³ for |x| ≤ 7/16, split into even and odd powers of x².
#[allow(clippy::unreadable_literal, clippy::excessive_precision)]
const ARC_TANGENT_EVEN: [f64; 6] = [
    3.33333333333329318027e-01,
    1.42857142725034663711e-01,
    9.09088713343650656196e-02,
    6.66107313738753120669e-02,
    4.97687799461593236017e-02,
    1.62858201153657823623e-02,
];
#[allow(clippy::unreadable_literal, clippy::excessive_precision)]
const ARC_TANGENT_ODD: [f64; 5] = [
    -1.99999999998764832476e-01,
    -1.11111104054623557880e-01,
    -7.69187620504482999495e-02,
    -5.83357013379057348645e-02,
    -3.65315727442169155270e-02,
];

/// Coefficients of 2 · asin(c/2)/c in powers of c², after the leading 1, for a chord c. Further terms are below 2⁻⁵⁵
/// for short chords.
const SHORT_ARC: [f64; 6] = [
    1.0 / 24.0,
    3.0 / 640.0,
    5.0 / 7168.0,
    35.0 / 294_912.0,
    63.0 / 2_883_584.0,
    231.0 / 54_525_952.0,
];

/// Largest square of a chord for which [`SHORT_ARC`] holds: a rotation by 20°.
const SHORT: f64 = 0.03;

/// Largest ratio for which the arc tangent's polynomial holds.
const STEEP: f64 = 7.0 / 16.0;

impl Lanes {
    /// Returns sine and cosine of *half* of each angle in degrees, the components of quaternions.
    ///
    /// Half turns are removed in degrees, where they are integers: the remainder is exact for any angle, and only
    /// then converted to radians. Sine and cosine are within 2⁻⁵² of the true values.
    #[inline(always)]
    pub fn half_sin_cos(self) -> (Self, Self) {
        let near = self.0.iter().fold(true, |near, degrees| near & (degrees.abs() < FAR));
        let degrees = if near { self } else { self.without_whole_turns() };
        let rounded = degrees * Self::splat(1.0 / 180.0) + Self::splat(ROUNDER);
        let half_turns = rounded - Self::splat(ROUNDER);
        let rest = degrees - half_turns * Self::splat(180.0);
        let (sin, cos) = rest.near_half_sin_cos();
        let bits: [u64; LANES] = std::array::from_fn(|lane| rounded.0[lane].to_bits());
        // The quarters of a turn give sin, cos, −sin, −cos; the cosine is a quarter ahead.
        let pick = |lane: usize, even: f64, odd: f64, quarter: u64| {
            let swap = (bits[lane] & 1).wrapping_neg();
            let picked = (even.to_bits() & !swap) | (odd.to_bits() & swap);
            f64::from_bits(picked ^ ((quarter & 2) << 62))
        };
        (
            Self::from_fn(|lane| pick(lane, sin.0[lane], cos.0[lane], bits[lane])),
            Self::from_fn(|lane| pick(lane, cos.0[lane], sin.0[lane], bits[lane].wrapping_add(1))),
        )
    }

    /// Returns the same bits as [`half_sin_cos`](Self::half_sin_cos), for angles within a quarter turn.
    ///
    /// The cosine is computed from the sine. For half angles up to 45° this loses no precision, and the square root
    /// overlaps with the multiplications of other lanes.
    #[inline(always)]
    pub fn near_half_sin_cos(self) -> (Self, Self) {
        let x = self * Self::splat(PI / 360.0);
        let square = x * x;
        let sin = x + x * square * horner(&SINE, square);
        (sin, (Self::ONE - sin * sin).sqrt())
    }

    /// Whether all angles in degrees are within a quarter turn.
    #[inline(always)]
    pub fn all_near(self) -> bool {
        self.0.iter().fold(true, |near, degrees| near & (degrees.abs() < 90.0))
    }

    #[cold]
    fn without_whole_turns(self) -> Self {
        self.map(|degrees| degrees % 720.0)
    }

    /// Computes the arc tangent of ratios ≥ 0, within two units in the last place.
    #[inline(always)]
    pub fn atan(self) -> Self {
        let flat = self.flat_atan();
        if self.all_flat() { flat } else { self.steep_atan(flat) }
    }

    // A ratio is steep if a quarter of the rotation's angle exceeds 23°, which is rare.
    #[cold]
    fn steep_atan(self, flat: Self) -> Self {
        self.with(flat, |ratio, flat| if ratio <= STEEP { flat } else { maths::atan(ratio) })
    }

    /// Computes the angle of a rotation in radians, given the square of a short chord between unit quaternions.
    #[inline(always)]
    pub(super) fn short_arc(self) -> Self {
        let chord = self.sqrt() * Self::splat(2.0);
        chord + chord * self * horner(&SHORT_ARC, self)
    }

    /// Whether all values are squares of short chords.
    #[inline(always)]
    pub(super) fn all_short(self) -> bool {
        self.0.iter().fold(true, |short, chord| short & (*chord <= SHORT))
    }

    /// Returns these numbers, or `short` in lanes with a short chord.
    #[inline(always)]
    pub(super) fn where_long(self, chord: Self, short: Self) -> Self {
        Self::from_fn(|lane| if chord.0[lane] <= SHORT { short.0[lane] } else { self.0[lane] })
    }

    #[inline(always)]
    fn all_flat(self) -> bool {
        self.0.iter().fold(true, |flat, ratio| flat & (*ratio <= STEEP))
    }

    /// Computes the arc tangent of ratios from 0 to 7/16.
    #[inline(always)]
    fn flat_atan(self) -> Self {
        let square = self * self;
        let fourth = square * square;
        // Two short chains of products are faster than a long one, in which each step waits for the last.
        let sum = horner(&ARC_TANGENT_EVEN, fourth) + square * horner(&ARC_TANGENT_ODD, fourth);
        self - self * square * sum
    }
}

/// Evaluates a polynomial by Horner's rule, the constant coefficient first.
#[inline(always)]
fn horner<const TERMS: usize>(coefficients: &[f64; TERMS], x: Lanes) -> Lanes {
    let mut sum = Lanes::splat(coefficients[TERMS - 1]);
    for coefficient in coefficients[..TERMS - 1].iter().rev() {
        sum = sum * x + Lanes::splat(*coefficient);
    }
    sum
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Computes one lane with the standard library, after exact removal of half turns.
    fn slow(degrees: f64) -> (f64, f64) {
        let degrees = degrees % 720.0;
        let half_turns = (degrees / 180.0).round();
        let (sin, cos) = (0.5 * (degrees - 180.0 * half_turns)).to_radians().sin_cos();
        match half_turns.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    fn close(found: (f64, f64), expected: (f64, f64)) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= f64::EPSILON.min(3.0 * f64::EPSILON * b.abs());
        near(found.0, expected.0) && near(found.1, expected.1)
    }

    fn lane(degrees: f64, lane: usize) -> (f64, f64) {
        let mut lanes = [33.0; LANES];
        lanes[0] = 1e9;
        lanes[lane] = degrees;
        let (sin, cos) = Lanes(lanes).half_sin_cos();
        (sin.0[lane], cos.0[lane])
    }

    #[test]
    fn whole_quarters_are_exact() {
        for (degrees, expected) in [
            (0.0, (0.0, 1.0)),
            (180.0, (1.0, 0.0)),
            (-180.0, (-1.0, 0.0)),
            (360.0, (0.0, -1.0)),
            (540.0, (-1.0, 0.0)),
            (720.0, (0.0, 1.0)),
            (-720.0 * 1e9, (0.0, 1.0)),
        ] {
            assert_eq!(lane(degrees, 1), expected, "{degrees}");
        }
    }

    #[test]
    fn within_a_quarter_turn_both_ways_give_the_same_digits() {
        let within = (-1800..1800).map(|tenths| f64::from(tenths) / 20.0).skip(1);
        for degrees in within.chain([f64::from_bits(90f64.to_bits() - 1), 1e-300, 0.0]) {
            let angle = Lanes::splat(degrees);
            assert!(angle.all_near());
            assert_eq!(angle.near_half_sin_cos(), angle.half_sin_cos(), "{degrees}");
        }
        for (lane, far) in [(LANES - 1, -90.0), (0, f64::NAN)] {
            let mut lanes = [0.0; LANES];
            lanes[lane] = far;
            assert!(!Lanes(lanes).all_near());
        }
    }

    #[test]
    fn an_angle_of_any_size_has_its_sine() {
        for degrees in [1e12 + 0.25, -1e14 - 0.5, 1e15 + 45.0, 3e17, -1e300, f64::MAX] {
            let (sin, cos) = lane(degrees, 1);
            assert!(close((sin, cos), slow(degrees)), "{degrees}: {sin} {cos}");
        }
    }

    #[test]
    fn a_tiny_angle_keeps_its_digits() {
        for degrees in [1e-3, 1e-9, 1e-100, -1e-300] {
            assert!(close(lane(degrees, 0), slow(degrees)), "{degrees}");
            let angle = Lanes::splat(degrees.abs()).atan();
            assert_eq!(angle.0[1], degrees.abs().atan());
        }
    }

    proptest! {
        #[test]
        fn half_sines_are_those_of_the_standard_library(
            degrees in prop_oneof![-800.0..800.0, -1.0..1.0, -1e6..1e6, (-9i32..9).prop_map(|k| f64::from(k) * 45.0)],
            at in 0..LANES,
        ) {
            let (found, expected) = (lane(degrees, at), slow(degrees));
            prop_assert!(close(found, expected), "{degrees}: {found:?} for {expected:?}");
        }

        #[test]
        fn arc_tangents_are_those_of_the_standard_library(
            ratios in prop::array::uniform(prop_oneof![0.0..2.0, 0.0..1e-6, 0.0..0.5, Just(0.0), Just(STEEP)]),
        ) {
            for (ratio, found) in ratios.into_iter().zip(Lanes(ratios).atan().0) {
                let expected = ratio.atan();
                prop_assert!((found - expected).abs() <= 2.0 * f64::EPSILON * expected, "{found}");
                prop_assert_eq!(found, Lanes::splat(ratio).atan().0[0], "whatever the others are");
            }
        }
    }
}
