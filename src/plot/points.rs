//! Where the joints and the tips of the bones are in a drawing.

use glam::DVec3;

use crate::motion::{Body, Clip, DrawnPose};
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
        let skeleton = self.drawn.clip().skeleton();
        let mut points = vec![DVec3::ZERO; skeleton.len()];
        self.body.place(self.drawn.pose(), &mut points);
        for (joint, data) in skeleton.iter() {
            let (middle, rotation) = (points[joint.0], self.body.rotations()[joint.0]);
            points.extend(data.end_sites.iter().map(|end| middle + rotation * end.offset));
        }
        points
    }

    /// The points of several drawings.
    pub(crate) fn all(&mut self, sources: impl IntoIterator<Item = Source>) -> Vec<Vec<DVec3>> {
        sources.into_iter().map(|source| self.points(source)).collect()
    }
}
