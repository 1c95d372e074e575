//! The S column (セリフ): a bracket down the koma of a line, and who says what beside it, from top to bottom.

use crate::plot::canvas::{Canvas, Type};
use crate::plot::style;
use crate::plot::xsheet::half::{Half, Place};
use crate::plot::xsheet::layout::Page;
use crate::sheet::SpokenLine;

/// Sizes of letters, of which the first is taken that lets the line fit.
const SIZES: [f64; 5] = [12.0, 11.0, 10.0, 9.0, 8.0];
/// How far the bracket goes in at both ends.
const HOOK: f64 = 4.0;
/// White between the edge of the column and the bracket.
const EDGE: f64 = 3.5;

/// Draws what is heard in a half. Lines that are heard at once share the column.
pub(super) fn draw(canvas: &mut Canvas, page: &Page<'_>, half: Half) {
    let lines = &page.sheet.lines;
    let columns = SpokenLine::side_by_side(lines);
    let count = columns.iter().max().map_or(1, |last| last + 1);
    let whole = page.speech(half);
    let width = whole.width / count as f64;
    for (line, column) in lines.iter().zip(columns) {
        if line.begin < half.end() && line.past() > half.begin {
            let place = Place { left: whole.left + width * column as f64, width };
            draw_line(canvas, line, half, place);
        }
    }
}

fn draw_line(canvas: &mut Canvas, line: &SpokenLine, half: Half, place: Place) {
    let (begins, ends) = (line.begin >= half.begin, line.past() <= half.end());
    let (from, to) = (half.y(line.begin.max(half.begin)), half.y(line.past().min(half.end())));
    let (top, bottom) = (from + 1.5, to - 1.5);
    let left = place.left + EDGE;
    canvas.line((left, top), (left, bottom), style::INK, 1.2);
    for (y, _) in [(top, begins), (bottom, ends)].into_iter().filter(|(_, is_there)| *is_there) {
        canvas.line((left, y), (left + HOOK, y), style::INK, 1.2);
    }
    let text = match begins {
        true => line.to_string(),
        false => format!("({line})"),
    };
    // A hand's breadth in from both ends, and never wider than the column.
    let (high, room) = (bottom - top - 4.0, place.width - EDGE - 3.0);
    let fits = |size: &f64| *size <= room && style::text_width(&text, *size) <= high;
    let size = SIZES.into_iter().find(fits).unwrap_or(SIZES[4].min(room));
    let text = style::fitted(&text, size, high);
    let color = if begins { style::INK } else { style::FAINT };
    let middle = left + 0.5 * (place.width - EDGE) + 0.5;
    canvas.text_downwards(&text, (middle, top + 2.0), Type::new(size).color(color));
}
