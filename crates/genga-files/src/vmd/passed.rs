//! What a VMD passes on that the timing does not touch: the face, whether the model is shown, and the camera.

use std::collections::BTreeMap;

use genga::error::Error;
use genga_read::{Between, Track, VmdBeside, VmdCamera, VmdCameraKey};

use super::record::{Frame, VmdCameraMotion, VmdFaceKey};
use crate::timeline::Timeline;

/// Time on its way to the frames of a VMD.
pub(super) struct Passing<'a> {
    pub(super) timeline: &'a Timeline,
    /// Frames of the VMD in a koma.
    pub(super) in_koma: f64,
}

/// The curves of a camera's key that moves straight: the handles x₁, x₂, y₁, y₂ six times.
const STRAIGHT: [u8; 4] = [20, 107, 20, 107];

impl Passing<'_> {
    /// Returns the keys of the face, sorted by frame.
    pub(super) fn faces(&self, beside: &VmdBeside) -> Result<Vec<VmdFaceKey>, Error> {
        let mut keys = Vec::new();
        for (name, track) in &beside.faces {
            let key = |(frame, value): (Frame, Vec<f64>)| VmdFaceKey {
                name: name.clone(),
                frame,
                weight: value[0] as f32,
            };
            keys.extend(self.keys(track, beside.frames)?.into_iter().map(key));
        }
        keys.sort_by_key(|key| key.frame);
        Ok(keys)
    }

    /// Returns the frames on which the model is shown or hidden.
    pub(super) fn shown(&self, beside: &VmdBeside) -> Result<Vec<(Frame, bool)>, Error> {
        let Some(track) = &beside.shown else { return Ok(Vec::new()) };
        let keys = self.keys(track, beside.frames)?;
        Ok(keys.into_iter().map(|(frame, value)| (frame, value[0] != 0.0)).collect())
    }

    /// Returns the motion of camera, light and shadow; `None` if the source has none.
    pub(super) fn camera(&self, beside: &VmdBeside) -> Result<Option<VmdCameraMotion>, Error> {
        let keys = |track: &Option<Track>| match track {
            Some(track) => self.keys(track, beside.frames),
            None => Ok(Vec::new()),
        };
        let motion = VmdCameraMotion {
            keys: self.camera_keys(&beside.camera, beside.frames)?,
            light: keys(&beside.light)?,
            shadow: keys(&beside.shadow)?,
        };
        Ok((!motion.is_empty()).then_some(motion))
    }

    /// Returns the keys of a track on frames. Of two on one frame the earlier comes a frame before. MMD has no steps, so a
    /// value that jumps is there again on the frame before.
    fn keys(&self, track: &Track, frames: f64) -> Result<Vec<(Frame, Vec<f64>)>, Error> {
        let places = track.places.iter().map(|place| place * frames).collect();
        let retimed = self.timeline.retimed(&Track { places, ..track.clone() });
        let mut keys: BTreeMap<Frame, Vec<f64>> = BTreeMap::new();
        let jumps = retimed.between == Between::Step && track.between == Between::Linear;
        for (key, koma) in retimed.places.iter().enumerate() {
            let frame = self.frame(*koma)?;
            let before =
                key.checked_sub(1).filter(|_| jumps).map(|key| retimed.value(key).to_vec());
            let before = keys.insert(frame, retimed.value(key).to_vec()).or(before);
            if let (Some(before), Some(earlier)) = (before, frame.checked_sub(1)) {
                keys.entry(earlier).or_insert(before);
            }
        }
        let keys: Vec<_> = keys.into_iter().collect();
        Ok(if jumps { bent(keys) } else { keys })
    }

    fn frame(&self, koma: f64) -> Result<Frame, Error> {
        let frame = (koma * self.in_koma + 0.5).floor();
        if frame <= f64::from(Frame::MAX) {
            Ok(frame as Frame)
        } else {
            Err(Error::clip("the sheet is too long for a VMD file"))
        }
    }

    /// Returns the keys of the camera: its own where a frame of the source is a frame of the VMD, or else one on each frame
    /// on which it moves, so that its cuts stay cuts.
    fn camera_keys(&self, camera: &VmdCamera, frames: f64) -> Result<Vec<VmdCameraKey>, Error> {
        match self.shift(camera, frames) {
            Some(shift) => Ok(shifted(camera, shift, self.frame(self.timeline.length())?)),
            None => self.baked(camera, frames),
        }
    }

    /// Returns the number of frames by which the camera's keys come later, if they may keep their curves.
    fn shift(&self, camera: &VmdCamera, frames: f64) -> Option<f64> {
        let (koma, place, pace) = self.timeline.only_pace()?;
        let first = f64::from(camera.keys.first()?.frame);
        let shift = (koma * self.in_koma + 0.5).floor() - place / frames;
        let is_even = (pace / frames / self.in_koma - 1.0).abs() < 1e-9;
        (is_even && shift.fract() == 0.0 && first + shift >= 0.0).then_some(shift)
    }

    fn baked(&self, camera: &VmdCamera, frames: f64) -> Result<Vec<VmdCameraKey>, Error> {
        let last = self.frame(self.timeline.length())?;
        let mut keys: Vec<VmdCameraKey> = Vec::new();
        let mut held: Option<VmdCameraKey> = None;
        for frame in 0..last {
            let place = self.timeline.place(f64::from(frame) / self.in_koma);
            let Some(state) = place.and_then(|place| camera.at(place / frames)) else { break };
            let curves = std::array::from_fn(|at| STRAIGHT[at % 4]);
            let key = VmdCameraKey { frame, curves, ..state };
            if keys.last().is_some_and(|before| before.values == key.values) {
                held = Some(key);
                continue;
            }
            keys.extend(held.take());
            keys.push(key);
        }
        keys.extend(held);
        Ok(keys)
    }
}

/// Moves the keys of a camera, up to the first one after the end.
fn shifted(camera: &VmdCamera, shift: f64, end: Frame) -> Vec<VmdCameraKey> {
    let keys = camera.keys.iter().map(|key| {
        let frame = (f64::from(key.frame) + shift) as Frame;
        VmdCameraKey { frame, ..*key }
    });
    let mut keys: Vec<VmdCameraKey> = keys.collect();
    let inside = keys.partition_point(|key| key.frame < end);
    keys.truncate(inside + 1);
    keys
}

/// Leaves out keys between two of the same value: a line through both passes there.
fn bent(keys: Vec<(Frame, Vec<f64>)>) -> Vec<(Frame, Vec<f64>)> {
    let is_bent = |at: usize| {
        let same = |other: Option<usize>| {
            other.and_then(|other| keys.get(other)).is_some_and(|other| other.1 == keys[at].1)
        };
        !(same(at.checked_sub(1)) && same(Some(at + 1)))
    };
    let places: Vec<usize> = (0..keys.len()).filter(|at| is_bent(*at)).collect();
    places.into_iter().map(|at| keys[at].clone()).collect()
}
