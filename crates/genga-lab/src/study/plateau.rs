//! Plateaus: regions of settings in which the keys stay the same.

use crate::study::axis::Axis;
use crate::study::grid::Grid;
use genga::time::Frame;

/// Adjacent cells with the same keys (変わらない範囲). Within the region the exact setting does not matter.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plateau {
    /// The cell with whose keys all others are compared.
    pub seed: usize,
    /// Its cells including the seed, as indices into [`Grid::cells`], in ascending order.
    pub cells: Vec<usize>,
    /// Number of keys of the seed, over all clips.
    pub keys: usize,
}

impl Plateau {
    /// Finds the largest plateau over all clips of a study at once. A cell belongs to it if each of its keys lies
    /// within `koma` koma of its own key of the seed, and if it is connected to the seed horizontally and vertically.
    /// With 0 koma the keys must be identical. On a tie, the one found first in the order of the cells wins.
    ///
    /// Every cell is compared with the seed and not with its neighbour, so that small moves do not add up. Cells
    /// without keys are no plateau, as empty sets always agree. `None` if the seed has no companion anywhere, or if the
    /// study did not keep its keys.
    pub fn largest(grids: &[Grid], koma: f64) -> Option<Self> {
        let cells = grids.first()?.cells.len();
        let keys: Vec<Vec<&[Frame]>> = (0..cells)
            .map(|at| grids.iter().map(|grid| grid.cells[at].keys.as_deref()).collect())
            .collect::<Option<_>>()?;
        let tolerances: Vec<f64> = grids.iter().map(|grid| koma * grid.frames_in_koma).collect();
        let alike = |a: usize, b: usize| {
            let clips = keys[a].iter().zip(&keys[b]).zip(&tolerances);
            clips.into_iter().all(|((a, b), tolerance)| are_alike(a, b, *tolerance))
        };
        let mut largest: Option<Self> = None;
        // Cells next to a seed with identical keys have the same region.
        let mut is_known = vec![false; cells];
        for seed in 0..cells {
            let count = keys[seed].iter().map(|keys| keys.len()).sum();
            if count == 0 || is_known[seed] {
                continue;
            }
            let region = region(&grids[0], seed, |at| alike(seed, at));
            region.iter().for_each(|at| is_known[*at] |= keys[*at] == keys[seed]);
            if region.len() > largest.as_ref().map_or(1, |plateau| plateau.cells.len()) {
                largest = Some(Self { seed, cells: region, keys: count });
            }
        }
        largest
    }

    /// Whether a cell belongs to the plateau.
    pub fn holds(&self, at: usize) -> bool {
        self.cells.binary_search(&at).is_ok()
    }

    /// Describes in words the settings of the cell with which all others are compared.
    pub fn seed_words(&self, grid: &Grid) -> String {
        let value = |axis: &Axis, at: usize| format!("{} {}", axis.name(), axis.values()[at]);
        let x = value(&grid.x, self.seed / grid.rows());
        match &grid.y {
            Some(axis) => format!("{x}, {}", value(axis, self.seed % grid.rows())),
            None => x,
        }
    }

    /// Describes in words the settings it covers and its number of cells.
    pub fn words(&self, grid: &Grid) -> String {
        let columns = ends(self.cells.iter().map(|at| at / grid.rows()));
        let rows = ends(self.cells.iter().map(|at| at % grid.rows()));
        let range = |axis: &Axis, (first, last): (usize, usize)| {
            let (name, values) = (axis.name(), axis.values());
            if first == last {
                return format!("{name} {}", values[first]);
            }
            format!("{name} {} to {}", values[first], values[last])
        };
        let within = (columns.1 - columns.0 + 1) * (rows.1 - rows.0 + 1);
        let mut words = range(&grid.x, columns);
        if let Some(axis) = &grid.y {
            words = format!("{words}, {}", range(axis, rows));
        }
        let (cells, all) = (self.cells.len(), grid.cells.len());
        match within {
            within if within == cells => format!("{words}: {cells} of {all} cells"),
            within => format!("{words}: {cells} of {all} cells, not all of the {within} there"),
        }
    }
}

/// Whether each key of two lists has a partner within a tolerance in frames. Pairing in order is optimal, so the first
/// is paired with the first.
fn are_alike(a: &[Frame], b: &[Frame], tolerance: f64) -> bool {
    let near = |(a, b): (&Frame, &Frame)| a.0.abs_diff(b.0) as f64 <= tolerance;
    a.len() == b.len() && a.iter().zip(b).all(near)
}

/// Returns the cells connected to a cell through cells that belong, in ascending order.
fn region(grid: &Grid, seed: usize, belongs: impl Fn(usize) -> bool) -> Vec<usize> {
    let mut is_seen = vec![false; grid.cells.len()];
    is_seen[seed] = true;
    let (mut region, mut next) = (Vec::new(), vec![seed]);
    while let Some(at) = next.pop() {
        region.push(at);
        for beside in grid.neighbours(at) {
            if !is_seen[beside] && belongs(beside) {
                is_seen[beside] = true;
                next.push(beside);
            }
        }
    }
    region.sort_unstable();
    region
}

