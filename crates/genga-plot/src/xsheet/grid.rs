//! Draws the printed paper: lines, koma numbers, names of blocks and columns, and the end of the cut.

use plotters::style::RGBColor;

use crate::canvas::{Align, Canvas, Type};
use crate::style;
use crate::xsheet::half_page::{Half, ROW, ROWS, TOP};
use crate::xsheet::layout::{MARGIN, NUMBERS, Page};

/// Colour of lines between koma.
const THIN: RGBColor = RGBColor(206, 216, 211);
/// Colour of lines every six koma and between columns.
const MIDDLE: RGBColor = RGBColor(132, 156, 146);
/// Colour of lines between seconds and blocks.
const HEAVY: RGBColor = RGBColor(52, 82, 70);
/// Colour behind the names of blocks.
const TINT: RGBColor = RGBColor(234, 241, 238);

const NAMES: f64 = 44.0;
const LETTERS: f64 = 17.0;

pub(super) fn draw(canvas: &mut Canvas, page: &Page<'_>, half: Half) {
    let (blocks, right) = Page::blocks(half);
    let (top, bottom) = (TOP - NAMES, half.y(half.end()));
    canvas.rect((half.left, top), (right, TOP), TINT);
    for koma in half.begin..=half.end() {
        let y = half.y(koma);
        let (color, width) = match koma {
            koma if koma % page.second() == 0 => (HEAVY, 2.2),
            koma if koma % 6 == 0 => (MIDDLE, 1.1),
            _ => (THIN, 0.6),
        };
        canvas.line((half.left, y), (right, y), color, width);
    }
    columns(canvas, page, half, bottom);
    for (left, english, japanese) in blocks {
        canvas.line((left, top), (left, bottom), HEAVY, 1.5);
        let next = blocks.iter().map(|block| block.0).find(|other| *other > left);
        let middle = 0.5 * (left + next.unwrap_or(right));
        let center = |size: f64| Type::new(size).align(Align::Center);
        canvas.text(
            english,
            (middle, top + 12.5),
            center(if next == Some(left + NUMBERS) { 9.0 } else { 10.5 }).bold(),
        );
        canvas.text(japanese, (middle, top + 24.5), center(9.0).color(style::FAINT));
    }
    canvas.line((right, top), (right, bottom), HEAVY, 1.5);
    for y in [top, TOP, bottom] {
        canvas.line((half.left, y), (right, y), HEAVY, 1.8);
    }
    numbers(canvas, page, half);
}

/// Draws the columns of cels in both blocks, and their names.
fn columns(canvas: &mut Canvas, page: &Page<'_>, half: Half, bottom: f64) {
    for at in 0..page.columns() {
        for place in [page.action(half, at), page.cell(half, at)] {
            if at > 0 {
                canvas.line((place.left, TOP - LETTERS), (place.left, bottom), MIDDLE, 0.8);
            }
            if let Some(leaf) = page.leaves.get(at) {
                let name = style::fitted(&leaf.layer.name, 12.0, place.width - 2.0);
                let look = Type::new(12.0).bold().align(Align::Center);
                canvas.text(&name, (place.middle(), TOP - 4.5), look);
            }
        }
    }
}

/// Writes the koma numbers from 1, stronger at seconds and at every sixth koma.
fn numbers(canvas: &mut Canvas, page: &Page<'_>, half: Half) {
    for koma in half.begin..half.end() {
        let number = koma + 1;
        let look = match number {
            // Four digits in a larger size would touch the edge.
            number if number >= 1000 => Type::new(8.5),
            number if number % page.second() == 0 => Type::new(11.0).bold(),
            number if number % 6 == 0 => Type::new(10.0),
            _ => Type::new(8.5).color(style::FAINT),
        };
        let y = half.y(koma) + 0.5 * ROW + 0.36 * look.size;
        let x = half.left + NUMBERS - 4.0;
        canvas.text(&number.to_string(), (x, y), look.align(Align::Right));
    }
}

/// Draws a heavy line under the last koma, and slashes below it.
pub(super) fn end(canvas: &mut Canvas, page: &Page<'_>, half: Half) {
    let length = page.sheet.cut_length();
    if length == 0 || !half.shows(length - 1) {
        return;
    }
    let (left, right) = (half.left + NUMBERS, Page::blocks(half).1);
    let y = half.y(length);
    canvas.line((half.left, y), (right, y), style::INK, 3.2);
    // On a full half, the slashes are shorter: they lie in the margin.
    let high = if length == half.end() { 0.7 * ROW } else { ROW };
    let step = 13.0;
    let slashes = ((right - left) / step) as usize;
    for at in 1..slashes {
        let x = left + step * at as f64;
        canvas.line((x - 0.5 * high, y + high - 1.5), (x + 0.5 * high, y + 3.0), style::INK, 1.1);
    }
}

/// Returns the y at which the rows of a full half end.
pub(super) fn bottom() -> f64 {
    TOP + ROWS as f64 * ROW
}

/// Left and right end of the rule between the head and the halves.
pub(super) const WIDTH: (f64, f64) = (MARGIN, 1000.0 - MARGIN);
/// Colour of the lines of the head.
pub(super) const FRAME: RGBColor = HEAVY;
