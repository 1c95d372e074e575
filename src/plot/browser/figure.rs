//! The figure as the page draws it: numbers of points, and what is between them.

use glam::DVec3;
use serde::Serialize;

use crate::motion::BodySide;
use crate::plot::figure::{Figure, Line, Part};

/// What all figures of a page have in common. Sides: 0 trunk, 1 left, 2 right.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct PageFigure {
    /// Bones of a stick figure: from, to, side.
    bones: Vec<[usize; 3]>,
    /// Joint and end of its head.
    #[serde(skip_serializing_if = "Option::is_none")]
    head: Option<(usize, usize)>,
    /// Thin lines to what is no part of the body: from, to.
    guides: Vec<[usize; 2]>,
    /// Parts of a lay figure: its first ball, how many, side, and by how many steps it counts as nearer.
    parts: Vec<(usize, usize, usize, i32)>,
    /// The number of the first ball among the points, and the radius of each in steps.
    balls: usize,
    radii: Vec<i32>,
    /// Lines on parts: from, to, part, front, and the least that the front looks at whoever looks, in thousandths.
    lines: Vec<(usize, usize, usize, usize, i32)>,
}

impl PageFigure {
    /// Of a pose; `unit` is the length of a step.
    pub(crate) fn of(figure: &Figure, pose: &[DVec3], unit: f64) -> Self {
        let guides = figure.guides();
        let Some(solid) = figure.solid(pose) else {
            let (bones, head) = figure.bones();
            return Self {
                bones: bones.map(|(from, to, of)| [from, to, side(of)]).collect(),
                head,
                guides: guides.iter().map(|(from, to)| [*from, *to]).collect(),
                parts: vec![],
                balls: 0,
                radii: vec![],
                lines: vec![],
            };
        };
        let balls = 1 + 2 * guides.len();
        let first_end = balls + solid.balls.len();
        let line = |(at, line): (usize, &Line)| {
            let from = first_end + 2 * at;
            (from, from + 1, line.part, line.front, (line.least * 1000.0).round() as i32)
        };
        let part = |part: &Part| {
            let nearer = (part.nearer / unit).round() as i32;
            (part.balls.start, part.balls.len(), side(part.side), nearer)
        };
        Self {
            bones: vec![],
            head: None,
            guides: (0..guides.len()).map(|guide| [1 + 2 * guide, 2 + 2 * guide]).collect(),
            parts: solid.parts.iter().map(part).collect(),
            balls,
            radii: solid.balls.iter().map(|ball| (ball.radius / unit).round() as i32).collect(),
            lines: solid.lines.iter().enumerate().map(line).collect(),
        }
    }
}

/// The points of a pose that the page gets, the root first. Of sticks joints and tips; of a lay figure the ends of guides,
/// the middles of balls and the ends of lines.
pub(in crate::plot) fn points(figure: &Figure, pose: &[DVec3]) -> Vec<DVec3> {
    let Some(solid) = figure.solid(pose) else { return pose.to_vec() };
    let guides = figure.guides().iter().flat_map(|(from, to)| [pose[*from], pose[*to]]);
    let balls = solid.balls.iter().map(|ball| ball.middle);
    let ends = solid.lines.iter().flat_map(|line| [line.from, line.to]);
    [pose[0]].into_iter().chain(guides).chain(balls).chain(ends).collect()
}

/// Where face, chest and hips look; nothing of sticks.
pub(super) fn fronts(figure: &Figure, pose: &[DVec3]) -> Vec<DVec3> {
    figure.solid(pose).map(|solid| solid.fronts.to_vec()).unwrap_or_default()
}

fn side(side: BodySide) -> usize {
    match side {
        BodySide::Trunk => 0,
        BodySide::Left => 1,
        BodySide::Right => 2,
    }
}
