//! The limited motion as BVH: one row a koma, holds repeated.

use crate::error::Error;
use crate::motion::{Clip, RowWriter, bvh};
use crate::sheet::Sheet;
use crate::time::{Frame, FrameRate};

/// The motion of a sheet's first layer as a BVH at the sheet's rate, 24 fps: one row a koma. A drawing
/// that is a source frame is written as the numbers it was read from; holds repeat their row.
///
/// # Errors
/// [`Error::Clip`] when the sheet has no koma.
pub fn limited_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let layer = sheet.layers.first().filter(|layer| !layer.exposures.is_empty());
    let layer =
        layer.ok_or_else(|| Error::clip("the sheet is empty: there is no koma to write"))?;
    let channels = clip.skeleton().channels();
    let koma = layer.length();
    let mut values = vec![0.0; koma * channels];
    let mut writer = RowWriter::new(clip);
    for (begin, exposure) in layer.timed() {
        let (_, rows) = values.split_at_mut(begin * channels);
        writer.write(layer.drawings[exposure.drawing].source, &mut rows[..channels]);
        for hold in 1..exposure.koma {
            rows.copy_within(..channels, hold * channels);
        }
    }
    let rate = FrameRate::new(sheet.clock.koma_rate)?;
    Ok(bvh::write(&Clip::new(clip.skeleton().clone(), rate, Frame(0), koma, values)?))
}
