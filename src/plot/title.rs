//! What a picture shows, and below it of which clips.

use crate::plot::canvas::{Canvas, Type};
use crate::plot::style;

/// Px from the top down to the end of both lines.
pub(super) const HIGH: f64 = 60.0;

/// Draws both lines; the second is as long as there is room from the left edge to `right`.
pub(super) fn draw(canvas: &mut Canvas, title: &str, clips: &str, right: f64) {
    canvas.text(title, (style::MARGIN, 34.0), Type::new(style::TITLE).bold());
    let clips = style::fitted(clips, style::WORDS, right - style::MARGIN);
    canvas.text(&clips, (style::MARGIN, 55.0), Type::new(style::WORDS).color(style::FAINT));
}
