//! The ruler over the curves: koma or frames, the numbers of the genga with their lines, and the inbetweens between them: how
//! they crowd is their spacing (詰め).

use egui::{Align2, FontId, Painter, Rect, Stroke, pos2};

use super::time::Scale;
use crate::sheet::Source;
use crate::studio::shown::Shown;
use crate::studio::timesheet::badge;

/// Its height.
pub(super) const HEIGHT: f32 = 36.0;
/// Two numbers nearer than this would cover each other.
const APART: f32 = 17.0;

/// Dots nearer than this cannot be told apart.
const CLOSEST: f32 = 1.5;

/// Draws koma or frames, numbers and the lines down to `bottom`.
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
    let mut last = f32::NEG_INFINITY;
    for cell in &shown.column().cells {
        let (Some(number), Source::At(place)) = (cell.genga, cell.drawing.source) else { continue };
        let x = time.x(place);
        if x < rect.min.x - 9.0 || x > rect.max.x + 9.0 {
            continue;
        }
        let middle = pos2(x, rect.max.y - 11.0);
        let color = look.of_role(cell.drawing.role);
        if (x - last).abs() < CLOSEST && last > f32::NEG_INFINITY {
            continue;
        }
        painter.vline(x, middle.y + 8.0..=bottom, Stroke::new(1.0, look.genga_line));
        if x - last < APART {
            painter.circle_filled(middle, 2.5, color);
            continue;
        }
        badge(painter, middle, number, color, cell.key, look.paper);
        last = x;
    }
}

/// A line where an action begins.
fn actions(painter: &Painter, rect: Rect, bottom: f32, time: &Scale, shown: &Shown<'_>) {
    for split in shown.breakdown.actions.splits() {
        let x = time.x(split.frame.0 as f64);
        if rect.x_range().contains(x) {
            painter.vline(x, rect.min.y..=bottom, Stroke::new(2.0, shown.look.action));
        }
    }
}

/// A dot where each inbetween is taken from. Of those that would cover each other the first.
fn inbetweens(painter: &Painter, rect: Rect, time: &Scale, shown: &Shown<'_>) {
    let mut last = f32::NEG_INFINITY;
    for cell in shown.column().cells.iter().filter(|cell| cell.genga.is_none()) {
        let at = pos2(time.x(cell.drawing.source.place()), rect.max.y - 11.0);
        if rect.x_range().contains(at.x) && at.x - last >= CLOSEST {
            last = at.x;
            painter.circle_filled(at, 2.6, shown.look.inbetween);
        }
    }
}
