//! Computes the rows of a file from a score: interpolates between key poses, keeps feet on the floor and hands
//! together, turns the eyes to the ball, and adds breath and unrest.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};

use super::feet::Feet;
use super::limb;
use super::noise::{Noise, Random};
use super::score::{Part, SIDES, Score, Side, Window};
use super::skeleton::{ARMS, BONES, CHEST, HIPS, LEGS, NECK, SPINE};
use super::track::{Track, ease};

/// Seconds by which a part lags behind the hips: movement runs outwards along the body.
const SPINE_LAG: [f64; 3] = [0.006, 0.012, 0.018];
const COLLAR_LAG: f64 = 0.018;
const ARM_LAG: f64 = 0.02;
const ELBOW_LAG: f64 = 0.028;
const WRIST_LAG: f64 = 0.036;
/// Each spine joint's share of the trunk's angles, and each neck joint's share of the head's.
const SPINE_SHARE: [f64; 3] = [0.25, 0.35, 0.4];
const NECK_SHARE: [f64; 3] = [0.3, 0.3, 0.4];

/// A body at one instant: rotations relative to the parent and in the world, positions in centimetres.
pub(crate) struct Body {
    pub(crate) root: DVec3,
    pub(crate) local: [DQuat; 23],
    pub(crate) world: [DQuat; 23],
    pub(crate) places: [DVec3; 23],
}

impl Body {
    fn new() -> Self {
        Self {
            root: DVec3::ZERO,
            local: [DQuat::IDENTITY; 23],
            world: [DQuat::IDENTITY; 23],
            places: [DVec3::ZERO; 23],
        }
    }

    /// Sets a joint's rotation and computes its position. Its parent must have been set.
    pub(crate) fn set(&mut self, joint: usize, local: DQuat) {
        self.local[joint] = local;
        (self.world[joint], self.places[joint]) = match BONES[joint].parent {
            None => (local, self.root),
            Some(up) => {
                (self.world[up] * local, self.places[up] + self.world[up] * BONES[joint].offset)
            }
        };
    }

    /// Position of a joint's End Site.
    pub(crate) fn tip(&self, joint: usize) -> DVec3 {
        self.places[joint] + self.world[joint] * BONES[joint].tip.unwrap_or(DVec3::ZERO)
    }
}

/// A score prepared for evaluation at any instant.
pub(crate) struct Performance<'a> {
    score: &'a Score,
    tracks: BTreeMap<Part, Track>,
    feet: Feet<'a>,
    /// Unrest of each joint's three axes, and of the root, degrees and centimetres.
    noise: Vec<[Noise; 3]>,
    sway: [Noise; 3],
}

impl<'a> Performance<'a> {
    pub(crate) fn new(score: &'a Score) -> Self {
        let mut keys: BTreeMap<Part, Vec<(f64, [f64; 3])>> = BTreeMap::new();
        for key in &score.keys {
            for &(part, value) in &key.set {
                keys.entry(part).or_default().push((key.at, value));
            }
        }
        let tracks = keys.into_iter().map(|(part, keys)| (part, Track::new(&keys))).collect();
        let mut random = Random(score.seed);
        let mut unrest = |joint: usize| {
            [0, 1, 2].map(|_| Noise::capture(&mut random, unrest_of(joint), score.fps))
        };
        let noise = (0..BONES.len()).map(&mut unrest).collect();
        let sway = [0.25, 0.08, 0.25].map(|rms| Noise::band(&mut random, rms, 0.15, 0.7, 5));
        Self { score, tracks, feet: Feet::new(score), noise, sway }
    }

    fn value(&self, part: Part, time: f64) -> [f64; 3] {
        self.tracks.get(&part).map_or_else(|| at_ease(part), |track| track.at(time))
    }

