//! The ruler above the curves: koma or frames, the numbers of the genga with their lines, and dots for the inbetweens.
//! The distances of the dots show the spacing (詰め). If numbers would overlap, some genga have ticks instead.

use egui::{Align2, FontId, Painter, Rect, Stroke, pos2};

use crate::column::KeyedCell;
use crate::label_culling::{Room, step};
use crate::time_axis::{Scale, across};
use crate::timesheet::badge;
use crate::view_state::Shown;
use genga::sheet::Source;

/// Height in points.
pub(super) const HEIGHT: f32 = 36.0;
/// Distance below which two numbers would overlap, in points.
const APART: f32 = 17.0;
/// Average distance below which only genga with round numbers are labelled, and the room for each label, in points.
const CROWDED: f32 = 7.0;
const CALM: f32 = 36.0;
/// Distance below which dots cannot be told apart, in points.
const CLOSEST: f32 = 1.5;
/// Average distance below which inbetweens are not drawn, in points. They would merge into a grey band.
const DOTS: f32 = 3.0;

/// Draws koma or frames, numbers, and their lines down to `bottom`.
pub(super) fn draw(painter: &Painter, rect: Rect, bottom: f32, time: &Scale, shown: &Shown<'_>) {
    let look = &shown.look;
    let numbers: Vec<(f64, usize)> = match shown.counts_frames {
        true => time.ticks(56.0).map(|frame| (frame, frame as usize)).collect(),
        false => time.koma(56.0, shown.column().clock),
    };
    for (place, number) in numbers {
        let at = pos2(time.x(place), rect.min.y);
        painter.text(at, Align2::CENTER_TOP, number, FontId::proportional(10.0), look.faint);
    }
    actions(painter, rect, bottom, time, shown);
    inbetweens(painter, rect, time, shown);
    genga(painter, rect, bottom, time, shown);
}

/// Draws the number and the line of each genga. If they crowd, only some have numbers and the others ticks.
fn genga(painter: &Painter, rect: Rect, bottom: f32, time: &Scale, shown: &Shown<'_>) {
    let look = &shown.look;
    let seen = |cell: &&KeyedCell<'_>| {
        let x = time.x(cell.drawing.source.place());
        cell.genga.is_some() && x >= rect.min.x - 9.0 && x <= rect.max.x + 9.0
    };
    let cells: Vec<_> = shown.column().cells.iter().filter(seen).collect();
    let x = |cell: &KeyedCell<'_>| time.x(cell.drawing.source.place());
    let apart = across(cells.iter().map(|cell| x(cell)));
    let every = if apart < CROWDED { step(apart, CALM) } else { 1 };
    let (mut badges, mut ticks) = (Room::default(), Room::default());
    for cell in cells {
        let (Some(place), Source::At(_)) = (cell.genga, cell.drawing.source) else { continue };
        let (x, y) = (x(cell), rect.max.y - 11.0);
        let color = look.of_role(cell.drawing.role);
        let is_numbered = every == 1 || place == 1 || place % every == 0;
        if is_numbered && badges.take(x, APART) {
            ticks.take(x, CLOSEST);
            painter.vline(x, y + 8.0..=bottom, Stroke::new(1.0, look.genga_line));
            let number = cell.drawing.genga_number(place);
            badge(painter, pos2(x, y), &number, color, cell.key, look.paper);
        } else if ticks.take(x, CLOSEST) {
            if every == 1 {
                painter.vline(x, y + 8.0..=bottom, Stroke::new(1.0, look.genga_line));
                painter.circle_filled(pos2(x, y), 2.5, color);
            } else {
                // Below the circles, so that no number is crossed out.
                painter.vline(x, y + 9.0..=y + 11.0, Stroke::new(1.0, color));
            }
        }
    }
}

/// Draws a line where an action begins.
fn actions(painter: &Painter, rect: Rect, bottom: f32, time: &Scale, shown: &Shown<'_>) {
    for split in shown.breakdown.actions.splits() {
        let x = time.x(split.frame.0 as f64);
        if rect.x_range().contains(x) {
            painter.vline(x, rect.min.y..=bottom, Stroke::new(2.0, shown.look.action));
        }
    }
}

/// Draws a dot at the source place of each inbetween, if there is room for dots at all.
fn inbetweens(painter: &Painter, rect: Rect, time: &Scale, shown: &Shown<'_>) {
    let inbetweens = shown.column().cells.iter().filter(|cell| cell.genga.is_none());
    let places = inbetweens.map(|cell| time.x(cell.drawing.source.place()));
    let places: Vec<f32> = places.filter(|x| rect.x_range().contains(*x)).collect();
    if across(places.iter().copied()) < DOTS {
        return;
    }
    let mut room = Room::default();
    for x in places.into_iter().filter(|x| room.take(*x, CLOSEST)) {
        painter.circle_filled(pos2(x, rect.max.y - 11.0), 2.6, shown.look.inbetween);
    }
}
