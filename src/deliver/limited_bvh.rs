//! The limited motion as BVH: one row a koma, holds repeated.

use crate::error::Error;
use crate::motion::{Clip, RowWriter, bvh};
use crate::sheet::Sheet;
use crate::time::FrameRate;

/// The motion of a sheet's first layer as a BVH at the sheet's rate, 24 fps: one row a koma. A drawing
/// that is a source frame is written as the numbers it was read from; holds repeat their row.
///
/// # Errors
/// [`Error::Clip`] when the sheet has no koma.
pub fn limited_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let layer = sheet.layers.first().filter(|layer| !layer.exposures.is_empty());
    let layer =
        layer.ok_or_else(|| Error::clip("the sheet is empty: there is no koma to write"))?;
    let rate = FrameRate::new(sheet.clock.koma_rate)?;
    let mut file = bvh::Writer::new(clip.skeleton(), rate);
    let mut row = vec![0.0; clip.skeleton().channels()];
    let mut writer = RowWriter::new(clip);
    for exposure in &layer.exposures {
        writer.write(layer.drawings[exposure.drawing].source, &mut row);
        (0..exposure.koma).for_each(|_| file.row(&row));
    }
    Ok(file.finish())
}
