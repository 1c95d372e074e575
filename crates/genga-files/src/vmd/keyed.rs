//! Keys at the genga with MMD's own curves (補間曲線) between them.

use glam::{DQuat, DVec3};

use super::record::{LINEAR_CURVE, VmdKey};
use crate::curves::{GIRTH, body_height, turn_between};
use crate::humanoid::retarget::{Local, Retarget};
use genga::motion::{Clip, JointId};

/// First coordinates of the two handles of a fitted curve, of 127. At a third and two thirds of the time a curve's
/// parameter is the time itself, so that its heights are found by linear least squares.
const THIRDS: [u8; 2] = [42, 85];

/// Weight of a straight line beside the samples of a span. It decides only where there are too few.
const RIDGE: f64 = 1e-6;

/// A motion with keys on some frames.
pub(super) struct KeyedMotion {
    /// Keys of all bones, by frame.
    pub(super) keys: Vec<VmdKey>,
    /// Number of frames with keys.
    pub(super) frames: usize,
    /// Number of those that are no genga.
    pub(super) added: usize,
    /// Largest distance from the take with the genga alone, as a share of body height.
    pub(super) error_of_genga: f64,
}

/// Keys a motion on the frames of its genga, and adds frames until no bone is off the take by more than `error` of
/// body height. `retarget` has a drawing on every frame.
pub(super) fn keyed(
    clip: &Clip,
    retarget: &mut Retarget<'_>,
    (genga, length): (&[u32], usize),
    error: f64,
) -> KeyedMotion {
    let motion = Motion::new(clip, retarget, length);
    let mut frames = genga.to_vec();
    let mut error_of_genga = 0.0;
    let mut open: Vec<[usize; 2]> =
        genga.windows(2).map(|ends| [ends[0] as usize, ends[1] as usize]).collect();
    // A curve ends at its keys, so a new key changes no other span.
    for at in 0.. {
        let Some(ends) = open.get(at).copied() else { break };
        let (frame, off) = Span::new(&motion, ends).worst(&motion);
        if at + 1 < genga.len() {
            error_of_genga = f64::max(error_of_genga, off);
        }
        if off > error {
            frames.push(frame as u32);
            open.extend([[ends[0], frame], [frame, ends[1]]]);
        }
    }
    frames.sort_unstable();
    let keys = motion.keys(retarget, &frames);
    let added = frames.len() - genga.len();
    KeyedMotion { keys, frames: frames.len(), added, error_of_genga }
}

/// The poses of a model on every frame, and the body that they move: the capture's, bone by bone.
struct Motion {
    bones: Vec<BodyBone>,
    /// The bones, each behind the one that carries it.
    order: Vec<usize>,
    /// Poses, frame by frame and bone by bone.
    locals: Vec<Local>,
    /// Body heights in a unit of the model.
    heights_in_unit: f64,
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

/// A bone in the world.
type World = (DQuat, DVec3);

impl Motion {
    fn new(clip: &Clip, retarget: &mut Retarget<'_>, length: usize) -> Self {
        let reaches = clip.skeleton().reaches();
        let height = body_height(clip, &reaches);
        let heights_in_unit = 1.0 / (retarget.scale * height);
        let (joints, carriers) = (retarget.joints(), retarget.carriers());
        let count = joints.len();
        let mut locals = Vec::with_capacity(length * count);
        for frame in 1..length {
            locals.extend(retarget.take(frame, frame));
        }
        // The first frame last: the body stays in it.
        locals.splice(0..0, retarget.take(0, 0));
        let place = |bone: usize| {
            joints[bone].map(|joint| retarget.place(JointId(joint)) / height).unwrap_or_default()
        };
        let up = |bone: &usize| carriers[*bone];
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|bone| std::iter::successors(Some(*bone), up).count());
        let bones = Vec::with_capacity(count);
        let mut motion = Self { bones, order, locals, heights_in_unit };
        let worlds = motion.turns(&carriers);
        for bone in 0..count {
            let carrier = carriers[bone].filter(|carrier| joints[*carrier].is_some());
            let offset = carrier.map_or(DVec3::ZERO, |carrier| {
                worlds[carrier].inverse() * (place(bone) - place(carrier))
            });
            let is_last = !carriers.contains(&Some(bone));
            let reach =
                joints[bone].filter(|_| is_last).map_or(0.0, |joint| reaches[joint] / height);
            motion.bones.push(BodyBone { carrier: carriers[bone], offset, lever: GIRTH + reach });
        }
        motion
    }

    /// Rotations of all bones in the world on the first frame.
    fn turns(&self, carriers: &[Option<usize>]) -> Vec<DQuat> {
        let turn = |bone: usize| {
            let up = |bone: &usize| carriers[*bone];
            let chain = std::iter::successors(Some(bone), up);
            chain.fold(DQuat::IDENTITY, |turn, bone| self.locals[bone].rotation * turn)
        };
        (0..carriers.len()).map(turn).collect()
    }

    fn local(&self, frame: usize, bone: usize) -> Local {
        self.locals[frame * self.bones.len() + bone]
    }

    /// Places the bones of a pose.
    fn place(&self, pose: impl Fn(usize) -> Local, worlds: &mut Vec<World>) {
        worlds.resize(self.bones.len(), World::default());
        for &bone in &self.order {
            let BodyBone { carrier, offset, .. } = self.bones[bone];
            let Local { rotation, translation } = pose(bone);
            let (turn, place) = carrier.map_or_else(World::default, |carrier| worlds[carrier]);
            let moved = place + turn * offset + translation * self.heights_in_unit;
            worlds[bone] = (turn * rotation, moved);
        }
    }

