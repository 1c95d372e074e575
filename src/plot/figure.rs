//! The figure (人物): a lay figure with volume and a face, or sticks, as shapes from the far to the near.

mod dummy;
mod outline;
mod sticks;

use glam::DVec3;
use plotters::style::RGBColor;

use crate::knob::choices;
use crate::motion::seen::view::{View, extent};
use crate::motion::{Body, BodySide, Build, Clip, Point as Mark, Poser, Skeleton};
use crate::plot::px::Point;
use crate::plot::style;
use dummy::Dummy;
pub(crate) use dummy::{Line, Part, Solid};
use outline::outline;
use sticks::Sticks;

/// How figures are drawn (人物の描き方).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum FigureBody {
    /// A lay figure (デッサン人形), where a rig has head, arms and legs; the default.
    #[default]
    Mannequin,
    /// Bones alone (棒人間).
    Sticks,
}

choices!(FigureBody { Mannequin: "mannequin", Sticks: "sticks" });

impl BodySide {
    pub(crate) fn color(self) -> RGBColor {
        match self {
            Self::Left => style::LEFT,
            Self::Right => style::RIGHT,
            Self::Trunk => style::INK,
        }
    }
}

/// What all figures of a clip have in common. A pose is its points: the joints, the tips, then the
/// [marks](Figure::marks).
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    form: Form,
    /// Joints or tips that no part covers, each with what it hangs on.
    guides: Vec<(usize, usize)>,
    /// Of each joint whether what it turns is drawn; all where nothing is said.
    only: Option<Vec<bool>>,
    /// Joints and tips that a rig has for itself, and that are in no picture: all behind the end are seen.
    hidden: Vec<bool>,
    /// The body's height in units of the file, as it stands in the first pose.
    pub(crate) height: f64,
}

#[derive(Debug, Clone)]
enum Form {
    Mannequin(Box<Dummy>),
    Sticks(Sticks),
}

/// A line on paper, in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) from: Point,
    pub(crate) to: Point,
    pub(crate) width: f64,
    pub(crate) ink: Ink,
}

/// Of what a line is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ink {
    Side(BodySide),
    /// What is no part of the body: a root on the floor, a tail.
    Guide,
}

/// A piece of a figure on paper, in px.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shape {
    Line(Stroke),
    /// A part with volume: its outline, and how wide that is.
    Part {
        outline: Vec<Point>,
        width: f64,
        side: BodySide,
    },
    /// The head of a stick figure: middle and radius.
    Ring(Point, f64),
    /// What there is of a body without bones.
    Dot(Point),
}

/// A figure on paper, from the far to the near.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Drawn {
    pub(crate) shapes: Vec<Shape>,
}

