//! Quaternions and vectors, one per lane.

use std::ops::{Add, Mul, Sub};

use glam::{DQuat, DVec3};

use super::{LANES, Lanes};
use crate::motion::Axis;

/// One vector per lane.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LaneVec {
    pub x: Lanes,
    pub y: Lanes,
    pub z: Lanes,
}

impl LaneVec {
    #[inline(always)]
    pub fn splat(vec: DVec3) -> Self {
        Self { x: Lanes::splat(vec.x), y: Lanes::splat(vec.y), z: Lanes::splat(vec.z) }
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> DVec3 {
        DVec3::new(self.x.0[lane], self.y.0[lane], self.z.0[lane])
    }

    #[inline(always)]
    pub fn axis_mut(&mut self, axis: Axis) -> &mut Lanes {
        match axis {
            Axis::X => &mut self.x,
            Axis::Y => &mut self.y,
            Axis::Z => &mut self.z,
        }
    }

    #[inline(always)]
    pub fn with(self, other: Self, of: impl Fn(Lanes, Lanes) -> Lanes) -> Self {
        Self { x: of(self.x, other.x), y: of(self.y, other.y), z: of(self.z, other.z) }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Lanes {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Applies a function to each lane.
    #[inline(always)]
    pub fn map(self, of: impl Fn(DVec3) -> DVec3) -> Self {
        let mut mapped = self;
        for lane in 0..LANES {
            let vec = of(self.lane(lane));
            (mapped.x.0[lane], mapped.y.0[lane], mapped.z.0[lane]) = (vec.x, vec.y, vec.z);
        }
        mapped
    }

    /// Interpolates by `share`. If both ends are equal, the result is exactly that value.
    #[inline(always)]
    pub fn lerp(self, to: Self, share: Lanes) -> Self {
        self + (to - self) * share
    }

    /// Shifts the values by one lane towards the end and puts `first` into the first lane.
    #[inline(always)]
    pub fn shifted(self, first: DVec3) -> Self {
        Self { x: self.x.shifted(first.x), y: self.y.shifted(first.y), z: self.z.shifted(first.z) }
    }
}

impl Add for LaneVec {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for LaneVec {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul<Lanes> for LaneVec {
    type Output = Self;

    #[inline(always)]
    fn mul(self, by: Lanes) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
    }
}

/// One quaternion per lane: vector part `v`, scalar part `w`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LaneQuat {
    pub v: LaneVec,
    pub w: Lanes,
}

impl Default for LaneQuat {
    /// The identity rotation.
    fn default() -> Self {
        Self { v: LaneVec::default(), w: Lanes::ONE }
    }
}

impl LaneQuat {
    #[inline(always)]
    pub fn splat(q: DQuat) -> Self {
        Self { v: LaneVec::splat(q.xyz()), w: Lanes::splat(q.w) }
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> DQuat {
        let v = self.v.lane(lane);
        DQuat::from_xyzw(v.x, v.y, v.z, self.w.0[lane])
    }

    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, q: DQuat) {
        self.v.x.0[lane] = q.x;
        self.v.y.0[lane] = q.y;
        self.v.z.0[lane] = q.z;
        self.w.0[lane] = q.w;
    }

    /// Multiplies this rotation by one about an axis, with half the products of a full multiplication.
    #[inline(always)]
    pub fn turned(self, axis: Axis, (sin, cos): (Lanes, Lanes)) -> Self {
        let Self { v: LaneVec { x, y, z }, w } = self;
        let (x_cos, y_cos, z_cos, w_cos) = (x * cos, y * cos, z * cos, w * cos);
        let (x_sin, y_sin, z_sin, w_sin) = (x * sin, y * sin, z * sin, w * sin);
        let (x, y, z, w) = match axis {
            Axis::X => (x_cos + w_sin, y_cos + z_sin, z_cos - y_sin, w_cos - x_sin),
            Axis::Y => (x_cos - z_sin, y_cos + w_sin, z_cos + x_sin, w_cos - y_sin),
            Axis::Z => (x_cos + y_sin, y_cos - x_sin, z_cos + w_sin, w_cos - z_sin),
        };
        Self { v: LaneVec { x, y, z }, w }
    }

    /// Returns the angle between two rotations in radians, 0 to π, the same for q and −q.
    ///
    /// On the sphere of unit quaternions, the nearer of ±`to` is half that angle away. Steps from frame to frame are
    /// short, and half of the chord is the sine of a quarter of the angle.
    #[inline(always)]
    pub fn angle_to(self, to: Self) -> Lanes {
        let chord = (to - self).squared();
        let short = chord.short_arc();
        if chord.all_short() { short } else { self.far_angle_to(to, chord, short) }
    }

    /// Kahan's formula: the tangent of a quarter of the angle is |a − b| / |a + b|, precise for tiny and for large
    /// angles.
    #[inline(always)]
    fn far_angle_to(self, to: Self, chord: Lanes, short: Lanes) -> Lanes {
        let sum = (to + self).squared();
        let (least, most) = (chord.min(sum), chord.max(sum));
        let tangent = least.with(most, |least, most| least / most).sqrt();
        (tangent.atan() * Lanes::splat(4.0)).where_long(chord, short)
    }

    /// Returns the rotation from one to another as a vector: the axis, in the common reference axes, times the angle
    /// of the shorter arc in radians.
    #[inline(always)]
    pub fn way_to(self, to: Self) -> LaneVec {
        let turn = to * self.conjugate();
        let sine = turn.v.dot(turn.v).sqrt();
        let sign = turn.w.map(|w| 1f64.copysign(w));
        // For an angle this short, it equals twice the sine of its half.
        let stretch = |angle: f64, sine: f64| if sine > 0.0 { angle / sine } else { 2.0 };
        turn.v * (self.angle_to(to).with(sine, stretch) * sign)
    }

    /// Returns the inverse rotation.
    #[inline(always)]
    pub fn conjugate(self) -> Self {
        Self { v: self.v * Lanes::splat(-1.0), w: self.w }
    }

    #[inline(always)]
    fn squared(self) -> Lanes {
        (self.v.x * self.v.x + self.v.y * self.v.y) + (self.v.z * self.v.z + self.w * self.w)
    }

    /// Moves `share` of the shorter arc to `to` (slerp). Equal rotations stay exactly the same.
    #[inline(always)]
    pub fn slerp(self, to: Self, share: Lanes) -> Self {
        let arc = Arc::between(self, to);
        let moved = arc.along(share);
        // A lane that does not move keeps every digit: computed from the middle of the arc, it would show rounding
        // errors.
        let stays = arc.degrees * share;
        let pick = |moved: Lanes, here: Lanes| {
            Lanes::from_fn(|lane| if stays.0[lane] == 0.0 { here.0[lane] } else { moved.0[lane] })
        };
        Self { v: moved.v.with(self.v, pick), w: pick(moved.w, self.w) }
    }

    #[inline(always)]
    pub fn scaled(self, by: Lanes) -> Self {
        Self { v: self.v * by, w: self.w * by }
    }

    /// Rotates a vector.
    #[inline(always)]
    pub fn rotate(self, vec: LaneVec) -> LaneVec {
        let twice = self.v.cross(vec) * Lanes::splat(2.0);
        vec + twice * self.w + self.v.cross(twice)
    }

    /// Shifts the values by one lane towards the end and puts `first` into the first lane.
    #[inline(always)]
    pub fn shifted(self, first: DQuat) -> Self {
        Self { v: self.v.shifted(first.xyz()), w: self.w.shifted(first.w) }
    }
}

impl Add for LaneQuat {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { v: self.v + other.v, w: self.w + other.w }
    }
}

impl Sub for LaneQuat {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { v: self.v - other.v, w: self.w - other.w }
    }
}

impl Mul for LaneQuat {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            v: other.v * self.w + self.v * other.w + self.v.cross(other.v),
            w: self.w * other.w - self.v.dot(other.v),
        }
    }
}

