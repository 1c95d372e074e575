//! Draws the hierarchy of a skeleton (階層構造) [KT11 Fig. 2]: its rest pose, and the tree of its joints.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Inks, Type};
use crate::figure::Figure;
use crate::legend::SIDES;
use crate::page_head::{self, Head};
use crate::paper_point::Point;
use crate::stage::{Bounds, Stage, fitting};
use crate::style;
use genga::error::Error;
use genga::motion::Camera;
use genga::motion::{Body, BodySide, Clip, Skeleton};

/// The hierarchy of a skeleton (階層構造). On the left is the rest pose with a number at each joint, on the right
/// the tree of joints by number and name.
///
/// Numbers that would overlap in the figure, as on fingers, are left out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SkeletonPlot {
    /// Camera of the rest pose; default front. Auto takes the side on which it is widest.
    pub camera: Camera,
    /// Height of the figure in px, 40 to 2000; default 400.
    pub figure_height: u32,
    /// Maximum number of joints, counted from the root, 1 to 1000; default 300. The picture says how many
    /// there are.
    pub most: usize,
}

impl Default for SkeletonPlot {
    fn default() -> Self {
        Self { camera: Camera::Front, figure_height: 400, most: 300 }
    }
}

/// Height of a line of the tree, and indent of a child against its parent, in px.
const LINE: f64 = 18.0;
const INDENT: f64 = 16.0;
/// Maximum depth at which a child is still indented.
const DEEPEST: usize = 32;
/// Space between the figure and the tree, in px.
const GAP: f64 = 56.0;
/// Space round the figure for the numbers, in px.
const PAD: f64 = 18.0;
/// Width that the figure has at least beside a wide tree, in px.
const NARROW: f64 = 240.0;

impl SkeletonPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the size or the number of joints is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_figure(self.figure_height)?;
        style::check_count("most", self.most, style::MOST)
    }

    /// Draws the skeleton of a clip as SVG; `name` is the name printed on it.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`SkeletonPlot::validate`]; [`Error::Picture`] if there is no joint or no
    /// frame.
    pub fn draw(&self, name: &str, clip: &Clip) -> Result<String, Error> {
        self.validate()?;
        let skeleton = clip.skeleton();
        if clip.is_empty() || skeleton.is_empty() {
            return Err(style::cannot("a clip without frames or joints has no skeleton to draw"));
        }
        let poses = [rest(skeleton)];
        let view = self.camera.view(clip, &poses);
        let figure = Figure::sticks(skeleton, &poses[0], view.up);
        let bounds = Bounds::new(&figure, &view, &poses);
        let high = f64::from(self.figure_height);
        let size = (bounds.width(), bounds.top - bounds.floor);
        let left = style::MARGIN + PAD;
        let shown = skeleton.len().min(self.most);
        let tree = Tree::new(skeleton, shown, 0.0).right();
        let room = f64::from(style::WIDTH) - left - GAP - tree - style::MARGIN;
        let scale = fitting(size, (room.max(NARROW), high));
        let wide = (bounds.width() * scale).max(40.0);
        let floor = page_head::HEAD + PAD + size.1 * scale;
        let stage =
            Stage { figure, view, scale, origin: (bounds.left, bounds.floor), at: (left, floor) };
        let tree = Tree::new(skeleton, shown, left + wide + GAP);
        let width = (tree.right() + style::MARGIN).max(page_head::NARROWEST);
        let height = (floor + PAD).max(page_head::HEAD + LINE * shown as f64) + style::MARGIN;
        let mut canvas = Canvas::new((width, height));
        let title = "Skeleton 階層構造";
        let facts = facts(skeleton, shown);
        Head { title, cut: name, facts, legend: &SIDES, page: (1, 1) }.draw(&mut canvas, width);
        canvas.figure(&stage.draw(&poses[0]), Inks::Faded(0.45));
        let places = poses[0].iter().map(|point| stage.place(*point)).collect::<Vec<_>>();
        numbers(&mut canvas, skeleton, &places[..shown]);
        tree.draw(&mut canvas);
        Ok(canvas.finish())
    }
}

/// Returns the points of the rest pose: the joints, then the tips.
fn rest(skeleton: &Skeleton) -> Vec<DVec3> {
    Body::new(skeleton).points().to_vec()
}

