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

/// `koma,source_frame,source_time_s`: the timing alone, for any rig that plays the same source. Koma
/// from 1. Of several layers it has a row a koma and layer, and their name in a second column `layer`.
///
/// A root on ones has no layer: it is where the source is on each koma.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn remap_csv(sheet: &Sheet) -> Result<String, Error> {
    sheet.check()?;
    let has_layers = sheet.layers.len() > 1;
    let rows = sheet.layers.iter().flat_map(|layer| {
        layer.koma().enumerate().map(move |(koma, index)| {
            let place = layer.drawings[index].source.place();
            let seconds = number(sheet.clock.seconds_from_place(place));
            let name = has_layers.then(|| layer.name.clone());
            let row = [Some((koma + 1).to_string()), name, Some(number(place)), Some(seconds)];
            row.into_iter().flatten()
        })
    });
    let mut header = vec!["koma", "source_frame", "source_time_s"];
    if has_layers {
        header.insert(1, "layer");
    }
    csv_table(&header, rows)
}
