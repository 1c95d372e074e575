//! Draws the floor: lines half a metre apart, and the body's shadow.

use egui::{Painter, Stroke};
use glam::DVec3;

use super::body;
use super::orbit::placed;
use crate::scene::Scene;
use crate::view_state::Shown;
use genga_plot::parts::{Stage, View};

/// Greatest number of lines in one direction. More would not help.
const MOST: f64 = 60.0;

/// Draws the lines below everything that the motion reaches, and one cell beyond.
pub(super) fn draw(painter: &Painter, stage: &Stage, shown: &Shown<'_>) {
    let scene = shown.scene;
    let (a, b) = axes(scene);
    let span = |axis: DVec3| {
        let along = scene.reached.iter().map(|point| point.dot(axis));
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = along.fold(start, |(low, high), at| (low.min(at), high.max(at)));
        (low, high)
    };
    let (across, along) = (span(a), span(b));
    let widest = (across.1 - across.0).max(along.1 - along.0);
    let cell = scene.cell * (widest / (scene.cell * MOST)).ceil().max(1.0);
    let lines = |(low, high): (f64, f64)| ((low / cell).floor() - 1.0, (high / cell).ceil() + 1.0);
    let (across, along) = (lines(across), lines(along));
    let stroke = Stroke::new(1.0, shown.look.grid);
    let point =
        |x: f64, y: f64| placed(stage, a * (x * cell) + b * (y * cell) + scene.up * scene.floor);
    let mut at = across.0;
    while at <= across.1 {
        painter.line_segment([point(at, along.0), point(at, along.1)], stroke);
        at += 1.0;
    }
    let mut at = along.0;
    while at <= along.1 {
        painter.line_segment([point(across.0, at), point(across.1, at)], stroke);
        at += 1.0;
    }
}

/// Draws the shadow of a pose, with the light straight above.
pub(super) fn shadow(painter: &Painter, stage: &Stage, pose: &[DVec3], shown: &Shown<'_>) {
    let (a, b) = axes(shown.scene);
    let above = View { right: a, up: b, near: shown.scene.up };
    let on_floor = |point: DVec3| (point.dot(a), point.dot(b));
    let mut drawn = stage.figure.draw(pose, &above, 1.0, on_floor);
    let height = shown.scene.up * shown.scene.floor;
    drawn.each_point(|(x, y)| stage.place(a * x + b * y + height));
    body::draw(painter, &drawn, body::Inks::Shadow(shown.look.shadow), &shown.look);
}

/// Two level axes, at right angles.
fn axes(scene: &Scene) -> (DVec3, DVec3) {
    if scene.up == DVec3::Z { (DVec3::X, DVec3::Y) } else { (DVec3::X, DVec3::Z) }
}
