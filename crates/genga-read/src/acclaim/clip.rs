//! Converts a skeleton and its motion to joints whose rest axes are those of the world.
//!
//! A bone turns about its own axes C. In world axes it turns by C·R·C⁻¹, which is written as angles about
//! Z, Y and X. For the root, whose axes are the world's, these are the very numbers of the file.

use glam::{DQuat, DVec3};

use super::amc::Amc;
use super::asf::{Asf, Bone, Freedom, about, in_order};
use genga::error::Error;
use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton, set_local_rotation};
use genga::time::{Frame, FrameRate};

const MOVES: [Channel; 3] =
    [Channel::Position(Axis::X), Channel::Position(Axis::Y), Channel::Position(Axis::Z)];
const TURNS: [Channel; 3] =
    [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::Y), Channel::Rotation(Axis::X)];

/// Builds the clip.
///
/// # Errors
/// [`Error::Clip`] if its values are not valid in a clip.
pub(super) fn clip(asf: &Asf, amc: Amc, rate: FrameRate) -> Result<Clip, Error> {
    let skeleton = skeleton(asf);
    let in_degrees = amc.in_degrees.unwrap_or(asf.in_degrees);
    let (width, channels) = (amc.values.len() / amc.frames.max(1), skeleton.channels());
    let mut values = vec![0.0; amc.frames * channels];
    let mut before = vec![0.0; channels];
    let rows = values.chunks_exact_mut(channels.max(1));
    for (row, own) in rows.zip(amc.values.chunks_exact(width.max(1))) {
        row.copy_from_slice(&before);
        let mut own = own.iter().copied();
        for (bone, joint) in asf.bones.iter().zip(&skeleton.joints) {
            let own: Vec<f64> = own.by_ref().take(bone.freedoms.len()).collect();
            write(bone, joint, &own, in_degrees, row);
        }
        before.copy_from_slice(row);
    }
    Clip::new(skeleton, rate, Frame(amc.first), amc.frames, values)
}

/// Builds the joints, each at the start of its bone.
fn skeleton(asf: &Asf) -> Skeleton {
    let mut is_parent = vec![false; asf.bones.len()];
    asf.bones.iter().filter_map(|bone| bone.parent).for_each(|parent| is_parent[parent] = true);
    let mut first_channel = 0;
    let mut joints = Vec::with_capacity(asf.bones.len());
    for (at, bone) in asf.bones.iter().enumerate() {
        let offset = match bone.parent {
            None => bone.way,
            Some(0) => DVec3::ZERO,
            Some(parent) => asf.bones[parent].way,
        };
        let is_leaf = bone.parent.is_some() && !is_parent[at];
        let tip = is_leaf.then(|| EndSite { name: "Site".into(), offset: bone.way });
        let channels = channels(bone);
        let parent = bone.parent.map(JointId);
        let name = bone.name.clone();
        let count = channels.len();
        let end_sites = tip.into_iter().collect();
        joints.push(Joint { name, parent, offset, channels, first_channel, end_sites });
        first_channel += count;
    }
    Skeleton { joints }
}

fn channels(bone: &Bone) -> Vec<Channel> {
    let moves = bone.freedoms.iter().any(|freedom| matches!(freedom, Freedom::Move(_)));
    let turns = bone.freedoms.iter().any(|freedom| matches!(freedom, Freedom::Turn(_)));
    let of = |has: bool, channels: [Channel; 3]| channels.into_iter().filter(move |_| has);
    of(moves, MOVES).chain(of(turns, TURNS)).collect()
}

/// Writes the values of a bone into the columns of its joint.
fn write(bone: &Bone, joint: &Joint, own: &[f64], in_degrees: bool, row: &mut [f64]) {
    let degrees = |value: f64| if in_degrees { value } else { value.to_degrees() };
    let (mut moved, mut angles) = (DVec3::ZERO, DVec3::ZERO);
    let mut turns: Vec<DQuat> = Vec::with_capacity(3);
    for (freedom, value) in bone.freedoms.iter().zip(own) {
        match freedom {
            Freedom::Move(axis) => moved += *value * axis.unit(),
            Freedom::Turn(axis) => {
                angles += degrees(*value) * axis.unit();
                turns.push(about(*axis, degrees(*value).to_radians()));
            }
            Freedom::Length => {}
        }
    }
    let mut column = joint.first_channel;
    if joint.channels.first() == Some(&MOVES[0]) {
        let place = joint.offset + bone.axes * moved;
        row[column..column + 3].copy_from_slice(&place.to_array());
        column += 3;
    }
    if turns.is_empty() {
        return;
    }
    if bone.axes == DQuat::IDENTITY && is_plain(bone) {
        row[column..column + 3].copy_from_slice(&[angles.z, angles.y, angles.x]);
    } else {
        let turned = bone.axes * in_order(turns.into_iter()) * bone.axes.inverse();
        set_local_rotation(joint, turned.normalize(), row);
    }
}

/// Whether a bone turns about X, then Y, then Z, or about some of them in that order. Its numbers are then
/// angles of Z·Y·X.
fn is_plain(bone: &Bone) -> bool {
    let turns = bone.freedoms.iter().filter_map(|freedom| match freedom {
        Freedom::Turn(axis) => Some(*axis as usize),
        Freedom::Move(_) | Freedom::Length => None,
    });
    let turns: Vec<usize> = turns.collect();
    turns.windows(2).all(|pair| pair[0] < pair[1])
}