    /// How far two poses are apart at most, as a share of body height.
    fn apart(&self, a: &[World], b: &[World]) -> f64 {
        let bones = self.bones.iter().zip(a).zip(b);
        let off =
            bones.map(|((bone, a), b)| a.1.distance(b.1) + bone.lever * turn_between(a.0, b.0));
        off.fold(0.0, f64::max)
    }

    /// Writes the keys of all bones on some frames, each with the curve that leads to it.
    fn keys(&self, retarget: &Retarget<'_>, frames: &[u32]) -> Vec<VmdKey> {
        let bones = retarget.bones();
        let mut before = self.locals[..bones.len()].to_vec();
        let mut keys = Vec::with_capacity(bones.len() * frames.len());
        for (at, &frame) in frames.iter().enumerate() {
            let span = at
                .checked_sub(1)
                .map(|before| Span::new(self, [frames[before] as usize, frame as usize]));
            for (bone, before) in before.iter_mut().enumerate() {
                let mut local = self.local(frame as usize, bone);
                // q and −q are the same rotation, but MMD would interpolate between them the long way round.
                if local.rotation.dot(before.rotation) < 0.0 {
                    local.rotation = -local.rotation;
                }
                *before = local;
                let mut key = retarget.key(bones[bone], frame, local);
                if let Some(span) = &span {
                    key.curves = span.eases[bone].map(Ease::bytes);
                }
                keys.push(key);
            }
        }
        keys
    }
}

/// The curves of all bones from one key to the next: of x, y, z and the rotation.
struct Span {
    ends: [usize; 2],
    eases: Vec<[Ease; 4]>,
}

impl Span {
    fn new(motion: &Motion, ends: [usize; 2]) -> Self {
        let eases = (0..motion.bones.len()).map(|bone| {
            let [from, to] = ends.map(|frame| motion.local(frame, bone));
            let ease = |done: &dyn Fn(Local) -> Option<f64>| {
                Ease::fit(ends, |frame| done(motion.local(frame, bone)))
            };
            let axis = |axis: usize| {
                let way = to.translation[axis] - from.translation[axis];
                ease(&|local| share(local.translation[axis] - from.translation[axis], way))
            };
            let turn = from.rotation.inverse() * to.rotation;
            let turned = |local: Local| {
                let [part, whole] =
                    [from.rotation.inverse() * local.rotation, turn].map(DQuat::to_scaled_axis);
                share(part.dot(whole), whole.length_squared())
            };
            [axis(0), axis(1), axis(2), ease(&turned)]
        });
        Self { ends, eases: eases.collect() }
    }

    /// The pose of a bone at a share of the time, as the curves have it.
    fn pose(&self, motion: &Motion, bone: usize, time: f64) -> Local {
        let [from, to] = self.ends.map(|frame| motion.local(frame, bone));
        let [x, y, z, turn] = self.eases[bone].map(|ease| ease.done(time));
        let way = (to.translation - from.translation) * DVec3::new(x, y, z);
        Local {
            translation: from.translation + way,
            rotation: from.rotation.slerp(to.rotation, turn),
        }
    }

    /// Returns the frame on which the curves are furthest off, and by how much of body height.
    fn worst(&self, motion: &Motion) -> (usize, f64) {
        let [first, last] = self.ends;
        let (mut made, mut taken) = (Vec::new(), Vec::new());
        let mut worst = (first, 0.0);
        for frame in first + 1..last {
            let time = (frame - first) as f64 / (last - first) as f64;
            motion.place(|bone| self.pose(motion, bone, time), &mut made);
            motion.place(|bone| motion.local(frame, bone), &mut taken);
            let off = motion.apart(&made, &taken);
            if off > worst.1 {
                worst = (frame, off);
            }
        }
        worst
    }
}

/// Part of a whole, unless the whole is nothing.
fn share(part: f64, whole: f64) -> Option<f64> {
    (whole.abs() > 1e-9).then_some(part / whole)
}

/// A curve from key to key: the heights of its two handles, of 127; `None` is a straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ease(Option<[u8; 2]>);

impl Ease {
    /// Fits a curve to how much of the way is done on each frame.
    fn fit([first, last]: [usize; 2], done: impl Fn(usize) -> Option<f64>) -> Self {
        let (mut early, mut late, mut both) = (RIDGE, RIDGE, 0.0);
        let mut sums = [RIDGE / 3.0, 2.0 * RIDGE / 3.0];
        for frame in first + 1..last {
            let time = (frame - first) as f64 / (last - first) as f64;
            let Some(done) = done(frame) else { return Self(None) };
            let [a, b] = weights(time);
            let rest = done - time.powi(3);
            early += a * a;
            both += a * b;
            late += b * b;
            sums[0] += a * rest;
            sums[1] += b * rest;
        }
        let whole = early * late - both * both;
        let heights =
            [(sums[0] * late - sums[1] * both) / whole, (sums[1] * early - sums[0] * both) / whole];
        let byte = |height: f64| (127.0 * height).round().clamp(0.0, 127.0) as u8;
        let heights = heights.map(byte);
        Self((heights != THIRDS).then_some(heights))
    }

    /// How much of the way is done at a share of the time.
    fn done(self, time: f64) -> f64 {
        let Some(heights) = self.0 else { return time };
        let [early, late] = heights.map(|height| f64::from(height) / 127.0);
        let [a, b] = weights(time);
        a * early + b * late + time.powi(3)
    }

    /// The four coordinates of the handles.
    fn bytes(self) -> [u8; 4] {
        match self.0 {
            Some([early, late]) => [THIRDS[0], early, THIRDS[1], late],
            None => LINEAR_CURVE,
        }
    }
}

/// Weights of the two handles at a share of the time.
fn weights(time: f64) -> [f64; 2] {
    let rest = 1.0 - time;
    [3.0 * rest * rest * time, 3.0 * rest * time * time]
}
