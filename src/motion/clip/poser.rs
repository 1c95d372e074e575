//! Computes the pose of a frame, an instant or a drawing. All single poses come from here.

use crate::motion::{Clip, Pose};
use crate::sheet::Source;
use crate::time::Frame;

/// Computes the poses of a clip one after the other. Reuses its buffers. A [`Body`](super::Body) then gives the
/// positions of the joints.
#[derive(Debug, Clone)]
pub struct Poser<'a> {
    clip: &'a Clip,
    pose: Pose,
    from: Pose,
    to: Pose,
}

impl<'a> Poser<'a> {
    /// Creates a poser in the rest pose.
    pub fn new(clip: &'a Clip) -> Self {
        let rest = Pose::rest(clip.skeleton());
        Self { clip, pose: rest.clone(), from: rest.clone(), to: rest }
    }

    /// The motion clip.
    pub fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// Returns the last computed pose.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Computes the pose of a frame.
    ///
    /// # Panics
    ///
    /// If the clip lacks the frame.
    pub fn frame(&mut self, frame: Frame) -> &Pose {
        self.pose.take_frame(self.clip, frame);
        &self.pose
    }

    /// Computes the pose at a place, a fractional frame number: see [`Pose::take_place`].
    ///
    /// # Panics
    ///
    /// If the clip has no frame.
    pub fn place(&mut self, place: f64) -> &Pose {
        self.pose.take_place(self.clip, place);
        &self.pose
    }

    /// Computes the pose of a drawing: an instant of the clip, or a blend of two.
    ///
    /// # Panics
    ///
    /// If the clip has no frame.
    pub fn drawing(&mut self, source: Source) -> &Pose {
        match source {
            Source::At(place) => self.pose.take_place(self.clip, place),
            Source::Between { from, to, share } => {
                self.from.take_place(self.clip, from);
                self.to.take_place(self.clip, to);
                self.pose.take_blend(&self.from, &self.to, share);
            }
        }
        &self.pose
    }
}
