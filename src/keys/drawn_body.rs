//! The body as drawings show it, beside the source.

use glam::DVec3;

use crate::keys::Reference;
use crate::motion::landmarks::Point;
use crate::motion::{Body, Clip, Pose, Poser};
use crate::sheet::Source;

/// A body that takes on the pose of one drawing after the other, measured over the points of
/// its [`Reference`].
#[derive(Debug, Clone)]
pub struct DrawnBody<'a> {
    reference: &'a Reference,
    poser: Poser<'a>,
    body: Body,
}

impl<'a> DrawnBody<'a> {
    /// A body of the clip that `reference` was made of, as yet without a pose.
    pub fn of(clip: &'a Clip, reference: &'a Reference) -> Self {
        Self { reference, poser: Poser::of(clip), body: Body::new(clip.skeleton()) }
    }

    /// The motion.
    pub fn clip(&self) -> &'a Clip {
        self.poser.clip()
    }

    /// The height of the body in the file's unit: that of the reference.
    pub fn height(&self) -> f64 {
        self.reference.height()
    }

    /// Takes on the pose of a drawing.
    pub fn take(&mut self, source: Source) {
        self.body.place(self.poser.drawing(source));
    }

    /// Takes on a pose.
    pub(crate) fn stand(&mut self, pose: &Pose) {
        self.body.place(pose);
    }

    /// Where the joints and the tips of the bones stand in the world, in the file's unit.
    pub fn positions(&self) -> &[DVec3] {
        self.body.points()
    }

    /// Where a point of the body stands in the world, in the file's unit.
    pub fn position(&self, point: Point) -> DVec3 {
        point.position(&self.body)
    }

    /// How far the body is from where the source has it at a koma: root mean square over its points, in
    /// % of its height.
    ///
    /// # Panics
    /// When the source has no such koma.
    pub fn off(&self, koma: usize) -> f64 {
        self.reference.off(koma, self.positions())
    }

    /// How far the body is from other positions of the same points, in the same measure.
    pub fn apart(&self, positions: &[DVec3]) -> f64 {
        self.reference.way(self.positions().iter().copied(), positions.iter().copied())
    }
}
