//! Trails (軌跡): where chosen joints go, with a dot at every koma of the source and every drawing of the
//! result. Where dots stand close it is slow: spacing can be seen.

use egui::{Painter, Pos2, Shape, Stroke, Vec2};

use super::orbit::placed;
use crate::motion::Skeleton;
use crate::plot::parts::{Posing, Stage, bones};
use crate::sheet::{Role, Source};
use crate::studio::command::Seen;
use crate::studio::shown::Shown;

/// Koma before and after the play head.
const REACH: usize = 24;

/// A point of a trail.
struct Dot {
    source: Source,
    /// Of a drawing; koma of the source have none.
    role: Option<Role>,
    is_now: bool,
}

/// Draws the trails of the chosen joints.
pub(super) fn draw(
    painter: &Painter,
    stage: &Stage,
    posing: &mut Posing<'_>,
    seen: Seen,
    shown: &Shown<'_>,
) {
    if shown.joints.is_empty() {
        return;
    }
    let dots = dots(seen, shown);
    let poses = posing.all(dots.iter().map(|dot| dot.source));
    for joint in shown.joints {
        let point = turned(shown.breakdown.source.skeleton(), joint.0);
        let places: Vec<Pos2> = poses.iter().map(|pose| placed(stage, pose[point])).collect();
        path(painter, &places, &dots, shown);
    }
}

/// What a joint turns: the end of its own bone. The joint itself stays where it is when it turns.
fn turned(skeleton: &Skeleton, joint: usize) -> usize {
    bones(skeleton).find(|(from, _)| *from == joint).map_or(joint, |(_, to)| to)
}

fn dots(seen: Seen, shown: &Shown<'_>) -> Vec<Dot> {
    let column = &shown.column;
    let from = shown.at.saturating_sub(REACH);
    let past = (shown.at + REACH + 1).min(column.length);
    if seen == Seen::Source {
        let source = |koma| Source::At(column.clock.place_from_koma(koma));
        let dot = |koma| Dot { source: source(koma), role: None, is_now: koma == shown.at };
        return (from..past).map(dot).collect();
    }
    let now = column.at(shown.at);
    let dot = |at: usize| {
        let drawing = column.cells[at].drawing;
        Dot { source: drawing.source, role: Some(drawing.role), is_now: at == now }
    };
    (column.at(from)..=column.at(past - 1)).map(dot).collect()
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

/// How far apart two points of the window are drawn for the same koma: nothing is drawn twice in one place.
fn is_apart(a: Pos2, b: Pos2) -> bool {
    (a - b).length_sq() > Vec2::splat(0.5).length_sq()
}
