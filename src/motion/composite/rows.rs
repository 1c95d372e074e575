//! A composite as rows of channel values.

use super::{Composite, FootHold, is_position};
use crate::motion::{Pose, RowWriter, local_rotation};
use crate::motion::{rotation_axes, turn_columns};
use crate::sheet::Source;

/// Writes what is on screen as rows of channel values, with its buffers.
#[derive(Debug, Clone)]
pub(crate) struct CompositeRows<'a> {
    composite: &'a Composite<'a>,
    writer: RowWriter<'a>,
    /// What each layer shows, and the whole body so: a layer's drawing stays while others change.
    layers: Vec<(Option<Source>, Vec<f64>)>,
    /// The source at a koma.
    root: Vec<f64>,
    /// What holds the feet, and the pose in which it does.
    feet: Option<(FootHold<'a>, Pose)>,
}

impl<'a> CompositeRows<'a> {
    /// For the drawings of a composite.
    pub(crate) fn of(composite: &'a Composite<'a>) -> Self {
        let row = vec![0.0; composite.clip().skeleton().channels()];
        Self {
            composite,
            writer: RowWriter::new(composite.clip()),
            layers: vec![(None, row.clone()); composite.layers()],
            root: row,
            feet: composite.foot_hold().map(|feet| (feet, Pose::rest(composite.clip().skeleton()))),
        }
    }

    /// Writes a drawing as it is on screen on a koma: see [`RowWriter::write`].
    pub(crate) fn write(&mut self, drawing: usize, koma: usize, row: &mut [f64]) {
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
        if composite.slides() {
            self.writer.write(Source::At(composite.place(koma)), &mut self.root);
            for joint in composite.travellers().iter().map(|joint| &joints[*joint]) {
                let positions = joint.channels.iter().zip(joint.first_channel..);
                for (_, column) in positions.filter(|(channel, _)| is_position(**channel)) {
                    row[column] = self.root[column];
                }
            }
        }
        self.hold_feet(drawing, row);
    }

    /// Writes the legs of feet that are held anew; a leg that is not keeps its numbers.
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
