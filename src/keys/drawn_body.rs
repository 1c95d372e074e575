//! The body as drawings show it, compared with the source.

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
    /// Creates a body of the clip that `reference` was made of, without a pose yet.
    pub fn new(clip: &'a Clip, reference: &'a Reference) -> Self {
        Self { reference, poser: Poser::new(clip), body: Body::new(clip.skeleton()) }
    }

    /// Returns the motion.
    pub fn clip(&self) -> &'a Clip {
        self.poser.clip()
    }

    /// Returns the height of the body in the file's unit: that of the reference.
    pub fn height(&self) -> f64 {
        self.reference.height()
    }

    /// Takes on the pose of a drawing.
    pub fn take(&mut self, source: Source) {
        self.body.place(self.poser.drawing(source));
    }

    /// Takes on a pose.
    pub fn stand(&mut self, pose: &Pose) {
        self.body.place(pose);
    }

    /// Returns the positions of the joints and the bones' tips in the world, in the file's unit.
    pub fn positions(&self) -> &[DVec3] {
        self.body.points()
    }

    /// Returns the position of a point of the body in the world, in the file's unit.
    pub fn position(&self, point: Point) -> DVec3 {
        point.position(&self.body)
    }

    /// Returns how far the body is from the source at a koma: root mean square over its points, in % of body height.
    ///
    /// # Panics
    /// When the source has no such koma.
    pub fn off(&self, koma: usize) -> f64 {
        self.reference.off(koma, self.positions())
    }

    /// Returns how far the body is from other positions of its points: root mean square, in % of body height.
    pub fn apart(&self, positions: &[DVec3]) -> f64 {
        self.reference.way(self.positions().iter().copied(), positions.iter().copied())
    }
}
