//! Curve simplification after Ramer (1972), Douglas and Peucker (1973), on poses.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::quality::KomaFrames;
use genga::keys::Bridge;

/// A simplified list of frames (曲線の単純化). The error of a segment is that of slerping between its ends at the worst koma,
/// which is where it is split. The segment with the largest error is split first, so that there is an answer for every
/// count.
#[derive(Debug, Clone, PartialEq)]
pub struct Simplified {
    /// Places in the order in which they became keys.
    order: Vec<usize>,
}

/// A segment that may be split.
struct Split {
    error: f64,
    from: usize,
    at: usize,
    to: usize,
}

impl Simplified {
    /// Splits until there are `most` keys between both ends, or nothing is left to split.
    pub fn new(grid: &KomaFrames, most: usize) -> Self {
        let mut bridge = Bridge::new(&grid.clip, &grid.reference, &grid.frames);
        let mut queue = BinaryHeap::new();
        let last = grid.frames.len().saturating_sub(1);
        queue.extend(Split::new(grid, &mut bridge, 0, last));
        let mut order = Vec::new();
        while order.len() < most
            && let Some(Split { from, at, to, .. }) = queue.pop()
        {
            order.push(at);
            queue.extend(Split::new(grid, &mut bridge, from, at));
            queue.extend(Split::new(grid, &mut bridge, at, to));
        }
        Self { order }
    }

    /// Returns the places of the first `count` keys that it splits at, sorted.
    pub fn keys(&self, count: usize) -> Vec<usize> {
        let mut keys = self.order[..count.min(self.order.len())].to_vec();
        keys.sort_unstable();
        keys
    }
}

impl Split {
    /// Finds the split of a segment; `None` if nothing lies inside.
    fn new(grid: &KomaFrames, bridge: &mut Bridge<'_>, from: usize, to: usize) -> Option<Self> {
        if to - from < 2 {
            return None;
        }
        // A segment without error is split in the middle.
        let mut worst = Self { error: 0.0, from, at: from.midpoint(to), to };
        // A frame is the nearest to its koma and may lie beyond it, so the koma of the ends do not count.
        bridge.errors(from, to, |koma, error| {
            let at = grid.place(koma);
            if error > worst.error && from < at && at < to {
                (worst.error, worst.at) = (error, at);
            }
        });
        Some(worst)
    }
}

/// By error; of equal ones the earlier is the greater.
impl Ord for Split {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error).then(other.from.cmp(&self.from))
    }
}

impl PartialOrd for Split {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Split {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Split {}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::quality::tests::{grid, swing};
    use genga::keys::Reconstruction;
    use genga::time::FrameRate;

    #[test]
    fn a_zigzag_is_split_at_its_corners_the_largest_first() {
        let corners = [0.0, 60.0, 10.0, 30.0];
        let legs = corners
            .windows(2)
            .flat_map(|leg| (0..10).map(|at| leg[0] + (leg[1] - leg[0]) * f64::from(at) / 10.0));
        let grid = grid(&legs.chain([30.0]).collect::<Vec<_>>());
        let simplified = Simplified::new(&grid, 2);
        assert_eq!((simplified.keys(1), simplified.keys(2)), (vec![10], vec![10, 20]));
        assert_eq!(simplified.keys(9), [10, 20], "no more than were looked for");
        let left = Reconstruction::new(&grid.clip, &grid.reference, &grid.frames_at(&[10, 20]));
        assert!(left.worst() < 1e-9, "{}", left.worst());
    }

    #[test]
    fn each_split_is_at_the_worst_koma_of_the_worst_segment() {
        let angles: Vec<f64> =
            (0..50).map(|at| 40.0 * (f64::from(at) * 0.31).sin() + f64::from(at)).collect();
        let grid = grid(&angles);
        let simplified = Simplified::new(&grid, 12);
        for count in 0..12 {
            let keys = simplified.keys(count);
            let errors =
                Reconstruction::new(&grid.clip, &grid.reference, &grid.frames_at(&keys)).errors;
            let next = simplified.order[count];
            assert!(errors.iter().all(|error| *error <= errors[next] + 1e-12), "{count}");
        }
    }

    #[test]
    fn what_stands_still_is_split_all_the_same() {
        let simplified = Simplified::new(&grid(&[7.0; 9]), 99);
        assert_eq!(simplified.keys(99), [1, 2, 3, 4, 5, 6, 7]);
        assert!(Simplified::new(&grid(&[7.0]), 5).keys(5).is_empty());
    }

    #[test]
    fn frames_fewer_than_koma_and_more_are_split_too() {
        for fps in [10.0, 100.0] {
            let angles: Vec<f64> = (0..60).map(|at| 40.0 * (f64::from(at) * 0.5).sin()).collect();
            let clip = Arc::new(swing(&angles).with_rate(FrameRate::new(fps).unwrap()));
            let clock = clip.clock(24.0);
            let grid = KomaFrames::new(clip, clock);
            let keys = Simplified::new(&grid, usize::MAX).keys(usize::MAX);
            assert_eq!(keys, (1..=grid.inner()).collect::<Vec<_>>(), "{fps}");
        }
    }
}
