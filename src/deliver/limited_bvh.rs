//! The motion of a sheet as BVH: stepped, or its poses alone.

use crate::error::Error;
use crate::motion::{Clip, Composite, CompositeRows, bvh};
use crate::sheet::{Exposure, Sheet};
use crate::time::{Frame, FrameRate};

/// The motion of a sheet as a BVH at the sheet's rate, 24 fps: one row a koma, each joint as the drawing of
/// its layer has it. A drawing that is a source frame is written as the numbers it was read from; holds
/// repeat their row, but for a root on ones.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`], and where a layer has a joint that the clip has not.
pub fn limited_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let composite = Composite::of(clip, sheet)?;
    written(&composite, sheet, on_screen(&composite))
}

/// The same motion as a clip, whose frame 0 is koma 0.
///
/// # Errors
/// Those of [`limited_bvh`]; [`Error::Clip`] for a sheet without a koma.
pub fn limited(clip: &Clip, sheet: &Sheet) -> Result<Clip, Error> {
    let composite = Composite::of(clip, sheet)?;
    let skeleton = clip.skeleton();
    let (mut rows, mut row) = (CompositeRows::of(&composite), vec![0.0; skeleton.channels()]);
    let (mut koma, mut values) = (0, Vec::new());
    for Repeated { drawing, at, times } in on_screen(&composite) {
        rows.write(drawing, at, &mut row);
        (0..times).for_each(|_| values.extend_from_slice(&row));
        koma += times;
    }
    let rate = FrameRate::new(sheet.clock.koma_rate)?;
    Clip::new(skeleton.clone(), rate, Frame(0), koma, values)
}

/// What is on screen, koma after koma.
fn on_screen(composite: &Composite<'_>) -> impl Iterator<Item = Repeated> {
    let slides = composite.slides();
    let shown = move |(begin, Exposure { drawing, koma }): (usize, Exposure)| {
        let rows = if slides { (begin..begin + koma).collect() } else { vec![begin] };
        let times = if slides { 1 } else { koma };
        rows.into_iter().map(move |at| Repeated { drawing, at, times })
    };
    composite.layer().timed().flat_map(shown)
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
