//! Draws a picture's title and, below it, the names of its clips.

use crate::canvas::{Canvas, Type};
use crate::style;

/// Height of both lines from the top edge, in px.
pub(super) const HIGH: f64 = 60.0;

/// Draws the title and the names of the clips, which are cut off at `right`.
pub(super) fn draw(canvas: &mut Canvas, title: &str, clips: &str, right: f64) {
    canvas.text(title, (style::MARGIN, 34.0), Type::new(style::TITLE).bold());
    let clips = style::fitted(clips, style::WORDS, right - style::MARGIN);
    canvas.text(&clips, (style::MARGIN, 55.0), Type::new(style::WORDS).color(style::FAINT));
}
