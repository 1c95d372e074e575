//! The ruler over the curves: frames, and the numbers of the genga with their lines.

use egui::{Align2, FontId, Painter, Rect, Stroke, pos2};

use super::time::Scale;
use crate::sheet::Source;
use crate::studio::shown::Shown;
use crate::studio::timesheet::badge;

/// Its height.
pub(super) const HEIGHT: f32 = 36.0;
/// Two numbers nearer than this would cover each other.
const APART: f32 = 17.0;

/// Draws frames, numbers and the lines down to `bottom`.
pub(super) fn draw(painter: &Painter, rect: Rect, bottom: f32, time: &Scale, shown: &Shown<'_>) {
    let look = &shown.look;
    for frame in time.ticks(56.0) {
        let at = pos2(time.x(frame), rect.min.y);
        painter.text(at, Align2::CENTER_TOP, frame, FontId::proportional(10.0), look.faint);
    }
    let mut last = f32::NEG_INFINITY;
    for cell in &shown.column.cells {
        let (Some(number), Source::At(place)) = (cell.genga, cell.drawing.source) else { continue };
        let x = time.x(place);
        if x < rect.min.x - 9.0 || x > rect.max.x + 9.0 {
            continue;
        }
        let middle = pos2(x, rect.max.y - 11.0);
        let color = look.of_role(cell.drawing.role);
        painter.vline(x, middle.y + 8.0..=bottom, Stroke::new(1.0, look.genga_line));
        if x - last < APART {
            painter.circle_filled(middle, 2.5, color);
            continue;
        }
        badge(painter, middle, number, color, cell.key, look.paper);
        last = x;
    }
}
