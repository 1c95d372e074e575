//! The figure (人物): a mannequin with volume and a face, or sticks, as shapes sorted from far to near.

mod mannequin;
mod outline;
mod sticks;

use glam::DVec3;

use crate::paper_point::Point;
use genga::knob::choices;
use genga::motion::seen::view::{View, extent};
use genga::motion::{Body, BodySide, Build, Clip, Point as Mark, Poser, Skeleton};
use mannequin::Mannequin;
pub(crate) use mannequin::{Line, Part, Solid};
use outline::outline;
use sticks::Sticks;

/// How figures are drawn (人物の描き方).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum FigureBody {
    /// A mannequin (デッサン人形), if the rig has a head, arms and legs; otherwise sticks. The default.
    #[default]
    Mannequin,
    /// Bones alone (棒人間).
    Sticks,
}

choices!(FigureBody { Mannequin: "mannequin", Sticks: "sticks" });

/// The figure of a clip, to be drawn in any pose. A pose is a list of points: the joints, the tips, then the
/// [marks](Figure::marks).
#[derive(Debug, Clone)]
pub struct Figure {
    form: Form,
    /// Bones that no part covers: parent joint, then joint or tip.
    guides: Vec<(usize, usize)>,
    /// Per joint, whether the part that it turns is drawn; `None` draws all.
    only: Option<Vec<bool>>,
    /// Per joint and tip, whether it only serves the rig and is never drawn. Points past the end are drawn.
    hidden: Vec<bool>,
    /// Height of the body in its first pose, in units of the file.
    pub height: f64,
}

#[derive(Debug, Clone)]
enum Form {
    Mannequin(Box<Mannequin>),
    Sticks(Sticks),
}

/// A line on paper, in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Start point.
    pub from: Point,
    /// End point.
    pub to: Point,
    /// Width of the line.
    pub width: f64,
    /// Part of the figure that it belongs to, which sets the colour.
    pub ink: Ink,
}

/// What a stroke belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// The body, in the colour of its side.
    Side(BodySide),
    /// Something outside the body: a root on the floor, a tail.
    Guide,
}

/// A piece of a figure on paper, in px.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A stroke.
    Line(Stroke),
    /// A part with volume, as a filled outline.
    Part {
        /// Corners of the outline.
        outline: Vec<Point>,
        /// Width of the edge.
        width: f64,
        /// Side of the body.
        side: BodySide,
    },
    /// The head of a stick figure: centre and radius.
    Ring(Point, f64),
    /// A body without bones.
    Dot(Point),
}

/// A figure on paper, from the far to the near.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drawn {
    /// Shapes, the furthest first.
    pub shapes: Vec<Shape>,
}

impl Drawn {
    /// Maps every point through `place`.
    pub fn each_point(&mut self, place: impl Fn(Point) -> Point) {
        for shape in &mut self.shapes {
            match shape {
                Shape::Line(line) => (line.from, line.to) = (place(line.from), place(line.to)),
                Shape::Part { outline, .. } => {
                    outline.iter_mut().for_each(|point| *point = place(*point));
                }
                Shape::Ring(point, _) | Shape::Dot(point) => *point = place(*point),
            }
        }
    }
}

/// Figure height in px for which the line widths below are designed.
const MADE_FOR: f64 = 170.0;

/// Widths at that height, in px: of a guide, of a part's edge and of a line on a part.
const GUIDE: f64 = 1.0;
const EDGE: f64 = 1.35;
const DETAIL: f64 = 1.1;

impl Figure {
    /// Builds the figure of a clip of at least one frame and joint.
    pub fn new(clip: &Clip, body: FigureBody) -> Self {
        let mut standing = Body::new(clip.skeleton());
        standing.place(Poser::new(clip).frame(clip.first()));
        let build = Build::new(clip);
        let up = build.stature.up.unit();
        let shown = build.members.shown(clip.skeleton());
        let hidden: Vec<bool> = shown.into_iter().map(|shown| !shown).collect();
        let sticks = || {
            let sticks = Self::sticks(clip.skeleton(), standing.points(), up);
            sticks.without(hidden.clone(), standing.points(), up)
        };
        let mannequin = match body {
            FigureBody::Mannequin => Mannequin::new(clip, &build),
            FigureBody::Sticks => None,
        };
        let Some(mannequin) = mannequin else { return sticks() };
        let guides = bones(clip.skeleton()).filter(|(_, to)| !mannequin.covers(*to)).collect();
        let form = Form::Mannequin(Box::new(mannequin));
        let figure = Self { form, guides, only: None, hidden: Vec::new(), height: 0.0 };
        figure.without(hidden, standing.points(), up)
    }

    /// Hides some points, and measures the height again from those still shown in `pose`.
    fn without(mut self, hidden: Vec<bool>, pose: &[DVec3], up: DVec3) -> Self {
        self.hidden = hidden;
        let shown: Vec<DVec3> = self.shown(pose).copied().collect();
        self.height = extent(&shown).dot(up).abs();
        let is_shown = |point: &usize| !self.hidden[*point];
        self.guides.retain(|(from, to)| is_shown(from) && is_shown(to));
        if let Form::Sticks(sticks) = &mut self.form {
            sticks.bones.retain(|bone| is_shown(&bone.from) && is_shown(&bone.to));
        }
        self
    }

    /// Returns the points of a pose that a picture shows.
    pub fn shown<'a>(&'a self, pose: &'a [DVec3]) -> impl Iterator<Item = &'a DVec3> {
        let hidden = self.hidden.iter().copied().chain(std::iter::repeat(false));
        pose.iter().zip(hidden).filter(|(_, hidden)| !hidden).map(|(point, _)| point)
    }

