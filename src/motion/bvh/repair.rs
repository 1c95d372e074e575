//! Fills in missing values when the user asks for a repair.

use crate::motion::{Axis, Channel, Joint, Skeleton};

/// Replaces every NaN of a table by the value of its channel in the frame before. Frames before the first
/// valid value take that one; a channel without any rests at its OFFSET, or at 0 degrees.
pub(super) fn hold(values: &mut [f64], skeleton: &Skeleton) {
    let rest: Vec<f64> = skeleton.joints.iter().flat_map(resting).collect();
    let channels = rest.len();
    for (channel, rest) in rest.iter().enumerate() {
        let column = || (channel..values.len()).step_by(channels);
        if !column().any(|at| values[at].is_nan()) {
            continue;
        }
        let good = column().map(|at| values[at]).find(|value| !value.is_nan());
        let mut held = good.unwrap_or(*rest);
        for at in (channel..values.len()).step_by(channels) {
            if values[at].is_nan() {
                values[at] = held;
            }
            held = values[at];
        }
    }
}

fn resting(joint: &Joint) -> impl Iterator<Item = f64> {
    joint.channels.iter().map(|channel| match channel {
        Channel::Position(Axis::X) => joint.offset.x,
        Channel::Position(Axis::Y) => joint.offset.y,
        Channel::Position(Axis::Z) => joint.offset.z,
        Channel::Rotation(_) => 0.0,
    })
}
