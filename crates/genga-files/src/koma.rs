//! The sheet as a table by koma: the drawing on each koma and its place in the source.

use crate::{csv_table, number};
use genga::error::Error;
use genga::sheet::Sheet;

/// Writes `koma,layer,drawing,role,source_frame,why`, one row per koma and layer; a koma without a row
/// is blank. Drawings have their numbers on paper; koma count from 1,
/// `source_frame` from 0 as in the file. It is fractional if the pose was sampled between frames.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn sheet_csv(sheet: &Sheet) -> Result<String, Error> {
    sheet.check()?;
    let rows = sheet.layers.iter().flat_map(|layer| {
        let numbers = layer.numbers();
        layer.koma().enumerate().map(move |(koma, index)| {
            let drawing = &layer.drawings[index];
            [
                (sheet.blank.before + koma + 1).to_string(),
                layer.name.clone(),
                numbers[index].to_string(),
                drawing.role.word().into(),
                number(drawing.source.place()),
                drawing.why.to_string(),
            ]
        })
    });
    csv_table(&["koma", "layer", "drawing", "role", "source_frame", "why"], rows)
}
