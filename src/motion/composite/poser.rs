//! Computes the poses of a composite.

use super::{Composite, FootHold};
use crate::motion::{Pose, Poser};
use crate::sheet::Source;

/// Computes the poses of what is on screen, one after the other. Reuses its buffers.
#[derive(Debug, Clone)]
pub struct CompositePoser<'a> {
    composite: &'a Composite<'a>,
    /// Last source of each layer and the whole body posed from it: a layer's drawing often stays while others change.
    layers: Vec<(Option<Source>, Poser<'a>)>,
    root: Poser<'a>,
    feet: Option<FootHold<'a>>,
    pose: Pose,
}

impl<'a> CompositePoser<'a> {
    /// Creates a poser for the drawings of a composite.
    pub fn new(composite: &'a Composite<'a>) -> Self {
        let root = Poser::new(composite.clip());
        let layers = vec![(None, root.clone()); composite.layers()];
        Self { composite, layers, pose: root.pose().clone(), root, feet: composite.foot_hold() }
    }

    /// Computes the pose of a drawing as shown on a koma.
    pub fn drawing(&mut self, drawing: usize, koma: usize) -> &Pose {
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
        for &joint in composite.travellers() {
            let root = self.root.place(composite.place(joint, drawing, koma));
            self.pose.translations[joint] = root.translations[joint];
        }
        if let Some(feet) = &mut self.feet {
            feet.hold(|joint| composite.source(drawing, joint).place(), &mut self.pose);
        }
        &self.pose
    }
}
