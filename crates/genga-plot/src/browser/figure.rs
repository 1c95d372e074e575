//! Converts a figure to the data from which the page draws it: point indices and the shapes between them.

use glam::DVec3;
use serde::Serialize;

use crate::figure::{Figure, Line, Part};
use genga::motion::BodySide;

/// Data that all figures of a page share. Sides: 0 trunk, 1 left, 2 right.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct PageFigure {
    /// Bones of a stick figure: from, to, side.
    bones: Vec<[usize; 3]>,
    /// Joint and end point of the stick figure's head.
    #[serde(skip_serializing_if = "Option::is_none")]
    head: Option<(usize, usize)>,
    /// Guides, thin lines to points outside the body: from, to.
    guides: Vec<[usize; 2]>,
    /// Parts of a mannequin: first ball, number of balls, side, and depth offset in steps (positive is
    /// nearer).
    parts: Vec<(usize, usize, usize, i32)>,
    /// Index of the first ball among the points.
    balls: usize,
    /// Radius of each ball, in steps.
    radii: Vec<i32>,
    /// Lines on parts: from, to, part, front, and the minimum cosine between the front and the viewer, in
    /// thousandths.
    lines: Vec<(usize, usize, usize, usize, i32)>,
}

impl PageFigure {
    /// Builds the data of a figure in a pose; `unit` is the length of a step.
    pub(crate) fn new(figure: &Figure, pose: &[DVec3], unit: f64) -> Self {
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

/// Returns the points of a pose that the page gets, the root first. Sticks have joints and tips. A mannequin
/// has the ends of guides, the middles of balls and the ends of lines.
pub(crate) fn points(figure: &Figure, pose: &[DVec3]) -> Vec<DVec3> {
    let Some(solid) = figure.solid(pose) else { return pose.to_vec() };
    let guides = figure.guides().iter().flat_map(|(from, to)| [pose[*from], pose[*to]]);
    let balls = solid.balls.iter().map(|ball| ball.middle);
    let ends = solid.lines.iter().flat_map(|line| [line.from, line.to]);
    [pose[0]].into_iter().chain(guides).chain(balls).chain(ends).collect()
}

/// Returns the directions in which face, chest and hips look; empty for sticks.
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
