//! What is drawn on a page, in which order.

use crate::error::Error;
use crate::plot::canvas::paint;
use crate::plot::xsheet::layout::{Page, SIZE};
use crate::plot::xsheet::{column, gauge_strip, grid, head};

/// A page as SVG.
pub(super) fn draw(page: &Page<'_>) -> Result<String, Error> {
    paint(SIZE, |canvas| {
        head::draw(canvas, page)?;
        for half in page.halves() {
            grid::draw(canvas, page, half)?;
            grid::end(canvas, page, half)?;
            for (at, leaf) in page.leaves.iter().enumerate() {
                gauge_strip::draw(canvas, page, leaf, half, at)?;
                column::action(canvas, page, leaf, half, page.action(half, at))?;
                column::cell(canvas, page, leaf, half, page.cell(half, at))?;
            }
        }
        head::legend(canvas, page)
    })
}
