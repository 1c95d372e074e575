//! The poses of a model on every frame, and the body that they move.

use glam::{DQuat, DVec3};

use super::super::record::VmdKey;
use super::legs::{IkLegs, rolled};
use super::span::Span;
use crate::curves::{GIRTH, body_height, turn_between};
use crate::humanoid::retarget::{Local, Retarget};
use genga::motion::{Clip, JointId};
use genga_read::MmdLeg;

/// The poses of a model on every frame, and the body that they move: the capture's, bone by bone, on the model's legs
/// where IK brings them to their feet.
pub(super) struct Motion {
    names: Vec<String>,
    bones: Vec<BodyBone>,
    /// The bones, each behind the one that carries it, ankles last.
    order: Vec<usize>,
    /// The legs that IK brings to their feet.
    legs: Vec<MmdLeg>,
    /// Poses, frame by frame and bone by bone.
    locals: Vec<Local>,
    /// Body heights in a unit of the model.
    heights_in_unit: f64,
    /// Largest distance of a knee from the take on account of its IK, as a share of body height.
    pub(super) error_of_knees: f64,
}

/// A bone of the capture's body. Lengths are shares of body height.
#[derive(Debug, Clone, Copy)]
struct BodyBone {
    carrier: Option<usize>,
    /// Way from the carrier's joint, in the carrier's axes.
    offset: DVec3,
    /// How far the skin and what else hangs on it moves if it turns by a radian.
    lever: f64,
}

/// Bones in the world.
#[derive(Debug, Clone, Default)]
pub(super) struct Worlds {
    turns: Vec<DQuat>,
    places: Vec<DVec3>,
}

impl Worlds {
    fn turn(&self, bone: Option<usize>) -> DQuat {
        bone.map_or(DQuat::IDENTITY, |bone| self.turns[bone])
    }

    fn place(&self, bone: Option<usize>) -> DVec3 {
        bone.map_or(DVec3::ZERO, |bone| self.places[bone])
    }

    fn put(&mut self, bone: usize, (turn, place): (DQuat, DVec3)) {
        self.turns[bone] = turn;
        self.places[bone] = place;
    }
}

impl Motion {
    pub(super) fn new(
        clip: &Clip,
        retarget: &mut Retarget<'_>,
        legs: &IkLegs<'_>,
        length: usize,
    ) -> Self {
        let poses = poses(retarget, length);
        let mut motion = Self::of_capture(clip, retarget, &poses[0]);
        motion.stand(legs);
        for pose in poses {
            let pose = motion.footed(pose);
            motion.locals.extend(pose);
        }
        motion
    }

    /// Builds the capture's body, which stands in the pose taken last.
    fn of_capture(clip: &Clip, retarget: &Retarget<'_>, pose: &[Local]) -> Self {
        let reaches = clip.skeleton().reaches();
        let height = body_height(clip, &reaches);
        let (joints, carriers) = (retarget.joints(), retarget.carriers());
        let place = |bone: usize| {
            joints[bone].map(|joint| retarget.place(JointId(joint)) / height).unwrap_or_default()
        };
        let turns = turns(pose, &carriers);
        let bone = |bone: usize| {
            let carrier = carriers[bone].filter(|carrier| joints[*carrier].is_some());
            let offset = carrier.map_or(DVec3::ZERO, |carrier| {
                turns[carrier].inverse() * (place(bone) - place(carrier))
            });
            let is_last = !carriers.contains(&Some(bone));
            let reach =
                joints[bone].filter(|_| is_last).map_or(0.0, |joint| reaches[joint] / height);
            BodyBone { carrier: carriers[bone], offset, lever: GIRTH + reach }
        };
        let names = retarget.bones().into_iter().map(|bone| retarget.name(bone).to_owned());
        let mut motion = Self {
            names: names.collect(),
            bones: (0..joints.len()).map(bone).collect(),
            order: Vec::new(),
            legs: Vec::new(),
            locals: Vec::new(),
            heights_in_unit: 1.0 / (retarget.scale * height),
            error_of_knees: 0.0,
        };
        motion.sort();
        motion
    }

