//! Steadiness: how far keys move when a setting changes a little, by comparing each cell with its neighbours.

use crate::study::grid::Grid;
use genga::keys::Matching;

/// The keys of a cell compared with those of its neighbours: two in a row of cells, four in a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steadiness {
    /// The share of keys with a counterpart in the other cell, 0 to 1, over all neighbours; 1 if no cell has a key.
    pub kept: f64,
    /// The mean distance between counterparts, in source frames; `None` without a pair.
    pub mean_move: Option<f64>,
    /// The largest distance between counterparts, in source frames; `None` without a pair.
    pub largest_move: Option<usize>,
}

/// Counts shared by a cell and its neighbours.
#[derive(Debug, Clone, Copy, Default)]
struct Tally {
    pairs: usize,
    keys: usize,
    way: usize,
    longest: Option<usize>,
}

impl Tally {
    fn add(&mut self, matching: &Matching) {
        self.pairs += matching.pairs.len();
        self.keys += matching.len();
        self.way += matching.moves().sum::<usize>();
        self.longest = self.longest.max(matching.largest_move());
    }

    fn steadiness(self) -> Steadiness {
        let share = |of: usize, all: usize| (all > 0).then(|| of as f64 / all as f64);
        Steadiness {
            kept: share(2 * self.pairs, self.keys).unwrap_or(1.0),
            mean_move: share(self.way, self.pairs),
            largest_move: self.longest,
        }
    }
}

/// Computes the steadiness of every cell; keys within `koma` koma are counterparts. `None` unless the study kept its
/// keys.
pub fn steadiness(grid: &Grid, koma: f64) -> Option<Vec<Steadiness>> {
    let mut tallies = vec![Tally::default(); grid.cells.len()];
    for at in 0..grid.cells.len() {
        for beside in grid.neighbours(at).filter(|beside| *beside > at) {
            let (these, those) = (grid.cells[at].keys.as_ref()?, grid.cells[beside].keys.as_ref()?);
            let matching = Matching::between(these, those, koma * grid.frames_in_koma);
            tallies[at].add(&matching);
            tallies[beside].add(&matching);
        }
    }
    Some(tallies.into_iter().map(Tally::steadiness).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::tests::grid_of_keys;

    #[test]
    fn a_cell_is_compared_with_the_cells_beside_it() {
        let grid = grid_of_keys(3, 1, &[&[10, 50], &[12, 50], &[12, 50, 90]]);
        let found = steadiness(&grid, 1.0).unwrap();
        assert_eq!(found[0], Steadiness { kept: 1.0, mean_move: Some(1.0), largest_move: Some(2) });
        assert_eq!(found[1].kept, 8.0 / 9.0, "all four of the one, four of five of the other");
        assert_eq!((found[1].mean_move, found[1].largest_move), (Some(0.5), Some(2)));
        assert_eq!(found[2], Steadiness { kept: 0.8, mean_move: Some(0.0), largest_move: Some(0) });
    }

    #[test]
    fn neighbours_are_beside_and_above_and_not_across() {
        // The middle of three by three; the corners do not count.
        let (a, b): (&[usize], &[usize]) = (&[20], &[21]);
        let far: &[usize] = &[60];
        let grid = grid_of_keys(3, 3, &[far, b, far, a, a, a, far, b, far]);
        let middle = steadiness(&grid, 1.0).unwrap()[4];
        assert_eq!(middle, Steadiness { kept: 1.0, mean_move: Some(0.5), largest_move: Some(1) });
        let corner = steadiness(&grid, 1.0).unwrap()[0];
        assert_eq!(corner, Steadiness { kept: 0.0, mean_move: None, largest_move: None });
    }

    #[test]
    fn the_tolerance_is_in_koma() {
        // Five frames are a koma here.
        let grid = grid_of_keys(2, 1, &[&[10], &[16]]);
        assert_eq!(steadiness(&grid, 1.0).unwrap()[0].kept, 0.0);
        assert_eq!(steadiness(&grid, 1.2).unwrap()[0].kept, 1.0);
    }

    #[test]
    fn without_keys_nothing_moves_and_without_a_list_nothing_is_known() {
        let mut grid = grid_of_keys(2, 1, &[&[], &[]]);
        let found = steadiness(&grid, 1.0).unwrap()[0];
        assert_eq!(found, Steadiness { kept: 1.0, mean_move: None, largest_move: None });
        grid.cells[1].keys = None;
        assert_eq!(steadiness(&grid, 1.0), None);
    }
}
