//! What a study counted, as a table.

use crate::deliver::{csv_table, number};
use crate::error::Error;
use crate::study::{Grid, Steadiness, steadiness};

/// `clip`, the settings that were varied by their names, and a column a measure; a row a cell, clip
/// after clip and the second setting fastest. All grids are of one study.
///
/// With a tolerance in koma also `kept`, `mean_move` and `largest_move`: how the layer's keys compare
/// with those of the cells beside; a move is empty where no key has its own there, and all three are
/// where the study did not keep its keys.
///
/// # Errors
/// Only when memory runs out.
pub fn study_csv(
    clips: &[String],
    grids: &[Grid],
    tolerance: Option<f64>,
) -> Result<String, Error> {
    let mut header = vec!["clip"];
    if let Some(grid) = grids.first() {
        header.push(grid.x.name());
        header.extend(grid.y.as_ref().map(|y| y.name()));
        header.extend(grid.measures.iter().map(|measure| measure.name()));
    }
    if tolerance.is_some() {
        header.extend(["kept", "mean_move", "largest_move"]);
    }
    let rows = clips.iter().zip(grids).flat_map(|(clip, grid)| {
        let steady = tolerance.map(|koma| steadiness(grid, koma));
        (0..grid.cells.len()).map(move |at| {
            let (x, y) = (at / grid.rows(), at % grid.rows());
            let mut row = vec![clip.clone(), grid.x.values()[x].clone()];
            row.extend(grid.y.as_ref().map(|axis| axis.values()[y].clone()));
            row.extend(grid.cells[at].values.iter().map(|value| number(*value)));
            if let Some(steady) = &steady {
                row.extend(columns(steady.as_ref().map(|steady| steady[at])));
            }
            row
        })
    });
    csv_table(&header, rows)
}

fn columns(steadiness: Option<Steadiness>) -> [String; 3] {
    let Some(Steadiness { kept, mean_move, largest_move }) = steadiness else {
        return Default::default();
    };
    let longest = largest_move.map_or(String::new(), |frames| frames.to_string());
    [number(kept), mean_move.map_or(String::new(), number), longest]
}