/// The shorter arc between two rotations, described from its middle. Both ends are at most a quarter turn from there,
/// and their sum and difference determine the arc.
#[derive(Debug, Clone, Copy, Default)]
pub struct Arc {
    pub middle: LaneQuat,
    /// Point a quarter turn of the four-dimensional circle further on; 0 for an arc of length 0.
    pub across: LaneQuat,
    /// Angle of the whole arc in degrees, 0 to 180.
    pub degrees: Lanes,
}

impl Arc {
    #[inline(always)]
    pub fn between(from: LaneQuat, to: LaneQuat) -> Self {
        // Picks the nearer of ±`to`.
        let cos = from.v.dot(to.v) + from.w * to.w;
        let to = to.scaled(cos.map(|cos| 1f64.copysign(cos)));
        let (sum, difference) = (from + to, to - from);
        let (run, rise) = (sum.squared().sqrt(), difference.squared().sqrt());
        let per_run = run.map(|run| 1.0 / run);
        let per_rise = rise.map(|rise| if rise > 0.0 { 1.0 / rise } else { 0.0 });
        // The tangent of a quarter of the angle is flat up to 94°; that of half the angle would be only up to 47°.
        let quarter = (rise * per_run).atan();
        Self {
            middle: sum.scaled(per_run),
            across: difference.scaled(per_rise),
            degrees: quarter * Lanes::splat(720.0 / std::f64::consts::PI),
        }
    }

