//! The motion of a sheet as BVH: stepped, or its poses alone.

use crate::error::Error;
use crate::motion::{Clip, Composite, CompositeRows, bvh};
use crate::sheet::{Exposure, Sheet};
use crate::time::FrameRate;

/// The motion of a sheet as a BVH at the sheet's rate, 24 fps: one row a koma, each joint as the drawing of
/// its layer has it. A drawing that is a source frame is written as the numbers it was read from; holds
/// repeat their row, but for a root on ones.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`], and where a layer has a joint that the clip has not.
pub fn limited_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let composite = Composite::of(clip, sheet)?;
    let on_screen = |(begin, Exposure { drawing, koma }): (usize, Exposure)| {
        let slides = composite.slides();
        let rows = if slides { (begin..begin + koma).collect() } else { vec![begin] };
        let times = if slides { 1 } else { koma };
        rows.into_iter().map(move |at| Repeated { drawing, at, times })
    };
    written(&composite, sheet, composite.layer().timed().flat_map(on_screen))
}

/// The genga and ends of a sheet as a BVH for a pose library (ポーズ集): one row a drawing, in their order;
/// of several layers one wherever one of them has a new one. Its rate is that of the sheet and means
/// nothing.
///
/// # Errors
/// Those of [`limited_bvh`]; [`Error::Clip`] when the sheet has no genga and no end.
pub fn keys_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let composite = Composite::of(clip, sheet)?;
    let layer = composite.layer();
    let drawings = layer.drawings.iter().zip(composite.first_koma()).enumerate();
    let kept = drawings.filter(|(_, (drawing, _))| drawing.role.is_kept());
    let rows: Vec<Repeated> =
        kept.map(|(drawing, (_, at))| Repeated { drawing, at, times: 1 }).collect();
    if rows.is_empty() {
        return Err(Error::clip("the sheet has neither genga nor ends: there is no pose to write"));
    }
    written(&composite, sheet, rows)
}

/// A pose, on which koma it is shown, and how many times it is written.
struct Repeated {
    drawing: usize,
    at: usize,
    times: usize,
}

/// Rows at the sheet's rate.
fn written(
    composite: &Composite<'_>,
    sheet: &Sheet,
    poses: impl IntoIterator<Item = Repeated>,
) -> Result<String, Error> {
    let skeleton = composite.clip().skeleton();
    let mut file = bvh::Writer::new(skeleton, FrameRate::new(sheet.clock.koma_rate)?);
    let mut row = vec![0.0; skeleton.channels()];
    let mut rows = CompositeRows::of(composite);
    for Repeated { drawing, at, times } in poses {
        rows.write(drawing, at, &mut row);
        (0..times).for_each(|_| file.row(&row));
    }
    Ok(file.finish())
}
