//! Plays a motion frame by frame into the rows of a clip.

use glam::{DQuat, DVec3};

use super::record::{Key, Motion};
use super::rig::{LegIk, Rig, RigBone};
use super::{CENTIMETRES, damaged};
use genga::error::Error;
use genga::motion::{
    Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton, bytes_in_words, set_local_rotation,
};
use genga::time::{Frame, FrameRate};

const MOVES: [Channel; 3] =
    [Channel::Position(Axis::X), Channel::Position(Axis::Y), Channel::Position(Axis::Z)];
const TURNS: [Channel; 3] =
    [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];

/// The bones of a rig as joints, with the spine on the pelvis as in motion capture. In MMD both hang side
/// by side on the bone that carries the body.
struct Joints {
    skeleton: Skeleton,
    /// The bone of each joint, and the bone of its parent joint.
    bones: Vec<(usize, Option<usize>)>,
}

/// Names of pelvis and spine.
const TRUNK: [&str; 2] = ["下半身", "上半身"];

/// Builds the clip of a motion, from frame 0 to its last key.
///
/// # Errors
/// [`Error::Motion`] at the last key if the clip would take more than `most` bytes.
pub(super) fn clip(motion: &Motion, rig: &Rig, rate: FrameRate, most: u64) -> Result<Clip, Error> {
    let joints = Joints::new(rig);
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
    let mut stage = Stage::from_rig(rig);
    for frame in 0..=motion.last.0 {
        stage.pose(rig, motion, frame);
        joints.write(&stage, &mut row);
        values.extend_from_slice(&row);
    }
    Clip::new(joints.skeleton, rate, Frame(0), frames, values)
}

impl Joints {
    fn new(rig: &Rig) -> Self {
        let carriers = carriers(rig);
        let mut at = vec![None; rig.bones.len()];
        let (mut joints, mut bones, mut first_channel) = (Vec::new(), Vec::new(), 0);
        for index in order(&carriers).into_iter().filter(|bone| !rig.bones[*bone].is_target) {
            let bone = &rig.bones[index];
            let carrier = |bone: &usize| carriers[*bone];
            let before = std::iter::successors(carriers[index], carrier)
                .find(|carrier| at[*carrier].is_some());
            let offset =
                bone.rest.place - before.map_or(DVec3::ZERO, |before| rig.bones[before].rest.place);
            let is_hung = carriers[index] != bone.rest.parent;
            let pelvis = before.filter(|_| is_hung).map(|before| &rig.bones[before]);
            let is_apart = |pelvis: &RigBone| {
                offset != DVec3::ZERO || pelvis.rest.parent != bone.rest.parent || goes(pelvis)
            };
            let moves = before.is_none() || goes(bone) || pelvis.is_some_and(is_apart);
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

    /// Writes a pose. The row holds the pose of the previous frame, so that the new angles are chosen
    /// closest to it.
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

/// Distances below this, in MMD units, are noise of single-precision floats.
const NOISE: f64 = 1e-3;

/// Whether keys translate a bone.
fn goes(bone: &RigBone) -> bool {
    bone.keys.iter().any(|key| key.translation.length() > NOISE)
}

/// The parent of each bone in the skeleton: its own parent, but the pelvis for the spine.
fn carriers(rig: &Rig) -> Vec<Option<usize>> {
    let mut carriers: Vec<Option<usize>> = rig.bones.iter().map(|bone| bone.rest.parent).collect();
    let [pelvis, spine] = TRUNK.map(|name| rig.find(name));
    if let (Some(pelvis), Some(spine)) = (pelvis, spine) {
        let above = |bone: &usize| rig.bones[*bone].rest.parent;
        if std::iter::successors(Some(pelvis), above).all(|bone| bone != spine) {
            carriers[spine] = Some(pelvis);
        }
    }
    carriers
}

/// Orders the bones depth-first, parents before children.
fn order(carriers: &[Option<usize>]) -> Vec<usize> {
    let mut carried = vec![Vec::new(); carriers.len()];
    let mut open = Vec::new();
    for (bone, carrier) in carriers.iter().enumerate().rev() {
        carrier.map_or(&mut open, |carrier| &mut carried[carrier]).push(bone);
    }
    let mut order = Vec::with_capacity(carriers.len());
    while let Some(bone) = open.pop() {
        order.push(bone);
        open.append(&mut carried[bone]);
    }
    order
}

/// World transforms of the bones at a frame.
struct Stage {
    turns: Vec<DQuat>,
    places: Vec<DVec3>,
    /// Number of keys of each bone at or before the frame.
    passed: Vec<usize>,
}

impl Stage {
    fn from_rig(rig: &Rig) -> Self {
        let count = rig.bones.len();
        Self {
            turns: vec![DQuat::IDENTITY; count],
            places: vec![DVec3::ZERO; count],
            passed: vec![0; count],
        }
    }

    /// Poses the bones at a frame, which must not precede the one posed last.
    fn pose(&mut self, rig: &Rig, motion: &Motion, frame: u32) {
        let is_on = |ik: &str| motion.is_on(ik, frame);
        for index in 0..rig.bones.len() {
            self.place(rig, index, frame);
        }
        for LegIk { leg, names } in &rig.legs {
            if !is_on(&names[0]) {
                continue;
            }
            leg.bring(is_on(&names[1]), &mut self.turns, &mut self.places);
            self.carry(rig, leg.joints[2], frame);
        }
    }

    /// Computes the world transform of a bone from that of its parent.
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

    /// Updates the descendants of a bone, such as the toes.
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

    /// The local transform of a bone, interpolated between its keys like in MMD.
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

/// Interpolates between two keys: each coordinate and the rotation by its own curve, stored in the later
/// key.
fn between(before: &Key, next: &Key, frame: u32) -> (DVec3, DQuat) {
    let share = f64::from(frame - before.frame) / f64::from(next.frame - before.frame);
    let [x, y, z, turn] = next.curves.map(|curve| curve.done(share));
    let way = next.translation - before.translation;
    let translation = before.translation + DVec3::new(x, y, z) * way;
    (translation, before.rotation.slerp(next.rotation, turn))
}
