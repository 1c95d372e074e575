//! The curves of all bones from one key to the next.

use glam::{DQuat, DVec3};

use super::ease::{Ease, share};
use super::motion::{Motion, Worlds};
use crate::humanoid::retarget::Local;

/// The curves of all bones from one key to the next: of x, y, z and the rotation.
pub(super) struct Span {
    ends: [usize; 2],
    eases: Vec<[Ease; 4]>,
}

impl Span {
    pub(super) fn new(motion: &Motion, ends: [usize; 2]) -> Self {
        let eases = (0..motion.bones()).map(|bone| {
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

    /// The four curves of a bone, as a file has them.
    pub(super) fn curves(&self, bone: usize) -> [[u8; 4]; 4] {
        self.eases[bone].map(Ease::bytes)
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
    pub(super) fn worst(&self, motion: &Motion) -> (usize, f64) {
        let [first, last] = self.ends;
        let (mut made, mut taken) = (Worlds::default(), Worlds::default());
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
