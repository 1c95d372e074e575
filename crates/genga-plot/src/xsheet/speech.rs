//! Draws the S column (セリフ) and the CAMERA column: a bracket down the koma of a line, and beside it, from top to
//! bottom, the speaker and the words.

use crate::canvas::{Canvas, Type};
use crate::style;
use crate::xsheet::half_page::{Half, Place};
use crate::xsheet::layout::Page;
use genga::sheet::{CameraWork, SpokenLine};

/// Font sizes to try, in this order, until the line fits.
const SIZES: [f64; 5] = [12.0, 11.0, 10.0, 9.0, 8.0];
/// Length of the hooks at the bracket's ends, in px.
const HOOK: f64 = 4.0;
/// White between the edge of the column and the bracket, in px.
const EDGE: f64 = 3.5;

/// Draws the lines heard in a half, and the camera work. Lines heard at once share the column.
pub(super) fn draw(canvas: &mut Canvas, page: &Page<'_>, half: Half) {
    side_by_side(canvas, &page.sheet.lines, half, page.speech(half));
    let camera: Vec<SpokenLine> = page.sheet.camera.iter().map(CameraWork::line).collect();
    side_by_side(canvas, &camera, half, page.camera(half));
}

fn side_by_side(canvas: &mut Canvas, lines: &[SpokenLine], half: Half, whole: Place) {
    let columns = SpokenLine::side_by_side(lines);
    let count = columns.iter().max().map_or(1, |last| last + 1);
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
    // The text stays clear of both ends, and is never wider than the column.
    let (high, room) = (bottom - top - 4.0, place.width - EDGE - 3.0);
    let fits = |size: &f64| *size <= room && style::text_width(&text, *size) <= high;
    let size = SIZES.into_iter().find(fits).unwrap_or(SIZES[4].min(room));
    let text = style::fitted(&text, size, high);
    let color = if begins { style::INK } else { style::FAINT };
    let middle = left + 0.5 * (place.width - EDGE) + 0.5;
    canvas.text_downwards(&text, (middle, top + 2.0), Type::new(size).color(color));
}