impl Drawn {
    /// Puts every point elsewhere.
    #[cfg(feature = "panels")]
    pub(crate) fn each_point(&mut self, place: impl Fn(Point) -> Point) {
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

/// The figure height in px that the widths of the lines are made for.
const MADE_FOR: f64 = 170.0;

/// px of a guide, of an outline and of a line on a part, at that height.
const GUIDE: f64 = 1.0;
const EDGE: f64 = 1.35;
const DETAIL: f64 = 1.1;

impl Figure {
    /// The figure of a clip of at least one frame and joint.
    pub(crate) fn of(clip: &Clip, body: FigureBody) -> Self {
        let mut standing = Body::new(clip.skeleton());
        standing.place(Poser::of(clip).frame(clip.first()));
        let build = Build::of(clip);
        let up = build.stature.up.unit();
        let shown = build.members.shown(clip.skeleton());
        let hidden: Vec<bool> = shown.into_iter().map(|shown| !shown).collect();
        let sticks = || {
            let sticks = Self::sticks(clip.skeleton(), standing.points(), up);
            sticks.without(hidden.clone(), standing.points(), up)
        };
        let dummy = match body {
            FigureBody::Mannequin => Dummy::of(clip, &build),
            FigureBody::Sticks => None,
        };
        let Some(dummy) = dummy else { return sticks() };
        let guides = bones(clip.skeleton()).filter(|(_, to)| !dummy.covers(*to)).collect();
        let form = Form::Mannequin(Box::new(dummy));
        let figure = Self { form, guides, only: None, hidden: Vec::new(), height: 0.0 };
        figure.without(hidden, standing.points(), up)
    }

    /// The same without some points, as high as the others are in a pose.
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

    /// The points of a pose that are in a picture.
    pub(crate) fn shown<'a>(&'a self, pose: &'a [DVec3]) -> impl Iterator<Item = &'a DVec3> {
        let hidden = self.hidden.iter().copied().chain(std::iter::repeat(false));
        pose.iter().zip(hidden).filter(|(_, hidden)| !hidden).map(|(point, _)| point)
    }

    /// Sticks for a skeleton that stands in a first pose, of which `up` is up.
    pub(crate) fn sticks(skeleton: &Skeleton, first: &[DVec3], up: DVec3) -> Self {
        let height = extent(first).dot(up).abs();
        let (sticks, guides) = Sticks::of(skeleton, first, height);
        Self { form: Form::Sticks(sticks), guides, only: None, hidden: Vec::new(), height }
    }

    /// The same figure, of which only what some joints turn is drawn.
    #[cfg(feature = "pictures")]
    pub(crate) fn only(&self, joints: Vec<bool>) -> Self {
        Self { only: Some(joints), ..self.clone() }
    }

    /// Whether what a joint turns is drawn.
    fn shows(&self, joint: usize) -> bool {
        self.only.as_ref().is_none_or(|only| only[joint])
    }

    /// What a pose has to have behind its joints and tips.
    pub(crate) fn marks(&self) -> &[Mark] {
        match &self.form {
            Form::Mannequin(dummy) => dummy.marks(),
            Form::Sticks(_) => &[],
        }
    }

    /// How far the figure reaches beyond the points of a pose, in units of the file.
    pub(crate) fn reach(&self, pose: &[DVec3]) -> f64 {
        match &self.form {
            Form::Mannequin(dummy) => dummy.reach(),
            Form::Sticks(sticks) => sticks.head_radius(pose, self.height),
        }
    }

    /// Joints or tips that no part covers, each with what it hangs on.
    pub(crate) fn guides(&self) -> &[(usize, usize)] {
        &self.guides
    }

    /// The bones of sticks, from what to what and of which side, and joint and end of their head; nothing of a lay figure.
    pub(crate) fn bones(
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

    /// The parts of a lay figure in a pose; none of sticks.
    pub(crate) fn solid(&self, pose: &[DVec3]) -> Option<Solid> {
        match &self.form {
            Form::Mannequin(dummy) => Some(dummy.solid(pose)),
            Form::Sticks(_) => None,
        }
    }

    /// A pose on paper: `at` says where a point comes, `scale` is px for a unit of the file.
    pub(crate) fn draw(
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
            Form::Mannequin(dummy) => {
                draw_solid(&dummy.solid(pose), shows, view, (scale, size), at, &mut shapes);
            }
            Form::Sticks(sticks) => {
                let scales = (scale, size, self.height);
                sticks.draw(pose, shows, view, scales, at, &mut shapes);
            }
        }
        Drawn { shapes }
    }

    /// How many times as wide lines are as in a figure of the height that they are made for.
    fn line_size(&self, scale: f64) -> f64 {
        (scale * self.height / MADE_FOR).clamp(0.4, 3.0)
    }
}

/// The parts of a lay figure, the furthest first, each with the lines on it.
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

/// From what to what each bone goes, in the numbers of points: to joints first, then to tips.
pub(crate) fn bones(skeleton: &Skeleton) -> impl Iterator<Item = (usize, usize)> {
    let joints = skeleton.iter();
    let joints = joints.filter_map(|(joint, data)| Some((data.parent?.0, joint.0)));
    joints
        .chain(skeleton.owners().enumerate().skip(skeleton.len()).map(|(tip, joint)| (joint, tip)))
}

#[cfg(test)]
mod tests;
