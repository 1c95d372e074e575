//! The pictures of a sheet: as bars, and its kept drawings as poses.

use crate::deliver::Cut;
use crate::deliver::sheet_json::MadeWith;
use crate::error::Error;
use crate::motion::{Screen, SeenFrom};
use crate::plot::{FigureBody, PoseRow, SheetPlot};
use crate::sheet::Sheet;
use crate::timing::Stills;

/// The sheet as bars (SVG), with how far the body moves into each koma and, where the sheet before
/// omission is known, what was left out.
///
/// # Errors
/// [`Error::Picture`] when it cannot be drawn.
pub fn bars(cut: &Cut<'_>) -> Result<String, Error> {
    let ones = Sheet::on_ones(cut.sheet.clock, cut.sheet.length());
    let seen_from = cut.made_with.map_or(SeenFrom::World, MadeWith::seen_from);
    let stills = Stills::on(cut.clip, &ones.layers[0], &Screen::of(seen_from, cut.clip));
    let step = |koma: usize| if koma == 0 { 0.0 } else { stills.ssd(koma - 1, koma) };
    let steps: Vec<f64> = (0..stills.len()).map(step).collect();
    let (clip, splits) = (cut.name.to_owned(), cut.splits.to_vec());
    let plot = SheetPlot { clip, splits, seen_from, ..SheetPlot::default() };
    plot.draw(cut.sheet, cut.spaced, Some(&steps))
}

/// The kept drawings as poses in a row (SVG), all layers on one another.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`]; [`Error::Picture`] when it cannot be drawn.
pub fn poses(cut: &Cut<'_>, body: FigureBody) -> Result<String, Error> {
    PoseRow { clip: cut.name.to_owned(), body, ..PoseRow::default() }.draw_kept(cut.clip, cut.sheet)
}
