//! Draws the legend of a picture.

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

/// Entry of drawings that naka-nashi left out.
pub(super) const LEFT_OUT: Entry =
    ("left out 抜いた中割", |canvas, at| canvas.cross(at, 4.0, style::GENGA, 1.75));

/// Entry of the sign of a curve that goes on beyond its lane.
pub(super) const CUT: Entry = ("goes on 省略", Canvas::cut);

/// Height of a line of entries, in px.
pub(super) const LINE: f64 = 22.0;
/// Width of a sign with the space round it, in px.
const SIGN: f64 = 22.0;
const BETWEEN: f64 = 18.0;

/// Returns the width of some entries in one line, in px.
pub(super) fn width(entries: &[Entry]) -> f64 {
    let wide = |word: &str| SIGN + style::text_width(word, style::WORDS) + BETWEEN;
    entries.iter().map(|entry| wide(entry.0)).sum::<f64>() - BETWEEN
}

/// Splits entries into as few lines of a width as they need.
pub(super) fn lines(entries: &[Entry], room: f64) -> Vec<&[Entry]> {
    let mut lines = Vec::new();
    let mut begin = 0;
    for end in 1..=entries.len() {
        if end - begin > 1 && width(&entries[begin..end]) > room {
            lines.push(&entries[begin..end - 1]);
            begin = end - 1;
        }
    }
    lines.extend((begin < entries.len()).then(|| &entries[begin..]));
    lines
}

/// Draws entries in a line from a left edge, their words on the base line.
pub(super) fn draw(canvas: &mut Canvas, (left, base): Point, entries: &[Entry]) {
    let mut x = left;
    for entry in entries {
        let (word, sign) = *entry;
        sign(canvas, (x + 9.0, base - 5.0));
        canvas.text(word, (x + SIGN, base), Type::new(style::WORDS));
        x += width(&[*entry]) + BETWEEN;
    }
}
