//! Draws the figure in the window, from far to near.

use egui::{Color32, Painter, Pos2, Stroke};

use super::orbit::position;
use crate::theme::Look;
use genga_plot::parts::{BodySide, Drawn, Ink, Shape};

/// Colours of a figure.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Inks {
    /// Left and right in their own colours.
    Sides,
    /// Lines only, in one colour, with their width multiplied by a factor.
    One(Color32, f32),
    /// Filled with one colour.
    Shadow(Color32),
}

/// Share of the side's colour in the fill of a body part.
const BREATH: f32 = 0.14;

impl Inks {
    fn line(self, ink: Ink, look: &Look) -> Color32 {
        match (self, ink) {
            (Self::Sides, Ink::Side(side)) => look.of_side(side),
            (Self::Sides, Ink::Guide) => look.inbetween,
            (Self::One(color, _) | Self::Shadow(color), _) => color,
        }
    }

    fn fill(self, side: BodySide, look: &Look) -> Color32 {
        match (self, side) {
            (Self::Sides, BodySide::Trunk) => look.ground,
            (Self::Sides, side) => look.ground.lerp_to_gamma(look.of_side(side), BREATH),
            (Self::One(..), _) => Color32::TRANSPARENT,
            (Self::Shadow(color), _) => color,
        }
    }

    /// Factor of the line width.
    fn share(self) -> f32 {
        if let Self::One(_, share) = self { share } else { 1.0 }
    }
}

/// Draws a figure, from far to near.
pub(crate) fn draw(painter: &Painter, drawn: &Drawn, inks: Inks, look: &Look) {
    let ink = inks.line(Ink::Side(BodySide::Trunk), look);
    for shape in &drawn.shapes {
        match shape {
            Shape::Line(line) => {
                let (from, to) = (position(line.from), position(line.to));
                bone(
                    painter,
                    [from, to],
                    line.width as f32 * inks.share(),
                    inks.line(line.ink, look),
                );
            }
            Shape::Part { outline, width, side } => {
                let outline: Vec<Pos2> = outline.iter().map(|point| position(*point)).collect();
                let edge = inks.line(Ink::Side(*side), look);
                let stroke = Stroke::new(*width as f32 * inks.share(), edge);
                let fill = inks.fill(*side, look);
                painter.add(egui::Shape::convex_polygon(outline, fill, stroke));
            }
            Shape::Ring(middle, radius) => {
                let radius = *radius as f32;
                let stroke = Stroke::new((0.26 * radius * inks.share()).max(1.0), ink);
                painter.circle(position(*middle), radius, inks.fill(BodySide::Trunk, look), stroke);
            }
            Shape::Dot(dot) => {
                painter.circle_filled(position(*dot), 4.0, ink);
            }
        }
    }
}

/// A line with round ends.
fn bone(painter: &Painter, ends: [Pos2; 2], width: f32, color: Color32) {
    painter.line_segment(ends, Stroke::new(width, color));
    if width > 2.0 {
        for end in ends {
            painter.circle_filled(end, 0.5 * width, color);
        }
    }
}