    /// Builds a stick figure from a skeleton and its first pose; `up` is the direction up.
    pub fn sticks(skeleton: &Skeleton, first: &[DVec3], up: DVec3) -> Self {
        let height = extent(first).dot(up).abs();
        let (sticks, guides) = Sticks::from_skeleton(skeleton, first, height);
        Self { form: Form::Sticks(sticks), guides, only: None, hidden: Vec::new(), height }
    }

    /// Returns this figure with only the parts that some joints turn.
    #[cfg(feature = "images")]
    pub fn only(&self, joints: Vec<bool>) -> Self {
        Self { only: Some(joints), ..self.clone() }
    }

    /// Whether the part that a joint turns is drawn.
    fn shows(&self, joint: usize) -> bool {
        self.only.as_ref().is_none_or(|only| only[joint])
    }

    /// Returns the marks that a pose must list after its joints and tips.
    pub fn marks(&self) -> &[Mark] {
        match &self.form {
            Form::Mannequin(mannequin) => mannequin.marks(),
            Form::Sticks(_) => &[],
        }
    }

    /// Returns how far the figure reaches beyond the points of a pose, in units of the file.
    pub fn reach(&self, pose: &[DVec3]) -> f64 {
        match &self.form {
            Form::Mannequin(mannequin) => mannequin.reach(),
            Form::Sticks(sticks) => sticks.head_radius(pose, self.height),
        }
    }

    /// Returns the bones that no part covers: parent joint, then joint or tip.
    pub fn guides(&self) -> &[(usize, usize)] {
        &self.guides
    }

    /// Returns the bones of a stick figure (from, to, side) and its head (joint, end point). A mannequin has
    /// neither.
    pub fn bones(
        &self,
    ) -> (impl Iterator<Item = (usize, usize, BodySide)>, Option<(usize, usize)>) {
        let sticks = match &self.form {
            Form::Sticks(sticks) => Some(sticks),
            Form::Mannequin(_) => None,
        };
        let bones = sticks.into_iter().flat_map(|sticks| &sticks.bones);
        let head = sticks.and_then(|sticks| sticks.head);
        (bones.map(|bone| (bone.from, bone.to, bone.side)), head)
    }

    /// Returns the parts of a mannequin in a pose; `None` for sticks.
    pub(crate) fn solid(&self, pose: &[DVec3]) -> Option<Solid> {
        match &self.form {
            Form::Mannequin(mannequin) => Some(mannequin.solid(pose)),
            Form::Sticks(_) => None,
        }
    }

    /// Draws a pose: `at` maps a point of the world to the paper, `scale` is px per unit of the file.
    pub fn draw(
        &self,
        pose: &[DVec3],
        view: &View,
        scale: f64,
        at: impl Fn(DVec3) -> Point,
    ) -> Drawn {
        let size = self.line_size(scale);
        let guide = |(from, to): &(usize, usize)| {
            let (from, to) = (at(pose[*from]), at(pose[*to]));
            Shape::Line(Stroke { from, to, width: (GUIDE * size).max(0.6), ink: Ink::Guide })
        };
        let guides = self.guides.iter().filter(|(from, _)| self.shows(*from));
        let mut shapes: Vec<Shape> = guides.map(guide).collect();
        let shows = |joint: usize| self.shows(joint);
        match &self.form {
            Form::Mannequin(mannequin) => {
                draw_solid(&mannequin.solid(pose), shows, view, (scale, size), at, &mut shapes);
            }
            Form::Sticks(sticks) => {
                let scales = (scale, size, self.height);
                sticks.draw(pose, shows, view, scales, at, &mut shapes);
            }
        }
        Drawn { shapes }
    }

    /// Returns the factor of line widths, relative to a figure of height [`MADE_FOR`].
    fn line_size(&self, scale: f64) -> f64 {
        (scale * self.height / MADE_FOR).clamp(0.4, 3.0)
    }
}

/// Adds the parts of a mannequin, the furthest first, each followed by the lines on it.
fn draw_solid(
    solid: &Solid,
    shows: impl Fn(usize) -> bool,
    view: &View,
    (scale, size): (f64, f64),
    at: impl Fn(DVec3) -> Point,
    shapes: &mut Vec<Shape>,
) {
    let depth = |part: usize| solid.middle(part).dot(view.near) + solid.parts[part].nearer;
    let shown = (0..solid.parts.len()).filter(|part| shows(solid.parts[*part].joint));
    let mut order: Vec<usize> = shown.collect();
    order.sort_by(|a, b| depth(*a).total_cmp(&depth(*b)));
    for part in order {
        let side = solid.parts[part].side;
        let circles = solid.balls(part).iter().map(|ball| (at(ball.middle), ball.radius * scale));
        let circles: Vec<(Point, f64)> = circles.collect();
        shapes.push(Shape::Part {
            outline: outline(&circles),
            width: (EDGE * size).max(0.7),
            side,
        });
        for line in solid.lines.iter().filter(|line| line.part == part) {
            if solid.fronts[line.front].dot(view.near) < line.least {
                continue;
            }
            let (from, to) = (at(line.from), at(line.to));
            let (width, ink) = ((DETAIL * size).max(0.6), Ink::Side(side));
            shapes.push(Shape::Line(Stroke { from, to, width, ink }));
        }
    }
}

/// Returns the two ends of each bone as point indices: first the bones to joints, then those to tips.
pub fn bones(skeleton: &Skeleton) -> impl Iterator<Item = (usize, usize)> {
    let joints = skeleton.iter();
    let joints = joints.filter_map(|(joint, data)| Some((data.parent?.0, joint.0)));
    joints
        .chain(skeleton.owners().enumerate().skip(skeleton.len()).map(|(tip, joint)| (joint, tip)))
}

#[cfg(test)]
mod tests;
