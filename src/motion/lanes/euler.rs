//! Products of rotations about three different axes, in closed form.

use super::{LaneQuat, LaneVec, Lanes};
use crate::motion::Axis;

/// Three different axes in the order in which their rotations are multiplied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreeAxes {
    axes: [Axis; 3],
    /// 1 if the axes follow each other like x, y, z, −1 if in reverse order.
    sense: f64,
}

impl ThreeAxes {
    /// Returns `None` if an axis occurs twice.
    pub fn new(axes: [Axis; 3]) -> Option<Self> {
        let [first, second, third] = axes.map(|axis| axis as usize);
        let different = first != second && second != third && third != first;
        let sense = if (first + 1) % 3 == second { 1.0 } else { -1.0 };
        different.then_some(Self { axes, sense })
    }

    /// Computes the product of three rotations, given by the sine and cosine of half of each angle. The result is in
    /// the basis of the three axes as listed, with the third reversed if `sense` is −1. Angles between rotations are
    /// the same in any basis, and this one costs nothing to make.
    #[inline(always)]
    pub fn product(self, halves: [(Lanes, Lanes); 3]) -> LaneQuat {
        let [(sin_a, cos_a), (sin_b, cos_b), (sin_c, cos_c)] = halves;
        let sin_c = sin_c * Lanes::splat(self.sense);
        let (neither, first) = (cos_a * cos_b, sin_a * cos_b);
        let (second, both) = (cos_a * sin_b, sin_a * sin_b);
        let v = LaneVec {
            x: first * cos_c + second * sin_c,
            y: second * cos_c - first * sin_c,
            z: neither * sin_c + both * cos_c,
        };
        LaneQuat { v, w: neither * cos_c - both * sin_c }
    }

    /// Computes the product in the joint's own basis.
    #[inline(always)]
    pub fn rotation(self, halves: [(Lanes, Lanes); 3]) -> LaneQuat {
        let LaneQuat { v, w } = self.product(halves);
        let [first, second, third] = self.axes;
        let mut turned = LaneVec::default();
        *turned.axis_mut(first) = v.x;
        *turned.axis_mut(second) = v.y;
        *turned.axis_mut(third) = v.z * Lanes::splat(self.sense);
        LaneQuat { v: turned, w }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

    #[test]
    fn an_axis_twice_is_no_three_axes() {
        let lists = AXES.map(|a| AXES.map(|b| AXES.map(|c| [a, b, c])));
        let orders =
            lists.iter().flatten().flatten().filter(|axes| ThreeAxes::new(**axes).is_some());
        assert_eq!(orders.count(), 6);
    }

    proptest! {
        #[test]
        fn the_closed_form_turns_by_what_one_turn_after_the_other_does(
            before in prop::array::uniform3(-400.0..400.0),
            after in prop::array::uniform3(-400.0..400.0),
        ) {
            for [a, b, c] in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0], [1, 0, 2], [0, 2, 1]] {
                let axes = [AXES[a], AXES[b], AXES[c]];
                let halves = |degrees: [f64; 3]| degrees.map(|angle| Lanes::splat(angle).half_sin_cos());
                let closed = |degrees| ThreeAxes::new(axes).unwrap().product(halves(degrees)).lane(1);
                let single = |degrees: [f64; 3]| {
                    let [a, b, c] = halves(degrees);
                    LaneQuat::default().turned(axes[0], a).turned(axes[1], b).turned(axes[2], c).lane(1)
                };
                let (found, expected) = (closed(before).dot(closed(after)), single(before).dot(single(after)));
                prop_assert!((found - expected).abs() < 1e-14, "{axes:?}: {found} {expected}");
                let turned = ThreeAxes::new(axes).unwrap().rotation(halves(before)).lane(0);
                prop_assert!(turned.abs_diff_eq(single(before), 1e-15), "{axes:?}: {turned}");
            }
        }
    }
}
