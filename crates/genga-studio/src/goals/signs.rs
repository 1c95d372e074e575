//! Small pictures of the ends of the goals, and the marks of the stops.

use egui::{Painter, Rect, Sense, Stroke, Ui, pos2, vec2};

use super::{Goal, Seen};
use crate::theme::Look;

/// Size of a picture in points.
pub(super) const WIDE: f32 = 40.0;
const HIGH: f32 = 18.0;

/// An end of a goal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Few,
    Many,
}

/// Shows the picture of an end.
pub(super) fn show(ui: &mut Ui, goal: Goal, end: End, seen: &Seen<'_>) {
    let (rect, _) = ui.allocate_exact_size(vec2(WIDE, HIGH), Sense::hover());
    let sign =
        Sign { painter: &ui.painter_at(rect.expand(1.0)), rect: rect.shrink2(vec2(3.0, 2.0)) };
    match goal {
        Goal::Genga => sign.genga(end, seen.look),
        Goal::Pace => sign.drawings(end, seen.look),
        Goal::Snap => sign.spacing(end, seen.look),
    }
}

struct Sign<'a> {
    painter: &'a Painter,
    rect: Rect,
}

impl Sign<'_> {
    fn x(&self, share: f32) -> f32 {
        self.rect.min.x + share * self.rect.width()
    }

    /// Rings of genga on a line: two, or six.
    fn genga(&self, end: End, look: &Look) {
        let (count, radius) = if end == End::Few { (2, 4.5) } else { (5, 3.0) };
        let y = self.rect.center().y;
        self.painter.hline(self.rect.x_range(), y, Stroke::new(1.0, look.faint));
        for at in 0..count {
            let x = self.x((at as f32 + 0.5) / count as f32);
            self.painter.circle(pos2(x, y), radius, look.paper, Stroke::new(1.6, look.genga));
        }
    }

    /// Drawings as bars that are as long as they stay: two long ones, or eight short ones.
    fn drawings(&self, end: End, look: &Look) {
        let count = if end == End::Few { 2 } else { 8 };
        for at in 0..count {
            let [left, right] = [at, at + 1].map(|edge| self.x(edge as f32 / count as f32));
            let bar =
                Rect::from_x_y_ranges(left + 0.7..=right - 0.7, self.rect.y_range().shrink(2.0));
            self.painter.rect_filled(bar, 1.0, look.inbetween);
        }
    }

    /// Inbetweens between two genga: at equal distances, or crowded at them.
    fn spacing(&self, end: End, look: &Look) {
        let between: [f32; 4] = match end {
            End::Few => [0.2, 0.4, 0.6, 0.8],
            End::Many => [0.1, 0.18, 0.82, 0.9],
        };
        let y = self.rect.center().y;
        for share in between {
            let tick = self.rect.y_range().shrink(3.5);
            self.painter.vline(self.x(share), tick, Stroke::new(1.2, look.inbetween));
        }
        if end == End::Many {
            let gap = self.x(0.28)..=self.x(0.72);
            self.painter.hline(gap, y, Stroke::new(1.0, look.grid));
        }
        for share in [0.0, 1.0] {
            self.painter.vline(self.x(share), self.rect.y_range(), Stroke::new(2.2, look.genga));
        }
    }
}

/// Marks the stops below a slider, and the place of a recipe between them.
pub(super) fn stops(ui: &Ui, slider: Rect, count: usize, place: f64, look: &Look) {
    // The knob of a slider is round, and its middle does not reach the ends.
    let margin = 0.5 * slider.height() / 1.25;
    let span = slider.shrink2(vec2(margin, 0.0));
    let is_between = place.fract() != 0.0;
    for at in 0..count {
        let x = span.min.x + span.width() * at as f32 / (count - 1).max(1) as f32;
        let color = if is_between { look.grid } else { look.faint };
        let tick = slider.max.y - 2.5..=slider.max.y + 0.5;
        ui.painter().vline(x, tick, Stroke::new(1.0, color));
    }
}
