//! The longest polyline with a given number of corners (Morishima et al. 2007, as KKMFT §2 tells it):
//! poses that are as far from each other as can be.

use rayon::prelude::*;

use crate::quality::KomaFrames;

/// Polylines through the poses of a clip that are as long as they can be for their corners (最長の折れ線).
///
/// A pose is a point: where the body's points stand in the world, each weighed by its bone. The length
/// of a side is the root mean square way of the points from one pose to the other, in % of body
/// height. The sketch leaves open what the distance is of; this is the one that errors are of here.
#[derive(Debug, Clone, PartialEq)]
pub struct LongestPolyline {
    frames: usize,
    /// One a count: for each frame the corner before it on the longest way there.
    before: Vec<Vec<u32>>,
}

impl LongestPolyline {
    /// The longest polylines of 0 to `most` corners between both ends, by dynamic programming. Of two
    /// equally long ones it is that whose last corner is the earliest.
    pub fn of(grid: &KomaFrames, most: usize) -> Self {
        let frames = grid.frames.len();
        let sides: Vec<Vec<f64>> = (0..frames).into_par_iter().map(|to| sides(grid, to)).collect();
        let mut ways: Vec<f64> =
            sides.iter().map(|side| side.first().copied().unwrap_or(0.0)).collect();
        let mut before = vec![vec![0; frames]];
        for keys in 1..=most.min(grid.inner()) {
            let step = |to: usize| {
                let joined = (keys..to).map(|from| (ways[from] + sides[to][from], from as u32));
                let longest = joined.reduce(|a, b| if b.0 > a.0 { b } else { a });
                longest.unwrap_or((f64::NEG_INFINITY, 0))
            };
            let (longer, last): (Vec<f64>, Vec<u32>) =
                (0..frames).into_par_iter().map(step).unzip();
            ways = longer;
            before.push(last);
        }
        Self { frames, before }
    }

    /// The corners of the longest polyline of so many, by place and without the ends; of the largest
    /// number that was looked for where more are asked.
    pub fn keys(&self, count: usize) -> Vec<usize> {
        let count = count.min(self.before.len() - 1);
        let mut place = self.frames.saturating_sub(1);
        let mut keys = Vec::with_capacity(count);
        for corners in self.before[1..=count].iter().rev() {
            place = corners[place] as usize;
            keys.push(place);
        }
        keys.reverse();
        keys
    }
}

/// How far each earlier pose is from one.
fn sides(grid: &KomaFrames, to: usize) -> Vec<f64> {
    (0..to).map(|from| grid.reference.apart(grid.koma(from), grid.koma(to))).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::quality::tests::grid;

    fn length(grid: &KomaFrames, keys: &[usize]) -> f64 {
        let corners = [&[0], keys, &[grid.frames.len() - 1]].concat();
        corners.windows(2).map(|side| grid.reference.apart(side[0], side[1])).sum()
    }

    proptest! {
        #[test]
        fn no_other_polyline_of_as_many_corners_is_longer(
            angles in prop::collection::vec(-80.0..80.0, 2..11),
        ) {
            let grid = grid(&angles);
            let longest = LongestPolyline::of(&grid, usize::MAX);
            for count in 0..=grid.inner() {
                let keys = longest.keys(count);
                prop_assert_eq!(keys.len(), count);
                prop_assert!(keys.is_sorted_by(|a, b| a < b));
                let found = length(&grid, &keys);
                for set in 0u32..1 << grid.inner() {
                    if set.count_ones() as usize == count {
                        let other: Vec<usize> =
                            (1..=grid.inner()).filter(|at| set & (1 << (at - 1)) != 0).collect();
                        prop_assert!(length(&grid, &other) <= found + 1e-9);
                    }
                }
            }
        }
    }

    #[test]
    fn its_corners_are_the_furthest_poses() {
        let grid = grid(&[0.0, 20.0, 60.0, 30.0, -40.0, -10.0, 0.0]);
        assert_eq!(LongestPolyline::of(&grid, 2).keys(2), [2, 4]);
    }
}