/// Returns the least and the largest of some numbers.
fn ends(numbers: impl Iterator<Item = usize>) -> (usize, usize) {
    numbers.fold((usize::MAX, 0), |(low, high), number| (low.min(number), high.max(number)))
}

#[cfg(test)]
mod tests {
    use std::slice::from_ref;

    use super::*;
    use crate::study::tests::grid_of_keys;

    const A: &[usize] = &[10, 50];
    const B: &[usize] = &[10, 52];
    const C: &[usize] = &[10, 58];
    const NONE: &[usize] = &[];

    fn largest(grid: &Grid, koma: f64) -> Option<(usize, Vec<usize>)> {
        let plateau = Plateau::largest(from_ref(grid), koma)?;
        Some((plateau.seed, plateau.cells))
    }

    #[test]
    fn the_largest_region_with_the_same_keys_is_found() {
        // Columns of three: two regions of A that touch only across a corner.
        let grid = grid_of_keys(3, 3, &[A, A, B, B, B, A, B, A, A]);
        assert_eq!(largest(&grid, 0.0), Some((3, vec![3, 4, 6])), "5 7 8 are as many, and later");
        let grid = grid_of_keys(3, 3, &[A, A, B, B, B, B, A, A, A]);
        assert_eq!(largest(&grid, 0.0), Some((2, vec![2, 3, 4, 5])));
        let plateau = Plateau::largest(from_ref(&grid), 0.0).unwrap();
        assert_eq!(plateau.keys, 2);
        assert!(plateau.holds(5) && !plateau.holds(6));
        assert_eq!(
            plateau.words(&grid),
            "filter.width 1 to 2, turns.persistence 1 to 3: 4 of 9 cells, not all of the 6 there"
        );
    }

    #[test]
    fn a_row_and_a_whole_grid_are_named_by_their_ends() {
        let grid = grid_of_keys(4, 1, &[B, A, A, A]);
        let plateau = Plateau::largest(from_ref(&grid), 0.0).unwrap();
        assert_eq!(plateau.words(&grid), "filter.width 2 to 4: 3 of 4 cells");
        let grid = grid_of_keys(1, 2, &[A, A]);
        let plateau = Plateau::largest(from_ref(&grid), 0.0).unwrap();
        assert_eq!(plateau.words(&grid), "filter.width 1, turns.persistence 1 to 2: 2 of 2 cells");
    }

    #[test]
    fn within_a_koma_small_moves_count_as_none_and_do_not_add_up() {
        // Five frames are a koma: A and B are alike, B and C are not, and d lies between those.
        let d: &[usize] = &[10, 56];
        let grid = grid_of_keys(4, 1, &[A, B, d, C]);
        assert_eq!(largest(&grid, 0.0), None, "no two are the same");
        assert_eq!(largest(&grid, 1.0), Some((1, vec![0, 1, 2])), "C is 6 from B");
        let d: &[usize] = &[10, 55];
        let grid = grid_of_keys(4, 1, &[A, d, C, C]);
        assert_eq!(largest(&grid, 1.0), Some((1, vec![0, 1, 2, 3])), "all are within 5 of 55");
    }

    #[test]
    fn another_number_of_keys_is_another_set_however_near() {
        let grid = grid_of_keys(2, 1, &[&[10, 11], &[10]]);
        assert_eq!(largest(&grid, 9.0), None);
    }

    #[test]
    fn nothing_is_no_plateau() {
        assert_eq!(largest(&grid_of_keys(4, 1, &[NONE, NONE, NONE, A]), 0.0), None);
        assert_eq!(largest(&grid_of_keys(1, 1, &[A]), 0.0), None, "one cell alone");
        let mut grid = grid_of_keys(2, 1, &[A, A]);
        grid.cells[0].keys = None;
        assert_eq!(largest(&grid, 0.0), None);
        assert_eq!(Plateau::largest(&[], 0.0), None);
    }

    #[test]
    fn of_several_clips_all_must_stay() {
        let one = grid_of_keys(4, 1, &[A, A, A, B]);
        let other = grid_of_keys(4, 1, &[B, C, C, C]);
        let plateau = Plateau::largest(&[one, other], 0.0).unwrap();
        assert_eq!((plateau.seed, plateau.cells, plateau.keys), (1, vec![1, 2], 4));
        // A koma is five frames of one clip and two of the other.
        let d: &[usize] = &[10, 53];
        let mut grids = [grid_of_keys(2, 1, &[A, d]), grid_of_keys(2, 1, &[A, A])];
        assert!(Plateau::largest(&grids, 1.0).is_some());
        grids[0].frames_in_koma = 2.0;
        assert_eq!(Plateau::largest(&grids, 1.0), None);
        grids.reverse();
        assert_eq!(Plateau::largest(&grids, 1.0), None);
    }
}
