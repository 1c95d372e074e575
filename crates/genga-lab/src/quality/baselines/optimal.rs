//! The optimal keys for reconstruction, for every count: dynamic programming over all segments (Lim & Thalmann 2001;
//! Roberts et al., Salient Poses, 2019).

use rayon::prelude::*;

use crate::quality::baselines::Segments;
use genga::motion::lanes::{LANES, Lanes, wide};

/// With fewer frames, the work is not worth another thread.
const FEW: usize = 64;

/// The objective to minimise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Objective {
    /// The error summed over all koma, which also minimises the mean.
    Mean,
    /// The error of the worst koma.
    Worst,
}

impl Objective {
    /// Returns the costs of the segments that end at a frame, by their begin.
    fn column(self, segments: &Segments, to: usize) -> &[f64] {
        match self {
            Self::Mean => segments.sums(to),
            Self::Worst => segments.worsts(to),
        }
    }

    /// Joins a path to a frame and a segment from there, and returns the total cost.
    #[inline(always)]
    fn joined(self, way: Lanes, segment: Lanes) -> Lanes {
        match self {
            Self::Mean => way + segment,
            Self::Worst => way.max(segment),
        }
    }
}

/// The optimal key sets (最適な原画の組) for every count up to a maximum.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimal {
    frames: usize,
    /// For each count, the cost of the best set from the first frame to the last.
    costs: Vec<f64>,
    /// For each count and frame, the key before the frame on the best path to it.
    before: Vec<Vec<u32>>,
}

impl Optimal {
    /// Finds the best sets of 0 to `most` keys between both ends, or of as many as there are frames.
    ///
    /// The best path to a frame with one more key is the best combination of a best path to an earlier frame and the
    /// segment from there. On a tie, the path whose last key is the earliest wins.
    pub fn new(segments: &Segments, objective: Objective, most: usize) -> Self {
        let frames = segments.len();
        let most = most.min(frames.saturating_sub(2));
        let mut found = Self { frames, costs: vec![], before: vec![] };
        if frames < 2 {
            return Self { costs: vec![0.0], before: vec![vec![]], ..found };
        }
        let direct =
            |to: usize| objective.column(segments, to).first().copied().unwrap_or(f64::INFINITY);
        let mut ways: Vec<f64> = (0..frames).map(direct).collect();
        found.keep(&ways, vec![0; frames]);
        for keys in 1..=most {
            let step = |to: usize| cheapest(objective, &ways, objective.column(segments, to), keys);
            let steps = (0..frames).into_par_iter().with_min_len(FEW).map(step);
            let (longer, before): (Vec<f64>, Vec<u32>) = steps.unzip();
            ways = longer;
            found.keep(&ways, before);
        }
        found
    }

    fn keep(&mut self, ways: &[f64], before: Vec<u32>) {
        self.costs.push(ways[self.frames - 1]);
        self.before.push(before);
    }

    /// Returns the largest number of keys computed.
    pub fn most(&self) -> usize {
        self.costs.len() - 1
    }

    /// Returns the cost of the best set of `keys` keys: the sum over koma or the worst koma, in % of body height.
    ///
    /// # Panics
    /// Panics if `keys` is larger than [`Optimal::most`].
    pub fn cost(&self, keys: usize) -> f64 {
        self.costs[keys]
    }

    /// Returns the places of the best set of `count` keys, or of the largest set computed, without the ends.
    pub fn keys(&self, count: usize) -> Vec<usize> {
        let count = count.min(self.most());
        let mut place = self.frames.saturating_sub(1);
        let mut keys: Vec<usize> = (1..=count)
            .rev()
            .map(|left| {
                place = self.before[left][place] as usize;
                place
            })
            .collect();
        keys.reverse();
        keys
    }
}

