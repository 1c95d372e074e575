//! Draws the S column (セリフ) and the CAMERA column: a bracket down the koma of a line, and beside it the speaker and the
//! words, from top to bottom, or camera work upright.

use plotters::style::RGBColor;

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

/// Height of a line of upright words, in font sizes.
const LINE: f64 = 1.25;

/// Where the words of a line stand beside its bracket.
struct Room {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

/// How the lines of a column are written.
#[derive(Clone, Copy)]
struct Column {
    /// The text of a line.
    said: fn(&SpokenLine) -> String,
    /// Writes a text into a room.
    write: fn(&mut Canvas, &str, &Room, RGBColor),
}

const SPEECH: Column = Column { said: SpokenLine::to_string, write: downwards };
const CAMERA: Column = Column { said: |line| line.words.clone(), write: upright };

/// Draws the lines heard in a half, and the camera work. Lines heard at once share the column.
pub(super) fn draw(canvas: &mut Canvas, page: &Page<'_>, half: Half) {
    side_by_side(canvas, &page.sheet.lines, (half, page.speech(half)), SPEECH);
    let camera: Vec<SpokenLine> = page.sheet.camera.iter().map(CameraWork::line).collect();
    side_by_side(canvas, &camera, (half, page.camera(half)), CAMERA);
}

fn side_by_side(
    canvas: &mut Canvas,
    lines: &[SpokenLine],
    (half, whole): (Half, Place),
    column: Column,
) {
    let columns = SpokenLine::side_by_side(lines);
    let count = columns.iter().max().map_or(1, |last| last + 1);
    let width = whole.width / count as f64;
    for (line, at) in lines.iter().zip(columns) {
        if line.begin < half.end() && line.past() > half.begin {
            let place = Place { left: whole.left + width * at as f64, width };
            draw_line(canvas, line, (half, place), column);
        }
    }
}

fn draw_line(canvas: &mut Canvas, line: &SpokenLine, (half, place): (Half, Place), column: Column) {
    let (begins, ends) = (line.begin >= half.begin, line.past() <= half.end());
    let (from, to) = (half.y(line.begin.max(half.begin)), half.y(line.past().min(half.end())));
    let (top, bottom) = (from + 1.5, to - 1.5);
    let left = place.left + EDGE;
    canvas.line((left, top), (left, bottom), style::INK, 1.2);
    for (y, _) in [(top, begins), (bottom, ends)].into_iter().filter(|(_, is_there)| *is_there) {
        canvas.line((left, y), (left + HOOK, y), style::INK, 1.2);
    }
    let said = (column.said)(line);
    let text = if begins { said } else { format!("({said})") };
    let color = if begins { style::INK } else { style::FAINT };
    // The text stays clear of both ends, and is never wider than the column.
    let (height, width) = (bottom - top - 4.0, place.width - EDGE - 3.0);
    (column.write)(canvas, &text, &Room { left, top: top + 2.0, width, height }, color);
}

/// Writes words from top to bottom, in the middle of the room.
fn downwards(canvas: &mut Canvas, text: &str, room: &Room, color: RGBColor) {
    let fits = |size: &f64| *size <= room.width && style::text_width(text, *size) <= room.height;
    let size = SIZES.into_iter().find(fits).unwrap_or(SIZES[4].min(room.width));
    let text = style::fitted(text, size, room.height);
    let middle = room.left + 0.5 * (room.width + 3.0) + 0.5;
    canvas.text_downwards(&text, (middle, room.top), Type::new(size).color(color));
}

/// Writes words upright, as studios write camera work, with movements at once under each other; from top to bottom where
/// they are too wide.
fn upright(canvas: &mut Canvas, text: &str, room: &Room, color: RGBColor) {
    let parts: Vec<String> = text.replace(" + ", "\n+ ").lines().map(str::to_owned).collect();
    let fits = |size: &f64| {
        let widest = parts.iter().map(|part| style::text_width(part, *size)).fold(0.0, f64::max);
        widest <= room.width - HOOK && parts.len() as f64 * LINE * size <= room.height
    };
    let Some(size) = SIZES.into_iter().find(fits) else {
        return downwards(canvas, text, room, color);
    };
    let look = Type::new(size).color(color);
    for (at, part) in parts.iter().enumerate() {
        let base = room.top + size + at as f64 * LINE * size;
        canvas.text(part, (room.left + HOOK, base), look);
    }
}
