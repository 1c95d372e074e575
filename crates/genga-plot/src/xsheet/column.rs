//! Fills the columns: key numbers and marks in ACTION, every drawing in CELL.

use std::ops::Range;

use crate::canvas::{Align, Canvas, Type};
use crate::paper_point::Point;
use crate::style;
use crate::xsheet::InbetweenMark;
use crate::xsheet::half_page::{Half, Place, ROW};
use crate::xsheet::layout::Page;
use crate::xsheet::paper_layer::Leaf;
use genga::sheet::{Exposure, Number};

/// Fills the ACTION column (原画): a number for each key, a mark for each inbetween.
pub(super) fn action(
    canvas: &mut Canvas,
    page: &Page<'_>,
    leaf: &Leaf<'_>,
    half: Half,
    place: Place,
) {
    column(canvas, page, leaf, half, place, &|canvas, shown, center| match &leaf.genga
        [shown.drawing]
    {
        Some(number) => key(canvas, leaf, shown.drawing, number, center),
        None => match page.settings.inbetween {
            InbetweenMark::Dot => canvas.disc(center, 2.2, style::INK),
            InbetweenMark::Circle => canvas.ring(center, 4.0, style::INK, 1.1),
        },
    });
    carried_over(canvas, leaf, half, place, &|drawing| leaf.genga[drawing].as_ref());
}

/// Fills the CELL column (動画): every drawing's number, bold for keys, and END under the highest. A circle holds the
/// number of a genga, so that there is none here.
pub(super) fn cell(
    canvas: &mut Canvas,
    page: &Page<'_>,
    leaf: &Leaf<'_>,
    half: Half,
    place: Place,
) {
    column(canvas, page, leaf, half, place, &|canvas, shown, center| {
        let look = Type::new(10.5);
        let color = style::of_role(leaf.layer.drawings[shown.drawing].role);
        let is_key = leaf.genga[shown.drawing].is_some();
        let look = if is_key { look.bold().color(color) } else { look };
        written(canvas, &leaf.numbers[shown.drawing], center, look);
    });
    carried_over(canvas, leaf, half, place, &|drawing| leaf.numbers.get(drawing));
    mark_end(canvas, leaf, half, place);
}

type Write<'a> = dyn Fn(&mut Canvas, Exposure, Point) + 'a;

/// Draws each exposure by its mark and hold line, and the empty koma before the first and after the last.
fn column(
    canvas: &mut Canvas,
    page: &Page<'_>,
    leaf: &Leaf<'_>,
    half: Half,
    place: Place,
    write: &Write<'_>,
) {
    let x = place.middle();
    let one_for_all = leaf.layer.exposures.len() == 1 && leaf.layer.length() > 3;
    for (begin, shown) in leaf.on(half).filter(|(begin, _)| !leaf.is_repeated(*begin)) {
        let end = begin + shown.koma;
        let is_again = leaf.repeat == Some(begin);
        if page.settings.hold_line.draws(shown.koma) && !is_again {
            let (from, to) = ((begin + 1).max(half.begin), end.min(half.end()));
            if from < to {
                let top = half.y(from) + if from == begin + 1 { 0.5 } else { 0.0 };
                canvas.line((x, top), (x, half.y(to) - 3.0), style::INK, 1.1);
            }
        }
        if half.shows(begin) {
            write(canvas, shown, (x, half.y(begin) + 0.5 * ROW));
        }
        if one_for_all {
            held(canvas, half, x, begin, end);
        }
    }
    let before = page.sheet.blank.before;
    let past = before + leaf.layer.length();
    if let Some(begin) = leaf.repeat {
        repeated(canvas, half, x, begin + 1..past);
    }
    empty(canvas, half, place, (0, before));
    empty(canvas, half, place, (past, page.sheet.cut_length()));
}

/// Writes リピート down the koma of a repeat, and draws its arrow to the last of them.
fn repeated(canvas: &mut Canvas, half: Half, x: f64, koma: Range<usize>) {
    const WORD: [&str; 4] = ["リ", "ピ", "｜", "ト"];
    let look = Type::new(11.0).bold().align(Align::Center);
    let has_room = koma.len() > WORD.len() + 1;
    let word = if has_room { &WORD[..] } else { &[] };
    for (letter, koma) in word.iter().zip(koma.clone()).filter(|(_, koma)| half.shows(*koma)) {
        canvas.text(letter, (x, half.y(koma) + 0.5 * ROW + 4.0), look);
    }
    let (from, to) = ((koma.start + word.len()).max(half.begin), koma.end.min(half.end()));
    if from >= to {
        return;
    }
    let bottom = half.y(to) - 3.0;
    canvas.line((x, half.y(from) + 2.0), (x, bottom), style::INK, 1.4);
    if to == koma.end {
        for side in [-4.5, 4.5] {
            canvas.line((x + side, bottom - 7.0), (x, bottom), style::INK, 1.4);
        }
    }
}