/// Returns the least cost of a path to a frame with `keys` keys before it, and the last of these. Paths with fewer keys
/// end at earlier frames: `ways` has one more entry than they can reach.
fn cheapest(objective: Objective, ways: &[f64], column: &[f64], keys: usize) -> (f64, u32) {
    // The keys need as many frames before this one, and the first frame is not a key.
    if column.len() <= keys {
        return (f64::INFINITY, 0);
    }
    let (ways, column) = (&ways[keys..column.len()], &column[keys..]);
    let joined = |at: usize| {
        let lanes = |values: &[f64]| Lanes::from_fn(|lane| values[at + lane]);
        objective.joined(lanes(ways), lanes(column))
    };
    let whole = column.len() / LANES * LANES;
    let rest = |at: usize| objective.joined(Lanes::splat(ways[at]), Lanes::splat(column[at])).0[0];
    let least = wide(
        #[inline(always)]
        || {
            (0..whole)
                .step_by(LANES)
                .fold(Lanes::splat(f64::INFINITY), |least, at| least.min(joined(at)))
        },
    );
    let least =
        least.0.into_iter().chain((whole..column.len()).map(rest)).fold(f64::INFINITY, f64::min);
    let first = (0..column.len()).find(|at| rest(*at) <= least).unwrap_or(0);
    (least, (keys + first) as u32)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::quality::KomaFrames;
    use crate::quality::tests::{grid, swing};
    use genga::keys::{Reconstruction, Reference};

    fn error(grid: &KomaFrames, objective: Objective, keys: &[usize]) -> f64 {
        let keys = grid.frames_at(keys);
        let found = Reconstruction::new(&grid.clip, &grid.reference, &keys);
        match objective {
            Objective::Mean => found.errors.iter().sum(),
            Objective::Worst => found.worst(),
        }
    }

    /// Finds the least error of any set of `count` keys by brute force.
    fn by_force(grid: &KomaFrames, objective: Objective, count: usize) -> f64 {
        let inner = grid.inner();
        let sets = (0u32..1 << inner).filter(|set| set.count_ones() as usize == count);
        let keys = |set: u32| -> Vec<usize> {
            (1..=inner).filter(|place| set & (1 << (place - 1)) != 0).collect()
        };
        sets.map(|set| error(grid, objective, &keys(set))).fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn no_other_set_of_as_many_keys_is_better(
            angles in prop::collection::vec(-80.0..80.0, 2..11),
        ) {
            let grid = grid(&angles);
            let segments = Segments::new(&grid);
            for objective in [Objective::Mean, Objective::Worst] {
                let best = Optimal::new(&segments, objective, usize::MAX);
                prop_assert_eq!(best.most(), grid.inner());
                for count in 0..=best.most() {
                    let keys = best.keys(count);
                    prop_assert_eq!(keys.len(), count);
                    prop_assert!(keys.is_sorted_by(|a, b| a < b), "{:?}", keys);
                    let least = by_force(&grid, objective, count);
                    prop_assert!((error(&grid, objective, &keys) - least).abs() < 1e-9);
                    prop_assert!((best.cost(count) - least).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn all_keys_cost_nothing_and_a_shorter_search_finds_the_same() {
        let angles: Vec<f64> = (0..70).map(|at| 40.0 * (f64::from(at) * 0.37).sin()).collect();
        let segments = Segments::new(&grid(&angles));
        for objective in [Objective::Mean, Objective::Worst] {
            let best = Optimal::new(&segments, objective, usize::MAX);
            assert_eq!(best.cost(68), 0.0);
            assert!(best.cost(34) < 0.1 * best.cost(0), "{objective:?}");
            let fewer = Optimal::new(&segments, objective, 9);
            assert_eq!((fewer.most(), fewer.keys(9)), (9, best.keys(9)));
            assert_eq!(fewer.keys(40), best.keys(9), "no more than were looked for");
        }
    }

    #[test]
    fn a_segment_is_the_error_of_its_two_keys_alone() {
        let grid = grid(&[0.0, 20.0, -10.0, 50.0, 5.0, 5.0, 60.0]);
        let segments = Segments::new(&grid);
        let whole = Reconstruction::new(&grid.clip, &grid.reference, &[]);
        assert!((segments.sums(6)[0] - whole.errors.iter().sum::<f64>()).abs() < 1e-9);
        assert_eq!(segments.worsts(6)[0], whole.worst());
        let parts = Reconstruction::new(&grid.clip, &grid.reference, &grid.frames_at(&[1, 4]));
        let inner: f64 = parts.errors[1..4].iter().sum();
        assert!((segments.sums(4)[1] - inner).abs() < 1e-9);
        assert_eq!((segments.sums(3)[2], segments.worsts(5)[4]), (0.0, 0.0), "neighbours");
    }

    #[test]
    fn a_clip_of_one_frame_has_no_key_to_give() {
        for angles in [&[3.0][..], &[3.0, 4.0]] {
            let grid = grid(angles);
            let best = Optimal::new(&Segments::new(&grid), Objective::Mean, 5);
            assert_eq!((best.most(), best.cost(0), best.keys(5)), (0, 0.0, vec![]));
        }
        let clip = swing(&[0.0; 9]);
        assert_eq!(Reference::new(&clip, clip.clock(24.0)).koma(), 9);
    }
}
