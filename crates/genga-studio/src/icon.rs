//! Button icons, drawn as shapes so that no font needs them.

use egui::{
    Color32, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind, Ui, vec2,
};

use super::panels::Side;

/// An icon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Icon {
    Play,
    Stop,
    /// A step back or forward.
    Step {
        is_back: bool,
    },
    /// A skip back or forward: an arrow against a bar.
    Skip {
        is_back: bool,
    },
    /// Closes or removes something.
    Cross,
    /// Pins a genga, or unpins it.
    Pin {
        is_set: bool,
    },
    /// Resets a value.
    Back,
    /// A disc, half of it dark.
    Theme,
    /// A window with a panel at a side.
    Panel(Side),
}

/// Side of a button in points.
const SIDE: f32 = 22.0;

/// A toggle button with an icon.
pub(super) fn switch(ui: &mut Ui, icon: Icon, name: &str, is_on: bool) -> Response {
    let ink = ui.visuals().weak_text_color();
    let response = plain(ui, icon, (!is_on).then_some(ink));
    response.widget_info(|| egui::WidgetInfo::selected(Role::Button, true, is_on, name));
    response.on_hover_text(name)
}

/// A button with an icon. The name is its tooltip and its label for screen readers.
pub(super) fn button(ui: &mut Ui, icon: Icon, name: &str) -> Response {
    let response = plain(ui, icon, None);
    response.widget_info(|| egui::WidgetInfo::labeled(Role::Button, true, name));
    response.on_hover_text(name)
}

/// Draws a cross.
pub(super) fn cross(painter: &Painter, middle: Pos2, half: f32, stroke: Stroke) {
    painter.line_segment([middle - vec2(half, half), middle + vec2(half, half)], stroke);
    painter.line_segment([middle - vec2(half, -half), middle + vec2(half, -half)], stroke);
}

/// A button without a name. `ink` overrides the icon's colour.
fn plain(ui: &mut Ui, icon: Icon, ink: Option<Color32>) -> Response {
    let is_small = matches!(icon, Icon::Cross | Icon::Back | Icon::Pin { .. });
    let side = if is_small { 16.0 } else { SIDE };
    let (rect, response) = ui.allocate_exact_size(vec2(side, side), Sense::click());
    let visuals = ui.style().interact(&response);
    let painter = ui.painter();
    painter.rect(
        rect,
        visuals.corner_radius,
        visuals.weak_bg_fill,
        visuals.bg_stroke,
        StrokeKind::Inside,
    );
    draw(painter, icon, rect.shrink(0.26 * side), ink.unwrap_or(visuals.fg_stroke.color));
    response
}

fn draw(painter: &Painter, icon: Icon, rect: Rect, ink: Color32) {
    let stroke = Stroke::new(1.6, ink);
    // Converts a point of the icon, whose edges are 0 and 1.
    let at = |x: f32, y: f32| rect.min + vec2(x, y) * rect.size();
    let flip = |is_back: bool, x: f32| if is_back { 1.0 - x } else { x };
    let arrow = |is_back: bool, tip: f32| {
        let corners = [(0.1, 0.0), (tip, 0.5), (0.1, 1.0)];
        let corners = corners.map(|(x, y)| at(flip(is_back, x), y)).to_vec();
        painter.add(Shape::convex_polygon(corners, ink, Stroke::NONE));
    };
    match icon {
        Icon::Play => arrow(false, 1.0),
        Icon::Stop => drop(painter.rect_filled(rect, 1.0, ink)),
        Icon::Step { is_back } => {
            let way = [(0.2, 0.0), (0.8, 0.5), (0.2, 1.0)];
            let way: Vec<Pos2> = way.map(|(x, y)| at(flip(is_back, x), y)).to_vec();
            painter.line(way, stroke);
        }
        Icon::Skip { is_back } => {
            arrow(is_back, 0.8);
            let x = flip(is_back, 0.92);
            painter.line_segment([at(x, 0.0), at(x, 1.0)], stroke);
        }
        Icon::Cross => cross(painter, rect.center(), 0.5 * rect.width(), stroke),
        Icon::Pin { is_set } => {
            let (head, radius) = (at(0.5, 0.3), 0.3 * rect.width());
            painter.line_segment([at(0.5, 0.6), at(0.5, 1.05)], stroke);
            match is_set {
                true => painter.circle_filled(head, radius, ink),
                false => painter.circle_stroke(head, radius, stroke),
            };
        }
        Icon::Back => {
            let turn = |step: i32| {
                let angle = 0.9 * std::f32::consts::PI + step as f32 * 0.42;
                rect.center() + 0.5 * rect.width() * vec2(angle.cos(), angle.sin())
            };
            painter.line((0..12).map(turn).collect(), stroke);
            let tip = turn(0);
            let head = [vec2(-2.8, -1.4), vec2(2.8, -1.4), vec2(0.0, 2.6)].map(|way| tip + way);
            painter.add(Shape::convex_polygon(head.to_vec(), ink, Stroke::NONE));
        }
        Icon::Panel(side) => {
            let thin = Stroke::new(1.2, ink);
            painter.rect_stroke(rect, 1.5, thin, StrokeKind::Middle);
            let panel = match side {
                Side::Knobs => [at(0.0, 0.0), at(0.36, 1.0)],
                Side::Curves => [at(0.0, 0.62), at(1.0, 1.0)],
                Side::Sheet => [at(0.64, 0.0), at(1.0, 1.0)],
            };
            painter.rect_filled(Rect::from_min_max(panel[0], panel[1]), 1.0, ink);
        }
        Icon::Theme => {
            let (middle, radius) = (rect.center(), 0.5 * rect.width());
            painter.circle_stroke(middle, radius, stroke);
            let half = |step: i32| {
                let angle = (step as f32 / 12.0 - 0.5) * std::f32::consts::PI;
                middle + radius * vec2(angle.cos(), angle.sin())
            };
            let half: Vec<Pos2> = (0..=12).map(half).collect();
            painter.add(Shape::convex_polygon(half, ink, Stroke::NONE));
        }
    }
}
