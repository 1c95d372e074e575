//! A motion played frame by frame, as rows of a clip.

use glam::{DQuat, DVec3};

use super::legs;
use super::record::{Key, Motion};
use super::rig::{Rig, RigBone};
use super::{CENTIMETRES, damaged};
use crate::error::Error;
use crate::motion::{
    Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton, bytes_in_words, set_local_rotation,
};
use crate::time::{Frame, FrameRate};

const MOVES: [Channel; 3] =
    [Channel::Position(Axis::X), Channel::Position(Axis::Y), Channel::Position(Axis::Z)];
const TURNS: [Channel; 3] =
    [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];

/// The bones of a rig as joints.
struct Joints {
    skeleton: Skeleton,
    /// The bone of each joint, and the one of the joint before it.
    bones: Vec<(usize, Option<usize>)>,
}

/// The clip of a motion, from frame 0 to its last key.
///
/// # Errors
/// [`Error::Motion`] at the last key where so long a motion takes more than `most` bytes.
pub(super) fn clip(motion: &Motion, rig: &Rig, rate: FrameRate, most: u64) -> Result<Clip, Error> {
    let joints = Joints::of(rig);
    let channels = joints.skeleton.channels();
    let frames = motion.last.0 as usize + 1;
    let needed = frames as f64 * (channels * size_of::<f64>()) as f64;
    if needed > most as f64 {
        let message = format!(
            "frame {} is the last: so long a motion takes {}, and {} are allowed; --memory GIB allows more",
            motion.last.0,
            bytes_in_words(needed),
            bytes_in_words(most as f64)
        );
        return Err(damaged(motion.last.1, message));
    }
    let mut values = Vec::with_capacity(frames * channels);
    let mut row = vec![0.0; channels];
    let mut stage = Stage::of(rig);
    for frame in 0..=motion.last.0 {
        stage.pose(rig, motion, frame);
        joints.write(&stage, &mut row);
        values.extend_from_slice(&row);
    }
    Clip::new(joints.skeleton, rate, Frame(0), frames, values)
}

impl Joints {
    fn of(rig: &Rig) -> Self {
        let mut at = vec![None; rig.bones.len()];
        let (mut joints, mut bones, mut first_channel) = (Vec::new(), Vec::new(), 0);
        for (index, bone) in rig.bones.iter().enumerate().filter(|(_, bone)| !bone.is_target) {
            let parent = |bone: &usize| rig.bones[*bone].rest.parent;
            let before = std::iter::successors(bone.rest.parent, parent)
                .find(|parent| at[*parent].is_some());
            let offset =
                bone.rest.place - before.map_or(DVec3::ZERO, |before| rig.bones[before].rest.place);
            let moves =
                before.is_none() || bone.keys.iter().any(|key| key.translation != DVec3::ZERO);
            let channels: Vec<Channel> = MOVES.into_iter().filter(|_| moves).chain(TURNS).collect();
            let tips = rig.tips.iter().filter(|(tip, _)| *tip == index);
            let tip = |(_, way): &(usize, DVec3)| EndSite {
                name: "Site".into(),
                offset: CENTIMETRES * *way,
            };
            let count = channels.len();
            at[index] = Some(joints.len());
            joints.push(Joint {
                name: bone.rest.name.clone(),
                parent: before.and_then(|before| at[before]).map(JointId),
                offset: CENTIMETRES * offset,
                channels,
                first_channel,
                end_sites: tips.map(tip).collect(),
            });
            bones.push((index, before));
            first_channel += count;
        }
        Self { skeleton: Skeleton { joints }, bones }
    }

