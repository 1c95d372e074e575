//! The cartoon animation filter (Wang, Drucker, Agrawala and Cohen 2006): subtracts the smoothed second derivative from
//! a motion, so that it goes back before it sets out and overshoots where it stops.
//!
//! The paper filters scalar signals, which rotations are not: here a joint's rotation is displaced about itself by the
//! filtered angular steps.

use glam::{DQuat, DVec3};

use super::smooth::Smooth;
use crate::maths;
use crate::motion::{Axis, Channel, Clip, Joint, local_rotation, rotation_axes, turn_columns};

/// Scales a second difference over σ² so that the swing that gains most grows by the strength. With u = σω the three
/// boxes let sin³u/u³ through; u² times that is largest where tan u = 3u, at u = 1.3242, and this is the inverse of
/// that maximum.
pub(super) const MET_BEST: f64 = 1.4518;

/// The filter at a frame rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Filter {
    smooth: Smooth,
    /// The factor of the smoothed second difference, negative.
    gain: f64,
}

impl Filter {
    /// Creates the filter from its strength and the standard deviation of its bell in frames; `None` if either is 0.
    pub(super) fn new(strength: f64, sigma: f64) -> Option<Self> {
        let gain = -MET_BEST * strength * sigma * sigma;
        (gain != 0.0).then(|| Self { smooth: Smooth::new(sigma), gain })
    }

    /// Exaggerates the given joints of a motion.
    pub(super) fn apply(self, clip: &Clip, joints: &[bool]) -> Clip {
        let mut values: Vec<f64> = clip.rows().flatten().copied().collect();
        let mut buffers = Buffers::with_frames(clip.len());
        if clip.len() > 2 {
            let moved = clip.skeleton().joints.iter().zip(joints).filter(|(_, moves)| **moves);
            moved.for_each(|(joint, _)| self.joint(clip, joint, &mut values, &mut buffers));
        }
        clip.with_values(values)
    }

    fn joint(self, clip: &Clip, joint: &Joint, values: &mut [f64], buffers: &mut Buffers) {
        let axes = rotation_axes(joint);
        if let Some(axes) = axes {
            self.rotation(clip, joint, axes, values, buffers);
        }
        for (column, channel) in (joint.first_channel..).zip(&joint.channels) {
            match channel {
                Channel::Rotation(_) if axes.is_some() => {}
                // Fewer than three axes, or one axis twice, cannot express every rotation, so each column is filtered
                // alone.
                Channel::Rotation(_) => self.column(clip, column, wrapped, values, buffers),
                Channel::Position(_) => self.column(clip, column, |step| step, values, buffers),
            }
        }
    }

    /// Filters a joint that can rotate freely.
    fn rotation(
        self,
        clip: &Clip,
        joint: &Joint,
        axes: [Axis; 3],
        values: &mut [f64],
        buffers: &mut Buffers,
    ) {
        let Buffers { rotations, bends, room } = buffers;
        rotations.clear();
        rotations.extend(clip.rows().map(|row| local_rotation(joint, row)));
        angular_bends(rotations, bends);
        bends.iter_mut().for_each(|bend| self.smooth.apply(bend, self.gain, room));
        let columns = joint.first_channel..joint.first_channel + joint.channels.len();
        let rows = values.chunks_exact_mut(clip.skeleton().channels());
        for (at, (row, rotation)) in rows.zip(rotations).enumerate() {
            let turn = DVec3::new(bends[0][at], bends[1][at], bends[2][at]);
            if turn != DVec3::ZERO {
                let turned = *rotation * DQuat::from_scaled_axis(turn);
                turn_columns(joint, axes, turned, &mut row[columns.clone()]);
            }
        }
    }

    /// Filters one column; `step` is the difference between two of its values.
    fn column(
        self,
        clip: &Clip,
        column: usize,
        step: fn(f64) -> f64,
        values: &mut [f64],
        buffers: &mut Buffers,
    ) {
        let Buffers { bends: [bend, ..], room, .. } = buffers;
        let own = || clip.rows().map(|row| row[column]);
        let mut steps = own().zip(own().skip(1)).map(|(from, to)| step(to - from));
        let mut before = steps.next().unwrap_or_default();
        for (bend, after) in bend[1..].iter_mut().zip(steps) {
            *bend = after - before;
            before = after;
        }
        no_bend_at_the_ends(bend);
        self.smooth.apply(bend, self.gain, room);
        let rows = values.chunks_exact_mut(clip.skeleton().channels());
        rows.zip(bend).for_each(|(row, bend)| row[column] += *bend);
    }
}

/// Buffers reused for each joint.
struct Buffers {
    rotations: Vec<DQuat>,
    /// Second differences of up to three coordinates, frame by frame.
    bends: [Vec<f64>; 3],
    room: Vec<f64>,
}

impl Buffers {
    fn with_frames(frames: usize) -> Self {
        let bends = [(); 3].map(|()| vec![0.0; frames]);
        Self { rotations: Vec::with_capacity(frames), bends, room: Vec::new() }
    }
}

/// Computes the second difference of a rotation at each frame, in the joint's own axes there: the sum of the turns to
/// the next frame and to the previous one.
fn angular_bends(rotations: &[DQuat], bends: &mut [Vec<f64>; 3]) {
    let mut before = DVec3::ZERO;
    for (at, pair) in rotations.windows(2).enumerate() {
        let after = way(pair[0], pair[1]);
        let bend = after - before;
        bends.iter_mut().zip(bend.to_array()).for_each(|(bends, bend)| bends[at] = bend);
        before = after;
    }
    bends.iter_mut().for_each(|bend| no_bend_at_the_ends(bend));
}

/// Sets the bend at both ends to 0. Beyond its ends a motion continues with odd symmetry, so it has no bend there, and
/// the first and last pose stay unchanged.
fn no_bend_at_the_ends(bend: &mut [f64]) {
    let last = bend.len() - 1;
    (bend[0], bend[last]) = (0.0, 0.0);
}

/// Returns the shortest turn from one rotation to another as axis times angle, in the axes of the first.
fn way(from: DQuat, to: DQuat) -> DVec3 {
    // Equal rotations must give exactly zero despite rounding.
    if from == to {
        return DVec3::ZERO;
    }
    let turn = from.conjugate() * to;
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let (axis, cosine) = (turn.xyz(), turn.w);
    let sine = axis.length();
    if sine > 0.0 { axis * (2.0 * maths::atan2(sine, cosine) / sine) } else { DVec3::ZERO }
}

/// Returns the shortest difference between two angles in degrees.
fn wrapped(step: f64) -> f64 {
    step - 360.0 * (step / 360.0).round()
}
