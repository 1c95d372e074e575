//! The motion of a sheet as BVH: stepped, or its poses alone.

use crate::error::Error;
use crate::motion::{Clip, RowWriter, bvh};
use crate::sheet::{Sheet, Source};
use crate::time::FrameRate;

/// The motion of a sheet's first layer as a BVH at the sheet's rate, 24 fps: one row a koma. A drawing
/// that is a source frame is written as the numbers it was read from; holds repeat their row.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`].
pub fn limited_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let layer = sheet.first_layer()?;
    let shown = layer.exposures.iter();
    let rows = shown.map(|shown| (layer.drawings[shown.drawing].source, shown.koma));
    written(clip, sheet, rows)
}

/// The genga and ends of a sheet's first layer as a BVH for a pose library (ポーズ集): one row a drawing, in
/// their order. Its rate is that of the sheet and means nothing.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`]; [`Error::Clip`] when it has no genga and no end.
pub fn keys_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let layer = sheet.first_layer()?;
    let kept = layer.drawings.iter().filter(|drawing| drawing.role.is_kept());
    let rows: Vec<_> = kept.map(|drawing| (drawing.source, 1)).collect();
    if rows.is_empty() {
        return Err(Error::clip("the sheet has neither genga nor ends: there is no pose to write"));
    }
    written(clip, sheet, rows)
}

/// Rows at the sheet's rate, each pose as many times as is asked for.
fn written(
    clip: &Clip,
    sheet: &Sheet,
    poses: impl IntoIterator<Item = (Source, usize)>,
) -> Result<String, Error> {
    let rate = FrameRate::new(sheet.clock.koma_rate)?;
    let mut file = bvh::Writer::new(clip.skeleton(), rate);
    let mut row = vec![0.0; clip.skeleton().channels()];
    let mut writer = RowWriter::new(clip);
    for (source, times) in poses {
        writer.write(source, &mut row);
        (0..times).for_each(|_| file.row(&row));
    }
    Ok(file.finish())
}
