//! The take as tracks: the rotation or translation of a joint on every frame.

use glam::{DQuat, DVec4};

use genga::motion::{Clip, Pose, Poser};
use genga::time::Frame;

/// A moving channel of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Path {
    /// Local rotation: the components of a unit quaternion.
    Rotation,
    /// Local translation, in the file's unit, and 0.
    Translation,
}

impl Path {
    /// Reads the channel of a joint from a pose.
    fn of(self, pose: &Pose, joint: usize) -> DVec4 {
        match self {
            Self::Rotation => DVec4::from(pose.rotations[joint]),
            Self::Translation => pose.translations[joint].extend(0.0),
        }
    }
}

/// The samples of one track.
#[derive(Clone, Copy)]
pub(super) struct Samples<'a> {
    pub(super) path: Path,
    /// The frame of the first value.
    first: usize,
    values: &'a [DVec4],
}

impl<'a> Samples<'a> {
    /// Wraps values that are independent numbers, the first on frame 0.
    pub(super) fn of_numbers(values: &'a [DVec4]) -> Self {
        Self { path: Path::Translation, first: 0, values }
    }

    /// Samples a place, between two frames as the clip's poses are.
    pub(super) fn at(self, place: f64) -> DVec4 {
        let place = (place - self.first as f64).clamp(0.0, (self.values.len() - 1) as f64);
        let (before, share) = (place.floor() as usize, place - place.floor());
        let from = self.values[before];
        if share == 0.0 || from == self.values[before + 1] {
            return from;
        }
        let to = self.values[before + 1];
        match self.path {
            Path::Rotation => DQuat::from_vec4(from).slerp(DQuat::from_vec4(to), share).into(),
            Path::Translation => from.lerp(to, share),
        }
    }

    /// Returns the velocity at a place, per frame.
    pub(super) fn velocity(self, place: f64) -> DVec4 {
        let last = (self.first + self.values.len() - 1) as f64;
        let (from, to) = ((place - 1.0).max(self.first as f64), (place + 1.0).min(last));
        if to > from { (self.at(to) - self.at(from)) / (to - from) } else { DVec4::ZERO }
    }

    /// Whether all samples are equal.
    pub(super) fn is_constant(self) -> bool {
        self.values.iter().all(|value| *value == self.values[0])
    }

    /// Returns the first sample.
    pub(super) fn first_value(self) -> DVec4 {
        self.values[0]
    }
}

/// The samples of all joints, track by track and frame by frame.
pub(super) struct Take {
    first: usize,
    frames: usize,
    joints: usize,
    values: Vec<DVec4>,
}

impl Take {
    /// Samples the frames of a clip from `first` to `last`.
    pub(super) fn new(clip: &Clip, first: usize, last: usize) -> Self {
        let (frames, joints) = (last - first + 1, clip.skeleton().len());
        let mut values = vec![DVec4::ZERO; 2 * joints * frames];
        let mut poser = Poser::new(clip);
        for at in 0..frames {
            let pose = poser.frame(Frame(first + at));
            for joint in 0..joints {
                let turn = Path::Rotation.of(pose, joint);
                // q and −q are the same rotation: a curve through both would turn the long way round.
                let track = 2 * joint * frames + at;
                let is_far = at > 0 && turn.dot(values[track - 1]) < 0.0;
                values[track] = if is_far { -turn } else { turn };
                values[track + frames] = Path::Translation.of(pose, joint);
            }
        }
        Self { first, frames, joints, values }
    }

    /// Returns the samples of a joint's channel.
    pub(super) fn samples(&self, joint: usize, path: Path) -> Samples<'_> {
        let track = 2 * joint + usize::from(path == Path::Translation);
        let values = &self.values[track * self.frames..][..self.frames];
        Samples { path, first: self.first, values }
    }

    /// Returns all tracks, joint by joint.
    pub(super) fn tracks(&self) -> impl Iterator<Item = (usize, Path)> + use<> {
        (0..self.joints).flat_map(|joint| [(joint, Path::Rotation), (joint, Path::Translation)])
    }
}
