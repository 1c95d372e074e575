//! Trails (軌跡): the paths of the ends of chosen limbs, with a dot at every koma of the source and every drawing of the
//! result. Dots stand closer the slower the limb is, which makes the spacing visible.

use egui::{Painter, Pos2, Shape, Stroke, Vec2};
use glam::DVec3;

use super::orbit::placed;
use crate::command::Seen;
use crate::view_state::Shown;
use genga::sheet::Role;
use genga_plot::parts::Stage;

/// Number of koma shown before and after the play head.
const REACH: usize = 24;

/// A point of a trail.
struct Dot {
    koma: usize,
    /// Role of the drawing. `None` for koma of the source.
    role: Option<Role>,
    is_now: bool,
}

/// Draws the trails of the chosen joints. `pose` returns the points of a koma.
pub(super) fn draw(
    painter: &Painter,
    stage: &Stage,
    seen: Seen,
    shown: &Shown<'_>,
    mut pose: impl FnMut(usize) -> Vec<DVec3>,
) {
    if shown.joints.is_empty() {
        return;
    }
    let dots = dots(seen, shown);
    let poses: Vec<Vec<DVec3>> = dots.iter().map(|dot| pose(dot.koma)).collect();
    let mut ends: Vec<usize> =
        shown.joints.iter().map(|joint| shown.scene.fastest_end(*joint)).collect();
    ends.sort_unstable();
    ends.dedup();
    for end in ends {
        let places: Vec<Pos2> = poses.iter().map(|pose| placed(stage, pose[end])).collect();
        path(painter, &places, &dots, shown);
    }
}

fn dots(seen: Seen, shown: &Shown<'_>) -> Vec<Dot> {
    let length = shown.column().length;
    let from = shown.at.saturating_sub(REACH);
    let past = (shown.at + REACH + 1).min(length);
    if seen == Seen::Source {
        let dot = |koma| Dot { koma, role: None, is_now: koma == shown.at };
        return (from..past).map(dot).collect();
    }
    let on_screen = &shown.on_screen;
    let now = on_screen.at(shown.at);
    let dot = |at: usize| {
        let cell = &on_screen.cells[at];
        let (koma, is_now) = (if at == now { shown.at } else { cell.koma }, at == now);
        Dot { koma, role: Some(cell.drawing.role), is_now }
    };
    (on_screen.at(from)..=on_screen.at(past - 1)).map(dot).collect()
}

fn path(painter: &Painter, places: &[Pos2], dots: &[Dot], shown: &Shown<'_>) {
    let look = &shown.look;
    let mut line: Vec<Pos2> = Vec::with_capacity(places.len());
    for place in places {
        if line.last().is_none_or(|last| is_apart(*last, *place)) {
            line.push(*place);
        }
    }
    painter.add(Shape::line(line, Stroke::new(1.0, look.genga_line)));
    for (place, dot) in places.iter().zip(dots) {
        let (radius, color) = match dot.role {
            Some(role) if role.is_kept() => (3.4, look.of_role(role)),
            _ => (2.1, look.inbetween),
        };
        painter.circle(*place, radius, color, Stroke::new(0.8, look.ground));
        if dot.is_now {
            painter.circle_stroke(*place, radius + 2.5, Stroke::new(1.8, look.playhead));
        }
    }
}

/// Whether two points are far enough apart in the window for a line between them.
fn is_apart(a: Pos2, b: Pos2) -> bool {
    (a - b).length_sq() > Vec2::splat(0.5).length_sq()
}
