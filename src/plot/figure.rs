//! The stick figure (棒人間): bones, a head, how wide each line is and which lies in front.

use glam::DVec3;
use plotters::style::RGBColor;

use crate::motion::seen::view::View;
use crate::motion::{BodySide, Joint, Skeleton};
use crate::plot::px::Point;
use crate::plot::style;

impl BodySide {
    pub(crate) fn color(self) -> RGBColor {
        match self {
            Self::Left => style::LEFT,
            Self::Right => style::RIGHT,
            Self::Trunk => style::INK,
        }
    }
}

/// A line from one point of a pose to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Bone {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) side: BodySide,
}

/// What all figures of a clip have in common. A pose is its points: the joints, then the tips.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    pub(crate) bones: Vec<Bone>,
    /// The joint of the head and the point that ends it.
    pub(crate) head: Option<(usize, usize)>,
    /// The body's height in units of the file, as it stands in the first pose.
    pub(crate) height: f64,
}

/// A bone on paper, in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) from: Point,
    pub(crate) to: Point,
    pub(crate) width: f64,
    pub(crate) side: BodySide,
}

/// A figure on paper, in px.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drawn {
    /// From the far to the near.
    pub(crate) strokes: Vec<Stroke>,
    /// Middle and radius of the ring that is the head, in front of everything.
    pub(crate) head: Option<(Point, f64)>,
    /// What there is of a body without bones.
    pub(crate) dot: Option<Point>,
}

/// The figure height in px that the widths of the lines are made for.
const MADE_FOR: f64 = 170.0;

impl Figure {
    /// The figure of a skeleton that stands in a first pose, of which `up` is up.
    pub(crate) fn of(skeleton: &Skeleton, first: &[DVec3], up: DVec3) -> Self {
        let mut bones = Vec::new();
        for (joint, data) in skeleton.iter() {
            if let Some(parent) = data.parent {
                bones.push(Bone { from: parent.0, to: joint.0, side: BodySide::of(&data.name) });
            }
        }
        let mut tip = skeleton.len();
        for (joint, data) in skeleton.iter() {
            for _ in &data.end_sites {
                bones.push(Bone { from: joint.0, to: tip, side: BodySide::of(&data.name) });
                tip += 1;
            }
        }
        let is_head = |joint: &Joint| joint.name.to_lowercase().contains("head");
        let head = skeleton.joints.iter().position(is_head);
        let end = |joint: usize| bones.iter().find(|bone| bone.from == joint).map(|bone| bone.to);
        let head = head.map(|joint| (joint, end(joint).unwrap_or(joint)));
        let height = crate::motion::seen::view::extent(first).dot(up).abs();
        Self { bones, head, height }
    }

    /// The radius of the head in units of the file.
    pub(crate) fn head_radius(&self, pose: &[DVec3]) -> f64 {
        let length = self.head.map_or(0.0, |(joint, end)| (pose[end] - pose[joint]).length());
        (0.55 * length).clamp(0.045 * self.height, 0.085 * self.height)
    }

    /// A pose on paper: `at` says where a point comes, `scale` is px for a unit of the file.
    pub(crate) fn draw(
        &self,
        pose: &[DVec3],
        view: &View,
        scale: f64,
        at: impl Fn(DVec3) -> Point,
    ) -> Drawn {
        let depth = |bone: &&Bone| view.see(pose[bone.from] + pose[bone.to]).2;
        let mut bones: Vec<&Bone> = self.bones.iter().collect();
        bones.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        let stroke = |bone: &Bone| {
            let (from, to) = (pose[bone.from], pose[bone.to]);
            let width = self.width(bone.side, (to - from).length(), scale);
            Stroke { from: at(from), to: at(to), width, side: bone.side }
        };
        let head = self.head.map(|(joint, end)| {
            (at(0.5 * (pose[joint] + pose[end])), self.head_radius(pose) * scale)
        });
        let dot = self.bones.is_empty().then(|| at(pose[0]));
        Drawn { strokes: bones.into_iter().map(stroke).collect(), head, dot }
    }

    /// px: the trunk is thick, fingers and toes are thin.
    fn width(&self, side: BodySide, length: f64, scale: f64) -> f64 {
        let size = (scale * self.height / MADE_FOR).clamp(0.4, 3.0);
        let width = match side {
            BodySide::Trunk => 5.0,
            _ if length < 0.035 * self.height => 1.5,
            _ => 3.25,
        };
        (width * size).max(1.0)
    }
}
