//! The cells of a study, side by side.

use crate::study::axis::Axis;
use crate::study::measure::{Measure, median};
use crate::time::Frame;

/// The result of a study of one clip.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The setting that was varied.
    pub x: Axis,
    /// The other one.
    pub y: Option<Axis>,
    /// What was counted.
    pub measures: Vec<Measure>,
    /// Source frames in a koma of the recipe.
    pub frames_in_koma: f64,
    /// The cell that is nearest to the recipe's own settings, where they lie in the grid.
    pub own: Option<usize>,
    /// A cell each pair of values, `y` fastest.
    pub cells: Vec<Cell>,
}

/// One cell of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// A value each measure.
    pub values: Vec<f64>,
    /// Frames of the layer's keys, where the study keeps them.
    pub keys: Option<Vec<Frame>>,
}

impl Grid {
    /// Rows of cells that stand on each other: the values of `y`, or 1.
    pub fn rows(&self) -> usize {
        self.y.as_ref().map_or(1, Axis::len)
    }

    /// The cell of a value of each axis.
    pub fn cell(&self, x: usize, y: usize) -> &Cell {
        &self.cells[x * self.rows() + y]
    }

    /// The cells to the left and right of a cell, below and above it.
    pub fn neighbours(&self, at: usize) -> impl Iterator<Item = usize> + use<> {
        let (rows, columns) = (self.rows(), self.x.len());
        let (x, y) = (at / rows, at % rows);
        let left = (x > 0).then(|| at - rows);
        let right = (x + 1 < columns).then(|| at + rows);
        let below = (y > 0).then(|| at - 1);
        let above = (y + 1 < rows).then(|| at + 1);
        [left, right, below, above].into_iter().flatten()
    }

    /// A measure's value in every cell; none when it was not counted.
    pub fn values(&self, measure: Measure) -> Option<Vec<f64>> {
        let at = self.measures.iter().position(|own| *own == measure)?;
        Some(self.cells.iter().map(|cell| cell.values[at]).collect())
    }
}

/// The median over several clips of a measure in each cell; none when it was not counted.
pub fn medians(grids: &[Grid], measure: Measure) -> Option<Vec<f64>> {
    let of_clips: Vec<Vec<f64>> =
        grids.iter().map(|grid| grid.values(measure)).collect::<Option<_>>()?;
    let cells = of_clips.iter().map(Vec::len).min()?;
    let of_cell = |at: usize| {
        let mut values: Vec<f64> = of_clips.iter().map(|values| values[at]).collect();
        values.sort_by(f64::total_cmp);
        median(&values)
    };
    (0..cells).map(of_cell).collect()
}
