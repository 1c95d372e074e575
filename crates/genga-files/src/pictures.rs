//! Pictures of a sheet: as bars, and its kept drawings as poses.

use crate::sheet_json::MadeWith;
use crate::{Cut, FigureSettings};
use genga::error::Error;
use genga::motion::{Screen, SeenFrom, played_out};
use genga::sheet::Sheet;
use genga::timing::Stills;
use genga_plot::{PoseRow, SheetPlot};

/// Draws the sheet as bars (SVG), with how far the body moves into each koma. If the sheet before omission is
/// known, the omitted drawings are shown too.
///
/// # Errors
/// [`Error::Picture`] if it cannot be drawn.
pub fn bars(cut: &Cut<'_>) -> Result<String, Error> {
    let (motion, sheet) = played_out(cut.clip, cut.sheet);
    let ones = Sheet::on_ones(sheet.clock, sheet.length());
    let seen_from = cut.made_with.map_or(SeenFrom::World, MadeWith::seen_from);
    let stills = Stills::on(&motion, &ones.layers[0], &Screen::new(seen_from, cut.clip));
    let step = |koma: usize| if koma == 0 { 0.0 } else { stills.ssd(koma - 1, koma) };
    let steps: Vec<f64> = (0..stills.len()).map(step).collect();
    let (clip, splits) = (cut.name.to_owned(), cut.splits.to_vec());
    let plot = SheetPlot { clip, splits, seen_from, ..SheetPlot::default() };
    plot.draw(cut.sheet, cut.spaced, Some(&steps))
}

/// Draws the kept drawings as poses in a row (SVG), with all layers combined.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`]; [`Error::Picture`] if it cannot be drawn.
pub fn poses(cut: &Cut<'_>, settings: &FigureSettings) -> Result<String, Error> {
    let FigureSettings { body, camera, .. } = *settings;
    let row = PoseRow { clip: cut.name.to_owned(), body, camera, ..PoseRow::default() };
    row.draw_kept(cut.clip, cut.sheet)
}
