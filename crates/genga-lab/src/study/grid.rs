//! The grid of cells of a study.

use crate::study::axis::Axis;
use crate::study::measure::Measure;
use genga::time::Frame;

/// The result of a study of one clip.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The setting that was varied.
    pub x: Axis,
    /// The second setting, if any.
    pub y: Option<Axis>,
    /// The measures.
    pub measures: Vec<Measure>,
    /// Source frames per koma of the recipe.
    pub frames_in_koma: f64,
    /// The cell nearest to the recipe's own settings, if they lie in the grid.
    pub own: Option<usize>,
    /// One cell per pair of values, `y` fastest.
    pub cells: Vec<Cell>,
}

/// One cell of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// One value per measure.
    pub values: Vec<f64>,
    /// Koma of its sheet over the koma rate, by which counts are divided per second; of a loop, those of a round.
    pub seconds: f64,
    /// Frames of the layer's keys, if the study keeps them.
    pub keys: Option<Vec<Frame>>,
}

impl Grid {
    /// Returns the number of rows: the values of `y`, or 1.
    pub fn rows(&self) -> usize {
        self.y.as_ref().map_or(1, Axis::len)
    }

    /// Returns the cell at an index on each axis.
    pub fn cell(&self, x: usize, y: usize) -> &Cell {
        &self.cells[x * self.rows() + y]
    }

    /// Returns the cells to the left and right of a cell, below and above it.
    pub fn neighbours(&self, at: usize) -> impl Iterator<Item = usize> + use<> {
        let (rows, columns) = (self.rows(), self.x.len());
        let (x, y) = (at / rows, at % rows);
        let left = (x > 0).then(|| at - rows);
        let right = (x + 1 < columns).then(|| at + rows);
        let below = (y > 0).then(|| at - 1);
        let above = (y + 1 < rows).then(|| at + 1);
        [left, right, below, above].into_iter().flatten()
    }

    /// Returns the least and the most seconds of a cell.
    pub fn seconds(&self) -> (f64, f64) {
        let seconds = || self.cells.iter().map(|cell| cell.seconds);
        (seconds().fold(f64::INFINITY, f64::min), seconds().fold(0.0, f64::max))
    }

    /// Returns a measure's value in every cell; `None` if it was not measured.
    pub fn values(&self, measure: Measure) -> Option<Vec<f64>> {
        let at = self.measures.iter().position(|own| *own == measure)?;
        Some(self.cells.iter().map(|cell| cell.values[at]).collect())
    }
}

/// Spread of a measure over several clips in a cell: half of them lie between the quartiles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The lower quartile.
    pub low: f64,
    /// The median. All three are NaN if no clip has a value.
    pub median: f64,
    /// The upper quartile.
    pub high: f64,
}

/// Returns the median and the quartiles over several clips of a measure in each cell, divided by the cell's seconds if
/// `per_second`; `None` if it was not measured.
pub fn spreads(grids: &[Grid], measure: Measure, per_second: bool) -> Option<Vec<Spread>> {
    let values = |grid: &Grid| {
        let seconds = |cell: &Cell| if per_second { cell.seconds } else { 1.0 };
        let values = grid.values(measure)?.into_iter().zip(&grid.cells);
        Some(values.map(|(value, cell)| value / seconds(cell)).collect())
    };
    let of_clips: Vec<Vec<f64>> = grids.iter().map(values).collect::<Option<_>>()?;
    let cells = of_clips.iter().map(Vec::len).min()?;
    let mut of_cell = Vec::with_capacity(of_clips.len());
    let spread = |at: usize| {
        of_cell.clear();
        of_cell.extend(of_clips.iter().map(|values| values[at]).filter(|value| value.is_finite()));
        of_cell.sort_by(f64::total_cmp);
        let [low, median, high] = [0.25, 0.5, 0.75].map(|share| quantile(&of_cell, share));
        Spread { low, median, high }
    };
    Some((0..cells).map(spread).collect())
}

/// Returns a quantile of sorted values, interpolated linearly between the two nearest; NaN if there are none.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = share * last as f64;
    let below = place.floor() as usize;
    let (low, high) = (sorted[below], sorted[(below + 1).min(last)]);
    low + (place - below as f64) * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::tests::axis;

    fn grid(value: f64, seconds: f64) -> Grid {
        Grid {
            x: axis("filter.width=10"),
            y: None,
            measures: vec![Measure::Turns],
            frames_in_koma: 5.0,
            own: None,
            cells: vec![Cell { values: vec![value], seconds, keys: None }],
        }
    }

    #[test]
    fn half_of_the_clips_lie_between_the_quartiles() {
        let spread = |values: &[f64], per_second| {
            let grids: Vec<Grid> = values.iter().map(|value| grid(*value, 2.0)).collect();
            let spread = spreads(&grids, Measure::Turns, per_second).unwrap()[0];
            [spread.low, spread.median, spread.high]
        };
        assert_eq!(spread(&[9.0, 1.0, 5.0, 3.0, 7.0], false), [3.0, 5.0, 7.0]);
        assert_eq!(spread(&[1.0, 2.0, 3.0, 4.0], false), [1.75, 2.5, 3.25]);
        assert_eq!(spread(&[1.0, 2.0, 3.0, 4.0], true), [0.875, 1.25, 1.625]);
        assert_eq!(spread(&[4.0, f64::NAN], false), [4.0; 3]);
        assert!(spread(&[f64::NAN], false)[1].is_nan());
        assert!(spreads(&[grid(1.0, 1.0)], Measure::Genga, false).is_none());
    }
}