    /// The body at a time, in seconds from the start.
    pub(crate) fn body(&self, time: f64) -> Body {
        let mut body = Body::new();
        let sway = [0, 1, 2].map(|axis| self.sway[axis].at(time));
        body.root = DVec3::from_array(self.value(Part::Root, time)) + DVec3::from_array(sway);
        self.set(&mut body, HIPS, limb::torso(self.value(Part::Hips, time)), time);
        self.set_trunk(&mut body, time);
        for side in SIDES {
            self.set_arm(&mut body, side, time);
        }
        self.set_head(&mut body, time);
        for side in SIDES {
            let [bend, turn, _] = self.value(Part::Foot(side), time);
            let free = self.value(Part::Leg(side), time);
            let knee = self.value(Part::Knee(side), time);
            let leg = self.feet.leg(&body, side, time, [bend, turn], free, knee);
            for (joint, local) in LEGS[side as usize].into_iter().zip(leg) {
                self.set(&mut body, joint, local, time);
            }
        }
        body
    }

    /// Sets a joint, with unrest added to its rotation.
    fn set(&self, body: &mut Body, joint: usize, local: DQuat, time: f64) {
        let unrest = [0, 1, 2].map(|axis| self.noise[joint][axis].at(time).to_radians());
        body.set(joint, local * DQuat::from_scaled_axis(DVec3::from_array(unrest)));
    }

    fn set_trunk(&self, body: &mut Body, time: f64) {
        for ((joint, lag), share) in SPINE.into_iter().zip(SPINE_LAG).zip(SPINE_SHARE) {
            let mut angles = self.value(Part::Trunk, time - lag).map(|angle| angle * share);
            angles[0] -= 0.5 * breath(time);
            self.set(body, joint, limb::torso(angles), time);
        }
    }

    fn set_arm(&self, body: &mut Body, side: Side, time: f64) {
        let joints = ARMS[side as usize];
        // The angles below are those of a left arm; a right one is its mirror image.
        let own = |turn: DQuat| if side == Side::L { turn } else { limb::mirrored(turn) };
        let [raised, forward, _] = self.value(Part::Collar(side), time - COLLAR_LAG);
        let collar = limb::about_y(-forward) * limb::about_z(raised + 0.8 * breath(time));
        self.set(body, joints[0], own(collar), time);
        let mut upper = limb::upper_arm(self.value(Part::Arm(side), time - ARM_LAG));
        let [mut bend, roll, _] = self.value(Part::Elbow(side), time - ELBOW_LAG);
        let [_, _, wrist] = self.value(Part::Elbow(side), time - WRIST_LAG);
        let together = self.score.grips.iter().map(|grip| share(grip, time)).fold(0.0, f64::max);
        if together > 0.0 {
            let apart = DVec3::new(if side == Side::L { 3.5 } else { -3.5 }, 0.0, 0.0);
            let grip = DVec3::from_array(self.value(Part::Grip, time)) + apart;
            let grip = body.places[CHEST] + body.world[CHEST] * grip;
            let into_collar = body.world[joints[0]].inverse();
            let target = into_collar * (grip - body.places[joints[0]]) - BONES[joints[1]].offset;
            let mirror = DVec3::new(if side == Side::L { 1.0 } else { -1.0 }, 1.0, 1.0);
            let bones = [28.0, 25.5];
            let pole = DVec3::new(0.6, -1.0, -0.25);
            let (reached, reached_bend) = limb::reach_with_arm(target * mirror, pole, bones);
            upper = upper.slerp(reached, together);
            bend += (reached_bend - bend) * together;
        }
        self.set(body, joints[1], own(upper), time);
        self.set(body, joints[2], own(limb::forearm(bend, roll)), time);
        // Hands that grip something point forward and up from the chest, as far as a wrist bends.
        let fingers = if side == Side::L { DVec3::X } else { DVec3::NEG_X };
        let forward = body.world[CHEST] * DVec3::new(0.0, 0.6, 0.8);
        let held = DQuat::from_rotation_arc(fingers, body.world[joints[2]].inverse() * forward);
        let held = DQuat::IDENTITY.slerp(held, 0.6 * together);
        self.set(body, joints[3], held * own(limb::about_z(-wrist)), time);
    }

