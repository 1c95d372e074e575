//! Table 1: keys by filter width and persistence, in the literal reading.

use genga::pipeline::Engine;
use genga::study::{self, StudyRow};
use genga::time::Span;

use crate::part::Part;
use crate::table::{Table, number};
use crate::{Outcome, samples};

/// What the paper counted, in the order of the sweep: filter width, persistence, keys.
pub(super) const PAPER: [(usize, usize, usize); 6] =
    [(10, 5, 99), (10, 10, 75), (20, 5, 80), (20, 10, 71), (30, 5, 64), (30, 10, 52)];

/// The table, and what the prose says of it.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let mut engine = Engine::new(samples::clip("kuroda-pitch")?)?;
    let widths = [10.0, 20.0, 30.0].map(Span::Frames);
    let persistences = [5.0, 10.0].map(Span::Frames);
    let rows = study::sweep(&mut engine, &study::table_1_recipe(), &widths, &persistences)?;
    part.table("table-1-keys", table(&rows));
    let levels = rows.iter().zip(PAPER).map(|(row, (.., keys))| row.union as f64 / keys as f64);
    let (least, most) = levels
        .fold((f64::INFINITY, 0.0_f64), |(least, most), level| (least.min(level), most.max(level)));
    part.number("kt.level.least", number(least, 1));
    part.number("kt.level.most", number(most, 1));
    Ok(())
}

fn table(rows: &[StudyRow]) -> Table {
    let header =
        [">filter width", ">persistence", ">paper: keys", ">union", ">total", ">layer keys"];
    let mut table = Table::new(&header);
    for (row, (.., paper)) in rows.iter().zip(PAPER) {
        table.row(&[
            row.filter_width.to_string(),
            row.persistence.to_string(),
            paper.to_string(),
            row.union.to_string(),
            row.total.to_string(),
            row.layer_keys.to_string(),
        ]);
    }
    table
}