/// Writes HOLD (止メ) down a column with only one drawing.
fn held(canvas: &mut Canvas, half: Half, x: f64, begin: usize, end: usize) {
    let look = Type::new(10.0).bold().align(Align::Center);
    for (at, word) in ["止", "メ", "H", "O", "L", "D"].into_iter().enumerate() {
        let koma = begin + 2 + at;
        if half.shows(koma) && koma < end {
            let y = half.y(koma);
            canvas.rect((x - 6.0, y + 1.0), (x + 6.0, y + ROW - 1.0), style::PAPER);
            canvas.text(word, (x, y + 0.5 * ROW + 3.7), look);
        }
    }
}

/// Draws × (カラ) on the first of some empty koma, and a wave down to the last.
fn empty(canvas: &mut Canvas, half: Half, place: Place, (begin, end): (usize, usize)) {
    let x = place.middle();
    if begin < end && half.shows(begin) {
        canvas.cross((x, half.y(begin) + 0.5 * ROW), 4.5, style::INK, 1.4);
    }
    let (from, to) = ((begin + 1).max(half.begin), end.min(half.end()));
    if from >= to {
        return;
    }
    let quarters = 4 * (to - from);
    let wave = |at: usize| {
        let side = [0.0, 3.0, 0.0, -3.0][at % 4];
        (x + side, half.y(from) + 0.25 * ROW * at as f64)
    };
    let wave: Vec<_> = (0..=quarters).map(wave).collect();
    canvas.path(&wave, style::FAINT, 1.0);
}

/// Writes the number of a drawing held over from before this half, in brackets on the first koma.
fn carried_over<'a>(
    canvas: &mut Canvas,
    leaf: &'a Leaf<'_>,
    half: Half,
    place: Place,
    number: &dyn Fn(usize) -> Option<&'a Number>,
) {
    let before = leaf.on(half).next().filter(|(begin, _)| *begin < half.begin);
    let before = before.filter(|(begin, _)| leaf.repeat.is_none_or(|repeat| *begin < repeat));
    let Some((_, shown)) = before else { return };
    let center = (place.middle(), half.y(half.begin) + 0.5 * ROW);
    let text = number(shown.drawing).map_or("(・)".into(), |number| format!("({number})"));
    blank_out(canvas, center, style::text_width(&text, 9.0));
    let look = Type::new(9.0).color(style::FAINT).align(Align::Center);
    canvas.text(&text, (center.0, center.1 + 3.3), look);
}

/// Writes END under the highest number, so that nobody looks for more drawings.
fn mark_end(canvas: &mut Canvas, leaf: &Leaf<'_>, half: Half, place: Place) {
    let Some(begin) = leaf.end.filter(|begin| half.shows(*begin)) else { return };
    let center = (place.middle(), half.y(begin) + 1.5 * ROW);
    blank_out(canvas, center, style::text_width("END", 8.5));
    let look = Type::new(8.5).bold().align(Align::Center);
    canvas.text("END", (center.0, center.1 + 3.2), look);
}

fn blank_out(canvas: &mut Canvas, (x, y): Point, width: f64) {
    let half = 0.5 * width + 1.0;
    canvas.rect((x - half, y - 0.5 * ROW + 1.5), (x + half, y + 0.5 * ROW - 1.5), style::PAPER);
}

/// Draws a number in a circle, which is filled for a pinned key.
pub(super) fn key(
    canvas: &mut Canvas,
    leaf: &Leaf<'_>,
    drawing: usize,
    number: &Number,
    center: Point,
) {
    let drawing = &leaf.layer.drawings[drawing];
    let color = style::of_role(drawing.role);
    let look = if drawing.why.pinned.is_some() {
        canvas.disc(center, 7.6, color);
        Type::new(10.0).color(style::PAPER)
    } else {
        canvas.ring(center, 7.2, color, 1.2);
        Type::new(10.0).color(color)
    };
    written(canvas, number, center, look.bold());
}

fn written(canvas: &mut Canvas, number: &Number, (x, y): Point, look: Type) {
    let text = number.to_string();
    let size = match text.len() {
        0..=2 => look.size,
        3 => 8.0,
        _ => 6.5,
    };
    canvas.text(&text, (x, y + 0.36 * size), Type { size, ..look }.align(Align::Center));
}
