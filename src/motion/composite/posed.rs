//! A composite as poses.

use super::{Composite, FootHold};
use crate::motion::{DrawnPose, Pose};
use crate::sheet::Source;

/// Takes on what is on screen, one drawing after the other, with its buffers.
#[derive(Debug, Clone)]
pub(crate) struct PosedComposite<'a> {
    composite: &'a Composite<'a>,
    /// What each part shows, and the whole body so: a layer's drawing stays while others change.
    parts: Vec<(Option<Source>, DrawnPose<'a>)>,
    root: DrawnPose<'a>,
    feet: Option<FootHold<'a>>,
    pose: Pose,
}

impl<'a> PosedComposite<'a> {
    /// For the drawings of a composite.
    pub(crate) fn of(composite: &'a Composite<'a>) -> Self {
        let root = DrawnPose::of(composite.clip());
        let parts = vec![(None, root.clone()); composite.parts()];
        Self { composite, parts, pose: root.pose().clone(), root, feet: composite.foot_hold() }
    }

    /// The pose that was last taken on.
    pub(crate) fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Takes on a drawing as it is on screen on a koma.
    pub(crate) fn take(&mut self, drawing: usize, koma: usize) {
        let composite = self.composite;
        for ((taken, drawn), source) in self.parts.iter_mut().zip(&composite.drawings[drawing]) {
            if taken.replace(*source) != Some(*source) {
                drawn.take(*source);
            }
        }
        for (joint, part) in composite.part_of.iter().enumerate() {
            let own = self.parts[*part].1.pose();
            self.pose.rotations[joint] = own.rotations[joint];
            self.pose.translations[joint] = own.translations[joint];
        }
        if composite.slides() {
            self.root.take(Source::At(composite.place(koma)));
            for &joint in composite.travellers() {
                self.pose.translations[joint] = self.root.pose().translations[joint];
            }
        }
        if let Some(feet) = &mut self.feet {
            feet.hold(|joint| composite.source(drawing, joint).place(), &mut self.pose);
        }
    }
}
