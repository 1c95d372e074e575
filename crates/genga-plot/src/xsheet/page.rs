//! Draws the parts of a page, in order.

use crate::canvas::Canvas;
use crate::xsheet::layout::{Page, SIZE};
use crate::xsheet::{column, gauge_strip, grid, head, speech};

/// Draws a page as SVG.
pub(super) fn draw(page: &Page<'_>) -> String {
    let mut canvas = Canvas::new(SIZE);
    head::draw(&mut canvas, page);
    for half in page.halves() {
        grid::draw(&mut canvas, page, half);
        grid::end(&mut canvas, page, half);
        speech::draw(&mut canvas, page, half);
        for (at, leaf) in page.leaves.iter().enumerate() {
            gauge_strip::draw(&mut canvas, page, leaf, half, at);
            column::action(&mut canvas, page, leaf, half, page.action(half, at));
            column::cell(&mut canvas, page, leaf, half, page.cell(half, at));
        }
    }
    head::legend(&mut canvas, page);
    canvas.finish()
}