    /// Returns the rotations at some shares of the arc.
    #[inline(always)]
    pub fn along(&self, share: Lanes) -> LaneQuat {
        let (sin, cos) = (self.degrees * (share - Lanes::splat(0.5))).near_half_sin_cos();
        self.middle.scaled(cos) + self.across.scaled(sin)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;

    fn unit() -> impl Strategy<Value = DQuat> {
        prop::array::uniform3(-400.0..400.0f64).prop_map(|[z, x, y]| {
            DQuat::from_rotation_z(z.to_radians())
                * DQuat::from_rotation_x(x.to_radians())
                * DQuat::from_rotation_y(y.to_radians())
        })
    }

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-10.0..10.0).prop_map(DVec3::from_array)
    }

    proptest! {
        #[test]
        fn lanes_multiply_turn_and_rotate_as_single_ones_do(
            a in unit(), b in unit(), vec in vector(), degrees in -400.0..400.0, lane in 0..super::super::LANES,
        ) {
            let (wide_a, wide_b) = (LaneQuat::splat(a), LaneQuat::splat(b));
            let near = |found: LaneQuat, expected: DQuat| found.lane(lane).abs_diff_eq(expected, 1e-14);
            prop_assert!(near(wide_a * wide_b, a * b));
            let rotated = wide_a.rotate(LaneVec::splat(vec)).lane(lane);
            prop_assert!(rotated.abs_diff_eq(a * vec, 1e-13));
            let half = Lanes::splat(degrees).half_sin_cos();
            for (axis, unit) in [(Axis::X, DVec3::X), (Axis::Y, DVec3::Y), (Axis::Z, DVec3::Z)] {
                let about = DQuat::from_axis_angle(unit, f64::to_radians(degrees));
                prop_assert!(near(LaneQuat::default().turned(axis, half), about));
                prop_assert!(near(wide_a.turned(axis, half), a * about));
            }
        }

        #[test]
        fn a_slerp_goes_evenly_on_the_short_way(a in unit(), b in unit(), share in 0.0..1.0) {
            let found = LaneQuat::splat(a).slerp(LaneQuat::splat(b), Lanes::splat(share)).lane(1);
            let expected = a.slerp(b, share);
            // glam measures the arc by an arc cosine, which loses half the digits of a small angle.
            prop_assert!(found.dot(expected).abs() > 1.0 - 1e-13, "{found} {expected}");
            let same = LaneQuat::splat(a).slerp(LaneQuat::splat(a), Lanes::splat(share)).lane(0);
            prop_assert_eq!(same, a, "between equals nothing moves");
        }
    }

    proptest! {
        #[test]
        fn the_angle_between_two_is_that_of_the_way_from_one_to_the_other(
            a in unit(), b in unit(), size in prop_oneof![0.0..PI, 0.0..1e-6, 3.1..PI], flip in prop::bool::ANY,
        ) {
            let axis = b.xyz().try_normalize().unwrap_or(DVec3::X);
            let to = a * DQuat::from_axis_angle(axis, size);
            for to in [b, if flip { -to } else { to }] {
                let way = a.conjugate() * to;
                let expected = 2.0 * way.xyz().length().atan2(way.w.abs());
                let found = LaneQuat::splat(a).angle_to(LaneQuat::splat(to)).0[1];
                // Both are as precise as the digits of the quaternions allow.
                let near = 8.0 * f64::EPSILON * expected + 2e-15;
                prop_assert!((found - expected).abs() < near, "{found} {expected}");
            }
            prop_assert_eq!(LaneQuat::splat(a).angle_to(LaneQuat::splat(-a)), Lanes::ZERO);
        }
    }

    #[test]
    fn a_tiny_angle_between_two_keeps_its_digits() {
        for angle in [1e-3, 1e-6, 1e-9, 1e-12, 1e-100] {
            let to = DQuat::from_xyzw(0.0, f64::sin(0.5 * angle), 0.0, f64::cos(0.5 * angle));
            for to in [to, -to] {
                let found = LaneQuat::default().angle_to(LaneQuat::splat(to)).0[0];
                assert!((found - angle).abs() <= 4.0 * f64::EPSILON * angle, "{found} {angle}");
            }
        }
    }

    #[test]
    fn the_angle_of_a_lane_is_the_same_whatever_the_others_turn_by() {
        let turned = |degrees: f64| DQuat::from_rotation_y(degrees.to_radians());
        for degrees in (1..1800).map(|tenths| 0.1 * f64::from(tenths)) {
            let alone = LaneQuat::default().angle_to(LaneQuat::splat(turned(degrees)));
            let near = 4.0 * f64::EPSILON * degrees.to_radians();
            assert!((alone.0[0] - degrees.to_radians()).abs() <= near, "{degrees}");
            for other in [1e-3, 19.0, 90.0, 170.0] {
                let mut among = LaneQuat::splat(turned(other));
                among.set_lane(1, turned(degrees));
                assert_eq!(LaneQuat::default().angle_to(among).0[1], alone.0[1], "{degrees}");
            }
        }
    }

    #[test]
    fn a_slerp_of_a_tiny_way_is_exact() {
        let (a, b) = (DQuat::from_rotation_z(0.3), DQuat::from_rotation_z(0.3 + 1e-7));
        let found = LaneQuat::splat(a).slerp(LaneQuat::splat(b), Lanes::splat(0.25)).lane(0);
        let expected = DQuat::from_rotation_z(0.3 + 0.25e-7);
        assert!(found.abs_diff_eq(expected, 2e-16), "{found} {expected}");
    }

    #[test]
    fn each_lane_goes_its_own_way() {
        let (mut from, mut to) = (LaneQuat::default(), LaneQuat::default());
        from.set_lane(1, DQuat::from_rotation_x(0.5));
        to.set_lane(1, -DQuat::from_rotation_x(1.5));
        let found = from.slerp(to, Lanes::splat(0.5));
        assert_eq!(found.lane(0), DQuat::IDENTITY);
        assert!(found.lane(1).abs_diff_eq(DQuat::from_rotation_x(1.0), 1e-15));
        let shifted = to.shifted(DQuat::from_rotation_z(1.0));
        assert_eq!(shifted.lane(0), DQuat::from_rotation_z(1.0));
        assert_eq!(shifted.lane(1), to.lane(0));
        let turned = to.angle_to(from);
        assert!(turned.0[0] == 0.0 && (turned.0[1] - 1.0).abs() < 1e-15);
    }
}
