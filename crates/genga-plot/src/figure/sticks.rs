//! The stick figure (棒人間): bones and a head, with the width and the depth order of each line.

use glam::DVec3;

use super::{Ink, Shape, Stroke, bones};
use crate::paper_point::Point;
use genga::motion::seen::view::View;
use genga::motion::{BodySide, Joint, JointId, Skeleton};

/// Length in body heights above which a root's only bone is no part of the body: a game's root on the floor.
const LONG: f64 = 0.3;

/// A bone, as the indices of its two points in a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bone {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) side: BodySide,
}

/// Bones and a head.
#[derive(Debug, Clone)]
pub(super) struct Sticks {
    pub(super) bones: Vec<Bone>,
    /// Joint of the head and the point that ends it, if there is a head.
    pub(super) head: Option<(usize, usize)>,
}

impl Sticks {
    /// Builds the sticks of a skeleton from its first pose; also returns the bones that are guides.
    pub(super) fn from_skeleton(
        skeleton: &Skeleton,
        first: &[DVec3],
        height: f64,
    ) -> (Self, Vec<(usize, usize)>) {
        let floor = on_floor(skeleton, first, height);
        let (guides, own): (Vec<_>, Vec<_>) = bones(skeleton).partition(|(_, to)| *to == floor);
        let side = |point: usize| {
            let joint = point < skeleton.len();
            joint.then(|| BodySide::from_name(&skeleton.joints[point].name))
        };
        let bone = |(from, to): (usize, usize)| {
            let side = side(to).or_else(|| side(from)).unwrap_or(BodySide::Trunk);
            Bone { from, to, side }
        };
        let bones: Vec<Bone> = own.into_iter().map(bone).collect();
        let is_head = |joint: &Joint| joint.name.to_lowercase().contains("head");
        let head = skeleton.joints.iter().position(is_head);
        let end = |joint: usize| bones.iter().find(|bone| bone.from == joint).map(|bone| bone.to);
        let head = head.map(|joint| (joint, end(joint).unwrap_or(joint)));
        (Self { bones, head }, guides)
    }

    /// Returns the radius of the head, in units of the file.
    pub(super) fn head_radius(&self, pose: &[DVec3], height: f64) -> f64 {
        let length = self.head.map_or(0.0, |(joint, end)| (pose[end] - pose[joint]).length());
        (0.55 * length).clamp(0.045 * height, 0.085 * height)
    }

    /// Adds the shapes of a pose, given px per unit of the file, the factor of line widths and the body's
    /// height.
    pub(super) fn draw(
        &self,
        pose: &[DVec3],
        shows: impl Fn(usize) -> bool,
        view: &View,
        (scale, size, height): (f64, f64, f64),
        at: impl Fn(DVec3) -> Point,
        shapes: &mut Vec<Shape>,
    ) {
        let depth = |bone: &&Bone| view.see(pose[bone.from] + pose[bone.to]).2;
        let mut bones: Vec<&Bone> = self.bones.iter().filter(|bone| shows(bone.from)).collect();
        bones.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        shapes.extend(bones.into_iter().map(|bone| {
            let (from, to) = (pose[bone.from], pose[bone.to]);
            let width = (width(bone.side, (to - from).length(), height) * size).max(1.0);
            Shape::Line(Stroke { from: at(from), to: at(to), width, ink: Ink::Side(bone.side) })
        }));
        shapes.extend(self.head.filter(|(joint, _)| shows(*joint)).map(|(joint, end)| {
            let middle = at(0.5 * (pose[joint] + pose[end]));
            Shape::Ring(middle, self.head_radius(pose, height) * scale)
        }));
        if self.bones.is_empty() {
            shapes.push(Shape::Dot(at(pose[0])));
        }
    }
}

/// Returns the width of a bone in px: the trunk is thick, fingers and toes are thin.
fn width(side: BodySide, length: f64, height: f64) -> f64 {
    match side {
        BodySide::Trunk => 5.0,
        _ if length < 0.035 * height => 1.5,
        _ => 3.25,
    }
}

/// Returns the joint above a root that stands on the floor, as in games; otherwise 0, the root itself, to
/// which no bone leads.
fn on_floor(skeleton: &Skeleton, first: &[DVec3], height: f64) -> usize {
    let hangs_on_root = |(_, data): &(JointId, &Joint)| data.parent == Some(JointId(0));
    let mut children = skeleton.iter().filter(hangs_on_root);
    match (children.next(), children.next()) {
        (Some((joint, _)), None) if first[joint.0].distance(first[0]) > LONG * height => joint.0,
        _ => 0,
    }
}
