//! What the signs of a picture mean, on the right of its title.

use crate::plot::canvas::{Canvas, Type};
use crate::plot::px::Point;
use crate::plot::style;

/// A word, and how the sign that it explains is drawn about a point.
pub(super) type Entry = (&'static str, fn(&mut Canvas, Point));

/// Limbs of either side.
pub(super) const SIDES: [Entry; 2] = [
    ("left 左", |canvas, (x, y)| canvas.line((x - 8.0, y), (x + 8.0, y), style::LEFT, 4.0)),
    ("right 右", |canvas, (x, y)| canvas.line((x - 8.0, y), (x + 8.0, y), style::RIGHT, 4.0)),
];

/// Where actions part.
pub(super) const SPLIT: Entry = ("next action 区切り", |canvas, (x, y)| {
    canvas.dashes((x, y - 9.0), (x, y + 9.0), style::INK, 1.25);
});

/// Draws entries up to a right edge, and gives the px with which they begin.
pub(super) fn draw(canvas: &mut Canvas, right: f64, entries: &[Entry]) -> f64 {
    let wide = |word: &str| style::text_width(word, style::WORDS) + 40.0;
    let begin = right + 18.0 - entries.iter().map(|entry| wide(entry.0)).sum::<f64>();
    let mut x = begin;
    for (word, sign) in entries {
        sign(canvas, (x + 9.0, 29.0));
        canvas.text(word, (x + 22.0, 34.0), Type::new(style::WORDS));
        x += wide(word);
    }
    begin
}
