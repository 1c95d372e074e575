//! The longest polyline with a given number of corners (Morishima et al. 2007, as described in KKMFT §2): key poses as
//! far apart as possible.

use rayon::prelude::*;

use crate::quality::KomaFrames;

/// The longest polylines through the poses of a clip, by number of corners (最長の折れ線).
///
/// A pose is a point: the world positions of the body's points, each weighted by its bone. The length of a side is the
/// root mean square distance of the points between the two poses, in % of body height. The paper's sketch does not
/// define the distance; this is the one used for errors here.
#[derive(Debug, Clone, PartialEq)]
pub struct LongestPolyline {
    frames: usize,
    /// For each count and frame, the corner before the frame on the longest path to it.
    before: Vec<Vec<u32>>,
}

impl LongestPolyline {
    /// Finds the longest polylines of 0 to `most` corners between both ends by dynamic programming. On a tie, the one
    /// whose last corner is the earliest wins.
    pub fn new(grid: &KomaFrames, most: usize) -> Self {
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

    /// Returns the places of the corners of the longest polyline with `count` corners, without the ends; of the largest
    /// number computed, if `count` is larger.
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

/// Returns the distance of each earlier pose from one.
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
            let longest = LongestPolyline::new(&grid, usize::MAX);
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
        assert_eq!(LongestPolyline::new(&grid, 2).keys(2), [2, 4]);
    }
}
