//! Table 1: keys by filter width and persistence, in the literal reading.

use genga::pipeline::Budget;
use genga_lab::study::{self, Axis, Grid, Measure, Study};

use crate::part::Part;
use crate::table::{Table, number};
use crate::{Outcome, samples};

/// The paper's counts in the order of the study: filter width, persistence, keys.
pub(super) const PAPER: [(usize, usize, usize); 6] =
    [(10, 5, 99), (10, 10, 75), (20, 5, 80), (20, 10, 71), (30, 5, 64), (30, 10, 52)];

/// Makes the table and the numbers of the prose.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let grid = study()?.run(samples::clip("kuroda-pitch")?, || ())?;
    part.table("table-1-keys", table(&grid));
    let levels =
        grid.cells.iter().zip(PAPER).map(|(cell, (.., keys))| cell.values[0] / keys as f64);
    let (least, most) = levels
        .fold((f64::INFINITY, 0.0_f64), |(least, most), level| (least.min(level), most.max(level)));
    part.number("kt.level.least", number(least, 1));
    part.number("kt.level.most", number(most, 1));
    Ok(())
}

/// The study of the paper's six cells.
pub(super) fn study() -> Outcome<Study> {
    Ok(Study {
        recipe: study::table_1_recipe(),
        x: Axis::new("filter.width", "10,20,30")?,
        y: Some(Axis::new("turns.persistence", "5,10")?),
        measures: vec![Measure::Union, Measure::Total],
        keep_keys: false,
        budget: Budget::default(),
    })
}

fn table(grid: &Grid) -> Table {
    let header = [">filter width", ">persistence", ">paper: keys", ">union", ">total"];
    let mut table = Table::new(&header);
    for (cell, (width, persistence, keys)) in grid.cells.iter().zip(PAPER) {
        let mut row = [width, persistence, keys].map(|number| number.to_string()).to_vec();
        row.extend(cell.values.iter().map(f64::to_string));
        table.row(&row);
    }
    table
}
