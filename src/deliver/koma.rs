//! The sheet koma after koma: which drawing stands there, and which instant of the source that is.

use crate::deliver::{csv_table, number};
use crate::error::Error;
use crate::sheet::Sheet;

/// `koma,layer,drawing,role,source_frame,why`, one row a koma and layer. Koma and drawings from 1,
/// `source_frame` from 0 as in the file and fractional where the pose was sampled between frames.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn sheet_csv(sheet: &Sheet) -> Result<String, Error> {
    sheet.check()?;
    let rows = sheet.layers.iter().flat_map(|layer| {
        layer.koma().enumerate().map(|(koma, index)| {
            let drawing = &layer.drawings[index];
            [
                (koma + 1).to_string(),
                layer.name.clone(),
                (index + 1).to_string(),
                drawing.role.word().into(),
                number(drawing.source.place()),
                drawing.why.to_string(),
            ]
        })
    });
    csv_table(&["koma", "layer", "drawing", "role", "source_frame", "why"], rows)
}