fn facts(skeleton: &Skeleton, shown: usize) -> String {
    let count =
        |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let tips = skeleton.joints.iter().map(|joint| joint.end_sites.len()).sum();
    let mut facts = [
        count(skeleton.len(), "joint") + " 関節",
        count(tips, "end site"),
        count(skeleton.channels(), "channel"),
        "rest pose 基準姿勢".to_owned(),
    ]
    .join(" · ");
    if shown < skeleton.len() {
        facts.push_str(&format!(" · the first {shown} shown"));
    }
    facts
}

/// Draws a dot at each joint with its number beside it. Numbers without room are left out.
fn numbers(canvas: &mut Canvas, skeleton: &Skeleton, places: &[Point]) {
    let mut taken: Vec<(Point, f64)> = Vec::new();
    for ((id, joint), &(x, y)) in skeleton.iter().zip(places) {
        let side = BodySide::from_name(&joint.name);
        canvas.spot((x, y), 3.0, style::side_color(side));
        let from = joint.parent.and_then(|parent| places.get(parent.0)).copied().unwrap_or((x, y));
        // The number stands beside the bone that leads here, outside the figure.
        let is_level = (x - from.0).abs() > (y - from.1).abs();
        let (middle, base) = match side {
            _ if is_level => (x, y - 8.0),
            BodySide::Right => (x - 13.0, y + 4.0),
            BodySide::Left | BodySide::Trunk => (x + 13.0, y + 4.0),
        };
        let number = (id.0 + 1).to_string();
        let wide = style::BOLDER * style::text_width(&number, style::SMALL);
        let is_free = |(other, wider): &(Point, f64)| {
            (other.0 - middle).abs() > 0.5 * (wide + wider) + 1.0 || (other.1 - base).abs() > 11.0
        };
        if taken.iter().all(is_free) {
            let look =
                Type::new(style::SMALL).bold().color(style::side_color(side)).align(Align::Center);
            canvas.text(&number, (middle, base), look);
            taken.push(((middle, base), wide));
        }
    }
}

/// The tree of joints, as lines of text.
struct Tree<'a> {
    lines: Vec<Line<'a>>,
    left: f64,
}

struct Line<'a> {
    number: usize,
    name: &'a str,
    depth: usize,
    /// Index of the parent's line.
    parent: Option<usize>,
}

impl<'a> Tree<'a> {
    fn new(skeleton: &'a Skeleton, shown: usize, left: f64) -> Self {
        let mut lines: Vec<Line<'a>> = Vec::with_capacity(shown);
        for (joint, data) in skeleton.iter().take(shown) {
            let parent = data.parent.map(|parent| parent.0);
            let depth = parent.map_or(0, |parent| (lines[parent].depth + 1).min(DEEPEST));
            lines.push(Line { number: joint.0 + 1, name: &data.name, depth, parent });
        }
        Self { lines, left }
    }

    fn at(&self, line: usize) -> Point {
        let x = self.left + 30.0 + INDENT * self.lines[line].depth as f64;
        (x, page_head::HEAD + LINE * (line as f64 + 0.5))
    }

    fn right(&self) -> f64 {
        let end = |line: usize| self.at(line).0 + style::text_width(&self.name(line), style::WORDS);
        (0..self.lines.len()).map(end).fold(0.0, f64::max) + 12.0
    }

    fn name(&self, line: usize) -> String {
        style::fitted(self.lines[line].name, style::WORDS, 360.0)
    }

    fn draw(&self, canvas: &mut Canvas) {
        for (at, line) in self.lines.iter().enumerate() {
            let (x, y) = self.at(at);
            if let Some(parent) = line.parent {
                let above = self.at(parent);
                let stem = (above.0 + 5.0).min(x - 5.0);
                canvas.path(&[(stem, above.1 + 7.0), (stem, y), (x - 3.0, y)], style::RAW, 1.0);
            }
        }
        for (at, line) in self.lines.iter().enumerate() {
            let (x, y) = self.at(at);
            let color = style::side_color(BodySide::from_name(line.name));
            let look = Type::new(style::SMALL).bold().color(color).align(Align::Right);
            canvas.text(&line.number.to_string(), (self.left + 14.0, y + 4.0), look);
            canvas.text(&self.name(at), (x, y + 4.5), Type::new(style::WORDS).color(color));
        }
    }
}
