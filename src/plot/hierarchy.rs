//! The hierarchy of a skeleton (階層構造) [KT11 Fig. 2]: its rest pose, and the tree of its joints.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::motion::Camera;
use crate::motion::{Body, BodySide, Clip, Skeleton};
use crate::plot::canvas::{Align, Canvas, Inks, Type};
use crate::plot::figure::Figure;
use crate::plot::page::{self, Head};
use crate::plot::px::Point;
use crate::plot::stage::{Bounds, Stage, fitting};
use crate::plot::style;

/// The hierarchy of a skeleton (階層構造): on the left the rest pose, each joint with its number, on the
/// right the tree of joints by number and name.
///
/// Where numbers would lie on each other, as on fingers, the figure shows only those with room.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SkeletonPlot {
    /// From where the rest pose is seen; default front. Auto looks where it is widest.
    pub camera: Camera,
    /// Height of the figure in px, 40 to 2000; default 400.
    pub figure_height: u32,
    /// Joints at most, from the root on, 1 to 1000; default 300. The picture says how many there are.
    pub most: usize,
}

impl Default for SkeletonPlot {
    fn default() -> Self {
        Self { camera: Camera::Front, figure_height: 400, most: 300 }
    }
}

/// Height of a line of the tree, and how far a child stands to the right of its parent, in px.
const LINE: f64 = 18.0;
const INDENT: f64 = 16.0;
/// How deep a child still moves to the right.
const DEEPEST: usize = 32;
/// Between the figure and the tree.
const GAP: f64 = 56.0;
/// Room round the figure for the numbers.
const PAD: f64 = 18.0;
/// The widest figure.
const WIDEST: f64 = 1200.0;

impl SkeletonPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn or no joint.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_figure(self.figure_height)?;
        style::check_count("most", self.most, style::MOST)
    }

    /// Draws the skeleton of a clip as SVG; `name` is the name on it.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`SkeletonPlot::validate`]; [`Error::Picture`] when there is no joint or no
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
        let bounds = Bounds::of(&figure, &view, &poses);
        let high = f64::from(self.figure_height);
        let size = (bounds.width(), bounds.top - bounds.floor);
        let scale = fitting(size, (WIDEST, high));
        let left = style::MARGIN + PAD;
        let wide = (bounds.width() * scale).max(40.0);
        let floor = page::HEAD + PAD + size.1 * scale;
        let stage =
            Stage { figure, view, scale, origin: (bounds.left, bounds.floor), at: (left, floor) };
        let shown = skeleton.len().min(self.most);
        let tree = Tree::of(skeleton, shown, left + wide + GAP);
        let width = (tree.right() + style::MARGIN).max(page::NARROWEST);
        let height = (floor + PAD).max(page::HEAD + LINE * shown as f64) + style::MARGIN;
        let mut canvas = Canvas::new((width, height));
        let title = "Skeleton 階層構造";
        Head { title, cut: name, facts: facts(skeleton, shown), page: (1, 1) }
            .draw(&mut canvas, width);
        canvas.figure(&stage.draw(&poses[0]), Inks::Faded(0.45));
        let places = poses[0].iter().map(|point| stage.place(*point)).collect::<Vec<_>>();
        numbers(&mut canvas, skeleton, &places[..shown]);
        tree.draw(&mut canvas);
        Ok(canvas.finish())
    }
}

/// The points of the rest pose: the joints, then the tips.
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

/// A dot a joint and its number beside it, as long as there is room.
fn numbers(canvas: &mut Canvas, skeleton: &Skeleton, places: &[Point]) {
    let mut taken: Vec<Point> = Vec::new();
    for ((id, joint), &(x, y)) in skeleton.iter().zip(places) {
        let side = BodySide::of(&joint.name);
        canvas.spot((x, y), 3.0, side.color());
        let from = joint.parent.and_then(|parent| places.get(parent.0)).copied().unwrap_or((x, y));
        // Beside the bone that leads here, outside the figure.
        let is_level = (x - from.0).abs() > (y - from.1).abs();
        let (middle, base) = match side {
            _ if is_level => (x, y - 8.0),
            BodySide::Right => (x - 13.0, y + 4.0),
            BodySide::Left | BodySide::Trunk => (x + 13.0, y + 4.0),
        };
        let is_free =
            |other: &Point| (other.0 - middle).abs() > 15.0 || (other.1 - base).abs() > 11.0;
        if taken.iter().all(is_free) {
            let look = Type::new(style::SMALL).bold().color(side.color()).align(Align::Center);
            canvas.text(&(id.0 + 1).to_string(), (middle, base), look);
            taken.push((middle, base));
        }
    }
}

/// The lines of the tree.
struct Tree<'a> {
    lines: Vec<Line<'a>>,
    left: f64,
}

struct Line<'a> {
    number: usize,
    name: &'a str,
    depth: usize,
    /// The line of the parent.
    parent: Option<usize>,
}

impl<'a> Tree<'a> {
    fn of(skeleton: &'a Skeleton, shown: usize, left: f64) -> Self {
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
        (x, page::HEAD + LINE * (line as f64 + 0.5))
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
            let color = BodySide::of(line.name).color();
            let look = Type::new(style::SMALL).bold().color(color).align(Align::Right);
            canvas.text(&line.number.to_string(), (self.left + 14.0, y + 4.0), look);
            canvas.text(&self.name(at), (x, y + 4.5), Type::new(style::WORDS).color(color));
        }
    }
}
