//! The figure in the window: thick bones with round ends, and a head.

use egui::{Color32, Painter, Stroke};

use super::orbit::position;
use crate::plot::parts::Drawn;
use crate::studio::look::Look;

/// In what a figure is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) enum Inks {
    /// Left and right in colours of their own.
    Sides,
    /// All in one, as thin as a share of its bones.
    One(Color32, f32),
}

/// Draws a figure, from the far to the near.
pub(super) fn draw(painter: &Painter, drawn: &Drawn, inks: Inks, look: &Look) {
    let share = match inks {
        Inks::Sides => 1.0,
        Inks::One(_, share) => share,
    };
    for stroke in &drawn.strokes {
        let color = match inks {
            Inks::Sides => look.of_side(stroke.side),
            Inks::One(color, _) => color,
        };
        let (from, to) = (position(stroke.from), position(stroke.to));
        let width = stroke.width as f32 * share;
        painter.line_segment([from, to], Stroke::new(width, color));
        if width > 2.0 {
            painter.circle_filled(from, 0.5 * width, color);
            painter.circle_filled(to, 0.5 * width, color);
        }
    }
    let ink = match inks {
        Inks::Sides => look.ink,
        Inks::One(color, _) => color,
    };
    if let Some((middle, radius)) = drawn.head {
        let fill = if matches!(inks, Inks::Sides) { look.ground } else { Color32::TRANSPARENT };
        let radius = radius as f32;
        painter.circle(
            position(middle),
            radius,
            fill,
            Stroke::new((0.26 * radius * share).max(1.0), ink),
        );
    }
    if let Some(dot) = drawn.dot {
        painter.circle_filled(position(dot), 4.0, ink);
    }
}
