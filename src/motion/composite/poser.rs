//! The poses of a composite.

use super::{Composite, FootHold};
use crate::motion::{Pose, Poser};
use crate::sheet::Source;

/// Gives the poses of what is on screen, one after the other, with its buffers.
#[derive(Debug, Clone)]
pub(crate) struct CompositePoser<'a> {
    composite: &'a Composite<'a>,
    /// What each layer shows, and the whole body so: a layer's drawing stays while others change.
    layers: Vec<(Option<Source>, Poser<'a>)>,
    root: Poser<'a>,
    feet: Option<FootHold<'a>>,
    pose: Pose,
}

impl<'a> CompositePoser<'a> {
    /// For the drawings of a composite.
    pub(crate) fn of(composite: &'a Composite<'a>) -> Self {
        let root = Poser::of(composite.clip());
        let layers = vec![(None, root.clone()); composite.layers()];
        Self { composite, layers, pose: root.pose().clone(), root, feet: composite.foot_hold() }
    }

    /// The pose of a drawing as it is on screen on a koma.
    pub(crate) fn drawing(&mut self, drawing: usize, koma: usize) -> &Pose {
        let composite = self.composite;
        for ((taken, poser), source) in self.layers.iter_mut().zip(&composite.drawings[drawing]) {
            if taken.replace(*source) != Some(*source) {
                poser.drawing(*source);
            }
        }
        for (joint, layer) in composite.layer_of.iter().enumerate() {
            let own = self.layers[*layer].1.pose();
            self.pose.rotations[joint] = own.rotations[joint];
            self.pose.translations[joint] = own.translations[joint];
        }
        if composite.slides() {
            let root = self.root.place(composite.place(koma));
            for &joint in composite.travellers() {
                self.pose.translations[joint] = root.translations[joint];
            }
        }
        if let Some(feet) = &mut self.feet {
            feet.hold(|joint| composite.source(drawing, joint).place(), &mut self.pose);
        }
        &self.pose
    }
}
