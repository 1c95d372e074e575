//! The motion of a sheet as BVH: stepped, or the key poses alone.

use genga::error::Error;
use genga::motion::{Clip, Composite, CompositeRows, bvh, played_out};
use genga::sheet::{Blank, Exposure, Sheet};
use genga::time::{Frame, FrameRate};

/// Writes the motion of a sheet as a BVH at the sheet's rate, 24 fps. Each row is a koma, with every joint
/// posed as in its layer's drawing. A drawing at a source frame keeps the numbers it was read from. Holds repeat
/// their row, except for a root on ones. In a loop the body travels on from round to round. The first pose stands over
/// blank koma before it, the last over those after.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`], and if a layer names a joint that the clip does not have.
pub fn limited_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let (clip, sheet) = played_out(clip, sheet);
    let composite = Composite::new(&clip, &sheet)?;
    written(&composite, &sheet, on_screen(&composite, sheet.blank))
}

/// Returns the motion of [`limited_bvh`] as a clip whose frame 0 is koma 0.
///
/// # Errors
/// The errors of [`limited_bvh`]; [`Error::Clip`] for a sheet without koma.
pub fn limited(clip: &Clip, sheet: &Sheet) -> Result<Clip, Error> {
    let (clip, sheet) = played_out(clip, sheet);
    let composite = Composite::new(&clip, &sheet)?;
    let skeleton = clip.skeleton();
    let (mut rows, mut row) = (CompositeRows::new(&composite), vec![0.0; skeleton.channels()]);
    let (mut koma, mut values) = (0, Vec::new());
    for Repeated { drawing, at, times } in on_screen(&composite, sheet.blank) {
        rows.write(drawing, at, &mut row);
        (0..times).for_each(|_| values.extend_from_slice(&row));
        koma += times;
    }
    let rate = FrameRate::new(sheet.clock.koma_rate)?;
    Clip::new(skeleton.clone(), rate, Frame(0), koma, values)
}

/// Lists the poses on screen in order: one per exposure, or one per koma if the root moves during holds. The first and
/// the last also fill the blank koma beside them.
fn on_screen(composite: &Composite<'_>, blank: Blank) -> Vec<Repeated> {
    let slides = composite.slides();
    let shown = move |(begin, Exposure { drawing, koma }): (usize, Exposure)| {
        let rows = if slides { (begin..begin + koma).collect() } else { vec![begin] };
        let times = if slides { 1 } else { koma };
        rows.into_iter().map(move |at| Repeated { drawing, at, times })
    };
    let mut poses: Vec<Repeated> = composite.layer().timed().flat_map(shown).collect();
    poses.first_mut().into_iter().for_each(|first| first.times += blank.before);
    poses.last_mut().into_iter().for_each(|last| last.times += blank.after);
    poses
}

/// Writes the genga and ends of a sheet as a BVH for a pose library (ポーズ集), one row per drawing in order. With
/// several layers, a row is written whenever one of them shows a new drawing. The frame rate is that of the sheet and
/// has no meaning here.
///
/// # Errors
/// The errors of [`limited_bvh`]; [`Error::Clip`] if the sheet has neither genga nor ends.
pub fn keys_bvh(clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
    let composite = Composite::new(clip, sheet)?;
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

/// A drawing's pose, the koma at which it is sampled, and the number of rows it fills.
struct Repeated {
    drawing: usize,
    at: usize,
    times: usize,
}

/// Writes the poses as rows at the sheet's rate.
fn written(
    composite: &Composite<'_>,
    sheet: &Sheet,
    poses: impl IntoIterator<Item = Repeated>,
) -> Result<String, Error> {
    let skeleton = composite.clip().skeleton();
    let mut file = bvh::Writer::new(skeleton, FrameRate::new(sheet.clock.koma_rate)?);
    let mut row = vec![0.0; skeleton.channels()];
    let mut rows = CompositeRows::new(composite);
    for Repeated { drawing, at, times } in poses {
        rows.write(drawing, at, &mut row);
        (0..times).for_each(|_| file.row(&row));
    }
    Ok(file.finish())
}
