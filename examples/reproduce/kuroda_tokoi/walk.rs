//! Figure 5: genga and inbetweens of a stride of a walk.

use genga::sheet::Role;
use genga_plot::PoseRow;

use crate::Outcome;
use crate::part::Part;
use crate::takes::{Take, named};

/// Name of the clip, and the source frames from the right foot's landing to its next.
const CLIP: &str = "cmu-07_01-walk";
const STRIDE: [f64; 2] = [130.0, 260.0];

/// Makes the picture, with drawings numbered as in the paper.
pub(super) fn add(part: &mut Part, takes: &[Take]) -> Outcome<()> {
    let take = named(takes, CLIP)?;
    let layer = &take.default().spaced.layers[0];
    let is_of_stride = |place: f64| (STRIDE[0]..=STRIDE[1]).contains(&place);
    let shown: Vec<_> =
        layer.drawings.iter().filter(|drawing| is_of_stride(drawing.source.place())).collect();
    let poses: Vec<_> = shown
        .iter()
        .enumerate()
        .map(|(at, drawing)| {
            let word = if drawing.role == Role::Inbetween { "中割り" } else { "原画" };
            (drawing.source.place(), format!("{} {word}", at + 1), drawing.role)
        })
        .collect();
    part.picture("walk", PoseRow { in_line: 20, ..PoseRow::default() }.draw(&take.clip, &poses)?);
    Ok(())
}