    /// Turns the neck so that the eyes point at the gaze target, as far as a neck turns.
    fn set_head(&self, body: &mut Body, time: f64) {
        let neck = body.places[CHEST] + body.world[CHEST] * BONES[NECK[0]].offset;
        let eyes = neck + DVec3::new(0.0, 15.0, 0.0);
        let line = DVec3::from_array(self.value(Part::Gaze, time)) - eyes;
        let sideways = DVec3::Y.cross(line).normalize();
        let upright = line.normalize().cross(sideways);
        let level = DQuat::from_mat3(&DMat3::from_cols(sideways, upright, line.normalize()));
        let wanted = (body.world[CHEST].inverse() * level).to_scaled_axis();
        let angle = wanted.length().to_degrees();
        let reached = wanted * (soft_limit(angle, 85.0) / angle.max(1e-9));
        for (joint, share) in NECK.into_iter().zip(NECK_SHARE) {
            self.set(body, joint, DQuat::from_scaled_axis(reached * share), time);
        }
    }

    /// The rows of the file: the root's position, then the Z, X and Y rotation of every joint in degrees.
    pub(crate) fn rows(&self) -> Vec<Vec<f64>> {
        let mut before = [[0.0; 3]; 23];
        let mut row = |frame: usize| {
            let body = self.body(frame as f64 / self.score.fps);
            let mut row = body.root.to_array().to_vec();
            for (angles, local) in before.iter_mut().zip(body.local) {
                *angles = zxy_near(local, *angles);
                row.extend(*angles);
            }
            row
        };
        (0..self.score.frames).map(&mut row).collect()
    }
}

/// Weight of a window at a time, 0 to 1.
pub(crate) fn share(window: &Window, time: f64) -> f64 {
    let Window { from, to, ease_in, ease_out } = *window;
    ease(time, from, from + ease_in) * (1.0 - ease(time, to - ease_out, to))
}

/// Rise and fall of chest and shoulders, −1 to 1.
fn breath(time: f64) -> f64 {
    libm::sin(TAU * 0.31 * time)
}

/// Follows an angle, but ever less as it nears a limit, in degrees.
fn soft_limit(angle: f64, limit: f64) -> f64 {
    limit * libm::tanh(angle / limit)
}

/// Root mean square of a joint's unrest in degrees: larger towards the ends of the body.
fn unrest_of(joint: usize) -> f64 {
    match BONES[joint].name {
        "Hips" | "Spine" | "Spine1" | "Spine2" => 0.1,
        "LeftUpLeg" | "RightUpLeg" | "LeftLeg" | "RightLeg" => 0.12,
        "LeftForeArm" | "RightForeArm" | "LeftArm" | "RightArm" => 0.22,
        "LeftHand" | "RightHand" => 0.3,
        _ => 0.16,
    }
}

/// The value of a part that no key sets.
fn at_ease(part: Part) -> [f64; 3] {
    match part {
        Part::Root => [0.0, 91.0, 0.0],
        Part::Gaze => [0.0, 150.0, 1000.0],
        Part::Grip => [0.0, 0.0, 25.0],
        Part::Arm(_) => [0.0, 12.0, 0.0],
        Part::Elbow(_) => [12.0, 0.0, 0.0],
        _ => [0.0; 3],
    }
}

/// The Z, X and Y angles of a rotation in degrees: of all equivalent ones those nearest to `before`.
fn zxy_near(turn: DQuat, before: [f64; 3]) -> [f64; 3] {
    let (x, y, z) = (turn * DVec3::X, turn * DVec3::Y, turn * DVec3::Z);
    let first = [libm::atan2(-y.x, y.y), libm::asin(y.z.clamp(-1.0, 1.0)), libm::atan2(-x.z, z.z)];
    let first = first.map(f64::to_degrees);
    let second = [first[0] + 180.0, 180.0 - first[1], first[2] + 180.0];
    let [first, second] = [first, second].map(|angles| {
        [0, 1, 2].map(|at| angles[at] - 360.0 * ((angles[at] - before[at]) / 360.0).round())
    });
    let far = |angles: [f64; 3]| -> f64 {
        angles.iter().zip(before).map(|(angle, before)| (angle - before).abs()).sum()
    };
    if far(second) < far(first) { second } else { first }
}
