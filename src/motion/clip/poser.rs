//! The pose of a frame, of an instant, or of a drawing: the one place where poses come from.

use crate::motion::{Clip, Pose};
use crate::sheet::Source;
use crate::time::Frame;

/// Gives the poses of a clip one after the other, with its buffers. A [`Body`](super::Body) then says where
/// the joints are.
#[derive(Debug, Clone)]
pub struct Poser<'a> {
    clip: &'a Clip,
    pose: Pose,
    from: Pose,
    to: Pose,
}

impl<'a> Poser<'a> {
    /// A poser in the rest pose.
    pub fn of(clip: &'a Clip) -> Self {
        let rest = Pose::rest(clip.skeleton());
        Self { clip, pose: rest.clone(), from: rest.clone(), to: rest }
    }

    /// The motion.
    pub fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// The pose that was last given.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The pose of a frame.
    ///
    /// # Panics
    /// When the clip has no such frame.
    pub fn frame(&mut self, frame: Frame) -> &Pose {
        self.pose.take_frame(self.clip, frame);
        &self.pose
    }

    /// The pose at a place, a fractional frame number: see [`Pose::take_place`].
    ///
    /// # Panics
    /// When the clip has no frame.
    pub fn place(&mut self, place: f64) -> &Pose {
        self.pose.take_place(self.clip, place);
        &self.pose
    }

    /// The pose of a drawing: an instant of the clip, or a blend of two.
    ///
    /// # Panics
    /// When the clip has no frame.
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
