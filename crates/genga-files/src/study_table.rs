//! The results of a study, as a table.

use crate::{csv_table, number};
use genga::error::Error;
use genga_lab::study::{Grid, Steadiness, steadiness};

/// Writes a row per cell, clip after clip, with the second setting varying fastest. The columns are `clip`, the
/// varied settings by name, and one per measure. All grids must be of the same study.
///
/// With a tolerance in koma, the columns `kept`, `mean_move` and `largest_move` compare the layer's keys with
/// those of the neighbouring cells. A move is empty if no key has a counterpart there. All three are empty if
/// the study did not keep its keys.
///
/// # Errors
/// Fails only if memory runs out.
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
