//! Writes a composite as rows of channel values.

use super::{Composite, FootHold, is_position};
use crate::motion::{Pose, RowWriter, local_rotation};
use crate::motion::{rotation_axes, turn_columns};
use crate::sheet::Source;

/// Writes what is on screen as rows of channel values. Reuses its buffers.
#[derive(Debug, Clone)]
pub struct CompositeRows<'a> {
    composite: &'a Composite<'a>,
    writer: RowWriter<'a>,
    /// Last source of each layer and the whole body's row of it: a layer's drawing often stays while others change.
    layers: Vec<(Option<Source>, Vec<f64>)>,
    /// Row of the source where a traveller takes its position.
    root: Vec<f64>,
    /// Foot hold and a pose buffer for it.
    feet: Option<(FootHold<'a>, Pose)>,
}

impl<'a> CompositeRows<'a> {
    /// Creates a writer for the drawings of a composite.
    pub fn new(composite: &'a Composite<'a>) -> Self {
        let row = vec![0.0; composite.clip().skeleton().channels()];
        Self {
            composite,
            writer: RowWriter::new(composite.clip()),
            layers: vec![(None, row.clone()); composite.layers()],
            root: row,
            feet: composite.foot_hold().map(|feet| (feet, Pose::rest(composite.clip().skeleton()))),
        }
    }

    /// Writes a drawing as shown on a koma: see [`RowWriter::write`].
    pub fn write(&mut self, drawing: usize, koma: usize, row: &mut [f64]) {
        let composite = self.composite;
        let sources = &composite.drawings[drawing];
        for ((taken, own), source) in self.layers.iter_mut().zip(sources) {
            if taken.replace(*source) != Some(*source) {
                self.writer.write(*source, own);
            }
        }
        let joints = &composite.clip().skeleton().joints;
        for (joint, layer) in joints.iter().zip(&composite.layer_of) {
            let columns = joint.first_channel..joint.first_channel + joint.channels.len();
            row[columns.clone()].copy_from_slice(&self.layers[*layer].1[columns]);
        }
        for &traveller in composite.travellers() {
            let place = composite.place(traveller, drawing, koma);
            self.writer.write(Source::At(place), &mut self.root);
            let joint = &joints[traveller];
            let positions = joint.channels.iter().zip(joint.first_channel..);
            for (_, column) in positions.filter(|(channel, _)| is_position(**channel)) {
                row[column] = self.root[column];
            }
        }
        self.hold_feet(drawing, row);
    }

    /// Rewrites the legs of held feet. A leg that does not change keeps its numbers.
    fn hold_feet(&mut self, drawing: usize, row: &mut [f64]) {
        let Some((feet, pose)) = &mut self.feet else { return };
        let skeleton = self.composite.clip().skeleton();
        pose.take_row(skeleton, row);
        feet.hold(|joint| self.composite.source(drawing, joint).place(), pose);
        for joint in feet.joints() {
            let (data, turned) = (&skeleton.joints[joint], pose.rotations[joint]);
            if turned != local_rotation(data, row) {
                let columns = data.first_channel..data.first_channel + data.channels.len();
                if let Some(axes) = rotation_axes(data) {
                    turn_columns(data, axes, turned, &mut row[columns]);
                }
            }
        }
    }
}