    /// Writes a pose; the row has that of the frame before, to whose angles its own are the nearest.
    fn write(&self, stage: &Stage, row: &mut [f64]) {
        for (joint, (bone, before)) in self.skeleton.joints.iter().zip(&self.bones) {
            let carrier = before.map_or(DQuat::IDENTITY, |before| stage.turns[before]);
            let from = before.map_or(DVec3::ZERO, |before| stage.places[before]);
            if joint.channels.len() > TURNS.len() {
                let place = CENTIMETRES * (carrier.inverse() * (stage.places[*bone] - from));
                row[joint.first_channel..joint.first_channel + 3]
                    .copy_from_slice(&place.to_array());
            }
            set_local_rotation(joint, (carrier.inverse() * stage.turns[*bone]).normalize(), row);
        }
    }
}

/// The bones in the world at a frame.
struct Stage {
    turns: Vec<DQuat>,
    places: Vec<DVec3>,
    /// Of each bone how many of its keys are at or before the frame.
    passed: Vec<usize>,
}

impl Stage {
    fn of(rig: &Rig) -> Self {
        let count = rig.bones.len();
        Self {
            turns: vec![DQuat::IDENTITY; count],
            places: vec![DVec3::ZERO; count],
            passed: vec![0; count],
        }
    }

    /// Poses the bones at a frame that is not before the last one.
    fn pose(&mut self, rig: &Rig, motion: &Motion, frame: u32) {
        let is_on = |ik: &str| motion.is_on(ik, frame);
        for index in 0..rig.bones.len() {
            self.place(rig, index, frame);
        }
        for leg in &rig.legs {
            if !is_on(&leg.names[0]) {
                continue;
            }
            legs::bring(leg, is_on(&leg.names[1]), &mut self.turns, &mut self.places);
            self.carry(rig, leg.joints[2], frame);
        }
    }

    /// Places a bone on the one it hangs on.
    fn place(&mut self, rig: &Rig, index: usize, frame: u32) {
        let bone = &rig.bones[index];
        let (translation, rotation) = self.local(index, bone, frame);
        let before = bone.rest.parent;
        let carrier = before.map_or(DQuat::IDENTITY, |before| self.turns[before]);
        let offset =
            bone.rest.place - before.map_or(DVec3::ZERO, |before| rig.bones[before].rest.place);
        let from = before.map_or(DVec3::ZERO, |before| self.places[before]);
        self.places[index] = from + carrier * (offset + translation);
        self.turns[index] = (carrier * rotation).normalize();
    }

    /// Places all that hangs on a bone again, as toes do.
    fn carry(&mut self, rig: &Rig, top: usize, frame: u32) {
        let mut is_below = vec![false; rig.bones.len()];
        is_below[top] = true;
        for index in top + 1..rig.bones.len() {
            if rig.bones[index].rest.parent.is_some_and(|parent| is_below[parent]) {
                is_below[index] = true;
                self.place(rig, index, frame);
            }
        }
    }

    /// A bone against the one it hangs on, between its keys as MMD goes.
    fn local(&mut self, index: usize, bone: &RigBone, frame: u32) -> (DVec3, DQuat) {
        let passed = &mut self.passed[index];
        while bone.keys.get(*passed).is_some_and(|key| key.frame <= frame) {
            *passed += 1;
        }
        let next = bone.keys.get(*passed);
        match (passed.checked_sub(1).and_then(|at| bone.keys.get(at)), next) {
            (Some(before), Some(next)) => between(before, next, frame),
            (Some(key), None) | (None, Some(key)) => (key.translation, key.rotation),
            (None, None) => (DVec3::ZERO, DQuat::IDENTITY),
        }
    }
}

/// Between two keys: each coordinate and the rotation by a curve of the later one.
fn between(before: &Key, next: &Key, frame: u32) -> (DVec3, DQuat) {
    let share = f64::from(frame - before.frame) / f64::from(next.frame - before.frame);
    let [x, y, z, turn] = next.curves.map(|curve| curve.done(share));
    let way = next.translation - before.translation;
    let translation = before.translation + DVec3::new(x, y, z) * way;
    (translation, before.rotation.slerp(next.rotation, turn))
}
