//! Where the joints and the tips of the bones are in a drawing.

use glam::DVec3;

use crate::motion::{Body, Clip, Composite, DrawnPose, Pose, PosedComposite, Skeleton};
use crate::sheet::Source;

/// Turns sources into poses: the joints in their order, then the tips in the order of their joints.
pub(crate) struct Posing<'a> {
    drawn: DrawnPose<'a>,
    body: Body,
}

impl<'a> Posing<'a> {
    /// For a clip of at least one frame.
    pub(crate) fn of(clip: &'a Clip) -> Self {
        Self { drawn: DrawnPose::of(clip), body: Body::new(clip.skeleton()) }
    }

    /// The points of a drawing, in the file's unit.
    pub(crate) fn points(&mut self, source: Source) -> Vec<DVec3> {
        self.drawn.take(source);
        points(&mut self.body, self.drawn.pose(), self.drawn.clip().skeleton())
    }

    /// The points of several drawings.
    pub(crate) fn all(&mut self, sources: impl IntoIterator<Item = Source>) -> Vec<Vec<DVec3>> {
        sources.into_iter().map(|source| self.points(source)).collect()
    }
}

/// Turns what is on screen into poses, as [`Posing`] does with sources.
pub(super) struct Showing<'a> {
    composite: &'a Composite<'a>,
    posed: PosedComposite<'a>,
    body: Body,
}

impl<'a> Showing<'a> {
    pub(super) fn of(composite: &'a Composite<'a>) -> Self {
        let body = Body::new(composite.clip().skeleton());
        Self { composite, posed: PosedComposite::of(composite), body }
    }

    /// The points of a drawing as it is on screen on a koma.
    pub(super) fn points(&mut self, drawing: usize, koma: usize) -> Vec<DVec3> {
        self.posed.take(drawing, koma);
        points(&mut self.body, self.posed.pose(), self.composite.clip().skeleton())
    }
}

fn points(body: &mut Body, pose: &Pose, skeleton: &Skeleton) -> Vec<DVec3> {
    let mut points = vec![DVec3::ZERO; skeleton.len()];
    body.place(pose, &mut points);
    for (joint, data) in skeleton.iter() {
        let (middle, rotation) = (points[joint.0], body.rotations()[joint.0]);
        points.extend(data.end_sites.iter().map(|end| middle + rotation * end.offset));
    }
    points
}
