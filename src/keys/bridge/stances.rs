//! The local poses between which bridges are built.

use std::array;

use glam::DVec3;

use crate::motion::Clip;
use crate::motion::clip::lane_poser::LanePoser;
use crate::motion::clip::rig::Rig;
use crate::motion::lanes::{LANES, LaneQuat, wide};
use crate::time::Frame;

/// The local pose of each frame, read once for all bridges that begin or end there.
#[derive(Clone)]
pub(super) struct Stances {
    /// Frames × groups of [`LANES`] joints.
    rotations: Vec<LaneQuat>,
    /// Frames × joints that have a position of their own.
    translations: Vec<DVec3>,
    groups: usize,
    /// The joints that have a position of their own.
    moving: Vec<usize>,
}

impl Stances {
    pub(super) fn new(clip: &Clip, rig: &Rig, frames: &[Frame]) -> Self {
        let moving: Vec<usize> = rig.moving().collect();
        let groups = rig.len().div_ceil(LANES);
        let mut rotations = vec![LaneQuat::default(); frames.len() * groups];
        let mut translations = Vec::with_capacity(frames.len() * moving.len());
        let mut poser = LanePoser::new(clip);
        let into = rotations.chunks_mut((LANES * groups).max(1));
        for (frames, rotations) in frames.chunks(LANES).zip(into) {
            let frame = |lane: usize| frames[lane.min(frames.len() - 1)];
            wide(
                #[inline(always)]
                || {
                    poser.rows(&array::from_fn(|lane| clip.row(frame(lane))));
                },
            );
            let pose = poser.pose();
            for (lane, groups) in rotations.chunks_exact_mut(groups).enumerate() {
                for (joint, rotation) in pose.rotations.iter().enumerate() {
                    groups[joint / LANES].set_lane(joint % LANES, rotation.lane(lane));
                }
                translations
                    .extend(moving.iter().map(|joint| pose.translations[*joint].lane(lane)));
            }
        }
        Self { rotations, translations, groups, moving }
    }

    /// Number of groups of [`LANES`] joints in a pose.
    pub(super) fn groups(&self) -> usize {
        self.groups
    }

    /// Returns the joints that have a position of their own.
    pub(super) fn moving(&self) -> &[usize] {
        &self.moving
    }

    /// Returns the rotations of a frame's joints, [`LANES`] joints together.
    pub(super) fn rotations(&self, at: usize) -> &[LaneQuat] {
        &self.rotations[at * self.groups..(at + 1) * self.groups]
    }

    /// Returns the positions of the moving joints of a frame.
    pub(super) fn translations(&self, at: usize) -> &[DVec3] {
        let moving = self.moving.len();
        &self.translations[at * moving..(at + 1) * moving]
    }
}
