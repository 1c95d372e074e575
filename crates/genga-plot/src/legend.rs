//! Draws the legend of a picture, on the right of its title.

use crate::canvas::{Canvas, Type};
use crate::paper_point::Point;
use crate::style;

/// A legend entry: its word, and a function that draws its sign about a point.
pub(super) type Entry = (&'static str, fn(&mut Canvas, Point));

/// Entries of the left and the right limbs.
pub(super) const SIDES: [Entry; 2] = [
    ("left 左", |canvas, (x, y)| canvas.line((x - 8.0, y), (x + 8.0, y), style::LEFT, 4.0)),
    ("right 右", |canvas, (x, y)| canvas.line((x - 8.0, y), (x + 8.0, y), style::RIGHT, 4.0)),
];

/// Entry of the line at which the next action begins.
pub(super) const SPLIT: Entry = ("next action 区切り", |canvas, (x, y)| {
    canvas.dashes((x, y - 9.0), (x, y + 9.0), style::INK, 1.25);
});

/// Draws entries up to a right edge, and returns the x at which they begin.
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
