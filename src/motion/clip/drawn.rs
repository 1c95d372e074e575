//! The pose of a drawing: an instant of the clip, or a blend of two.

use crate::motion::{Clip, Pose};
use crate::sheet::Source;

/// The local poses of drawings, one after the other, with their buffers.
#[derive(Debug, Clone)]
pub(crate) struct DrawnPose<'a> {
    clip: &'a Clip,
    pose: Pose,
    from: Pose,
    to: Pose,
}

impl<'a> DrawnPose<'a> {
    /// For drawings of a clip.
    pub(crate) fn of(clip: &'a Clip) -> Self {
        let rest = Pose::rest(clip.skeleton());
        Self { clip, pose: rest.clone(), from: rest.clone(), to: rest }
    }

    /// The motion.
    pub(crate) fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// The pose that was last taken on.
    pub(crate) fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Takes on the pose of a drawing.
    pub(crate) fn take(&mut self, source: Source) {
        match source {
            Source::At(place) => self.pose.take_place(self.clip, place),
            Source::Between { from, to, share } => {
                self.from.take_place(self.clip, from);
                self.to.take_place(self.clip, to);
                self.pose.take_blend(&self.from, &self.to, share);
            }
        }
    }
}