    fn carried_by(&self, bone: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(bone), |bone| self.bones[*bone].carrier)
    }

    /// Sorts the bones. An ankle is brought to its foot when it is placed.
    fn sort(&mut self) {
        let rank = |bone: &usize| {
            let is_ankle = |bone: usize| self.legs.iter().any(|leg| leg.joints[2] == bone);
            (self.carried_by(*bone).any(is_ankle), self.carried_by(*bone).count())
        };
        let mut order: Vec<usize> = (0..self.bones.len()).collect();
        order.sort_by_key(rank);
        self.order = order;
    }

    /// Puts the body on the legs of the model, and adds the IK bones.
    fn stand(&mut self, legs: &IkLegs<'_>) {
        let ankles: Vec<usize> = legs.legs.iter().map(|leg| leg.joints[2]).collect();
        let mut chain: Vec<usize> =
            ankles.iter().flat_map(|ankle| self.carried_by(*ankle)).collect();
        chain.sort_unstable();
        chain.dedup();
        for bone in chain {
            let carrier = self.bones[bone].carrier;
            self.bones[bone].offset = self.rest_way(legs, carrier, &self.names[bone]);
        }
        for leg in &legs.legs {
            let target = self.add(legs, &leg.foot);
            let toes = leg.toes.as_ref().map(|name| {
                let way = self.rest_way(legs, Some(leg.joints[2]), name);
                (way, self.add(legs, name))
            });
            self.legs.push(MmdLeg { joints: leg.joints, target, toes });
        }
        self.sort();
    }

    /// The way from a bone to another in the model at rest, as a share of body height.
    fn rest_way(&self, legs: &IkLegs<'_>, from: Option<usize>, to: &str) -> DVec3 {
        let from = from.map_or(DVec3::ZERO, |from| legs.place(&self.names[from]));
        self.heights_in_unit * (legs.place(to) - from)
    }

    /// Adds an IK bone.
    fn add(&mut self, legs: &IkLegs<'_>, name: &str) -> usize {
        let find = |above: &str| self.names.iter().position(|own| own == above);
        let carrier = legs.above(name).find_map(find);
        let offset = self.rest_way(legs, carrier, name);
        self.names.push(name.to_owned());
        self.bones.push(BodyBone { carrier, offset, lever: GIRTH });
        self.bones.len() - 1
    }

    /// Converts a pose to one in which IK brings the legs to their feet.
    fn footed(&mut self, mut pose: Vec<Local>) -> Vec<Local> {
        let rest = Local { translation: DVec3::ZERO, rotation: DQuat::IDENTITY };
        pose.resize(self.bones.len(), rest);
        let mut worlds = Worlds::default();
        self.lay(&[], |bone| pose[bone], &mut worlds);
        for at in 0..self.legs.len() {
            let MmdLeg { joints: [hip, knee, ankle], target, toes } = self.legs[at];
            let (foot, place, was) =
                (worlds.turns[ankle], worlds.places[ankle], worlds.places[knee]);
            for (bone, way) in
                [(target, DVec3::ZERO)].into_iter().chain(toes.map(|(way, toes)| (toes, way)))
            {
                worlds.put(bone, (foot, place + foot * way));
                pose[bone] = self.local_of(bone, &worlds);
            }
            let ways = [was - worlds.places[hip], place - was];
            let along = self.bones[ankle].offset.normalize_or_zero().x;
            worlds.turns[hip] = rolled(worlds.turns[hip], ways, along);
            pose[hip] = self.local_of(hip, &worlds);
            pose[knee] = rest;
            for bone in [knee, ankle] {
                let world = self.carried(bone, rest, &worlds);
                worlds.put(bone, world);
            }
            self.legs[at].bring(false, &mut worlds.turns, &mut worlds.places);
            pose[ankle].rotation = (worlds.turns[knee].inverse() * foot).normalize();
            self.error_of_knees = self.error_of_knees.max(worlds.places[knee].distance(was));
        }
        pose
    }

    /// The world of a bone in its local pose.
    fn carried(&self, bone: usize, local: Local, worlds: &Worlds) -> (DQuat, DVec3) {
        let BodyBone { carrier, offset, .. } = self.bones[bone];
        let (turn, place) = (worlds.turn(carrier), worlds.place(carrier));
        (turn * local.rotation, place + turn * (offset + self.heights_in_unit * local.translation))
    }

    /// The local pose of an IK bone or a thigh in the world.
    fn local_of(&self, bone: usize, worlds: &Worlds) -> Local {
        let BodyBone { carrier, offset, .. } = self.bones[bone];
        let back = worlds.turn(carrier).inverse();
        let way = back * (worlds.places[bone] - worlds.place(carrier)) - offset;
        Local {
            translation: way / self.heights_in_unit,
            rotation: (back * worlds.turns[bone]).normalize(),
        }
    }

    /// Number of bones, with IK bones.
    pub(super) fn bones(&self) -> usize {
        self.bones.len()
    }

    pub(super) fn local(&self, frame: usize, bone: usize) -> Local {
        self.locals[frame * self.bones.len() + bone]
    }

    /// Places the bones of a pose.
    pub(super) fn place(&self, pose: impl Fn(usize) -> Local, worlds: &mut Worlds) {
        self.lay(&self.legs, pose, worlds);
    }

    /// Places the bones of a pose in which IK brings some legs to their feet.
    fn lay(&self, legs: &[MmdLeg], pose: impl Fn(usize) -> Local, worlds: &mut Worlds) {
        worlds.turns.resize(self.bones.len(), DQuat::IDENTITY);
        worlds.places.resize(self.bones.len(), DVec3::ZERO);
        for &bone in &self.order {
            worlds.put(bone, self.carried(bone, pose(bone), worlds));
            if let Some(leg) = legs.iter().find(|leg| leg.joints[2] == bone) {
                leg.bring(true, &mut worlds.turns, &mut worlds.places);
            }
        }
    }

    /// How far two poses are apart at most, as a share of body height.
    pub(super) fn apart(&self, a: &Worlds, b: &Worlds) -> f64 {
        let off = self.bones.iter().enumerate().map(|(bone, BodyBone { lever, .. })| {
            a.places[bone].distance(b.places[bone])
                + lever * turn_between(a.turns[bone], b.turns[bone])
        });
        off.fold(0.0, f64::max)
    }

    /// Writes the keys of all bones on some frames, each with the curve that leads to it.
    pub(super) fn keys(&self, frames: &[u32]) -> Vec<VmdKey> {
        // MMD bends the knee of a leg with IK.
        let is_keyed = |bone: &usize| self.legs.iter().all(|leg| leg.joints[1] != *bone);
        let keyed: Vec<usize> = (0..self.bones.len()).filter(is_keyed).collect();
        let mut before = self.locals[..self.bones.len()].to_vec();
        let mut keys = Vec::with_capacity(keyed.len() * frames.len());
        for (at, &frame) in frames.iter().enumerate() {
            let span = at
                .checked_sub(1)
                .map(|before| Span::new(self, [frames[before] as usize, frame as usize]));
            for &bone in &keyed {
                let mut local = self.local(frame as usize, bone);
                // q and −q are the same rotation, but MMD would interpolate between them the long way round.
                if local.rotation.dot(before[bone].rotation) < 0.0 {
                    local.rotation = -local.rotation;
                }
                before[bone] = local;
                let mut key = VmdKey::new(&self.names[bone], frame, local);
                if let Some(span) = &span {
                    key.curves = span.curves(bone);
                }
                keys.push(key);
            }
        }
        keys
    }
}

/// Returns the poses on all frames. The body stands in the first one afterwards.
fn poses(retarget: &mut Retarget<'_>, length: usize) -> Vec<Vec<Local>> {
    let mut poses: Vec<_> = (0..length).rev().map(|frame| retarget.take(frame, frame)).collect();
    poses.reverse();
    poses
}

/// Rotations of all bones in the world.
fn turns(pose: &[Local], carriers: &[Option<usize>]) -> Vec<DQuat> {
    let turn = |bone: usize| {
        let up = |bone: &usize| carriers[*bone];
        let chain = std::iter::successors(Some(bone), up);
        chain.fold(DQuat::IDENTITY, |turn, bone| pose[bone].rotation * turn)
    };
    (0..carriers.len()).map(turn).collect()
}
