//! Provides the paper's own counts [KT11 Table 1], to be drawn beside those of a study.

use genga::error::Error;
use genga_lab::study::{Axis, Grid};

/// Table 1 of the paper: filter width, persistence, number of keys.
const PAPER: [(f64, f64, f64); 6] = [
    (10.0, 5.0, 99.0),
    (10.0, 10.0, 75.0),
    (20.0, 5.0, 80.0),
    (20.0, 10.0, 71.0),
    (30.0, 5.0, 64.0),
    (30.0, 10.0, 52.0),
];

/// A count from the paper.
pub(super) struct Mark {
    /// Filter width and number of keys.
    pub(super) at: (f64, f64),
    /// Index of the line of its persistence, if there is one.
    pub(super) line: Option<usize>,
}

/// Returns the paper's marks, each with the line that it belongs to. Fails unless the axes are the paper's.
pub(super) fn marks(grid: &Grid) -> Result<Vec<Mark>, Error> {
    let persistences = persistences(&grid.x, grid.y.as_ref())?;
    let line = |persistence: f64| persistences.iter().position(|own| *own == persistence);
    let mark = |row: &(f64, f64, f64)| Mark { at: (row.0, row.2), line: line(row.1) };
    Ok(PAPER.iter().map(mark).collect())
}

/// Returns the values of the second axis. Fails unless both axes are the paper's.
pub(super) fn persistences(x: &Axis, y: Option<&Axis>) -> Result<Vec<f64>, Error> {
    let frames = |axis: &Axis, name| {
        let (numbers, unit) = axis.scale()?;
        (axis.name() == name && unit.is_empty()).then_some(numbers)
    };
    let widths = frames(x, "filter.width");
    let persistences = y.and_then(|y| frames(y, "turns.persistence"));
    widths.and(persistences).ok_or_else(|| {
        let message =
            "the paper's counts stand beside filter.width and turns.persistence in frames alone";
        Error::setting("paper", message)
    })
}
