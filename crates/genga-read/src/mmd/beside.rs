//! What a VMD holds beside the body: the face, the camera, the light, the shadow, and whether the model is shown.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::camera::{VmdCamera, VmdCameraKey};
use super::damaged;
use super::names::up_to_zero;
use super::record::Bytes;
use crate::reading::{Found, counted};
use crate::track::{Between, Track};
use genga::error::Error;
use genga::motion::CameraPath;

/// Bytes of a morph's name.
pub const MORPH_NAME: usize = 15;

/// What a VMD holds beside the bones (表情、カメラ、照明). Places of keys are frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VmdBeside {
    /// Weights of morphs, by the field of the name as it is in the file, up to its first zero.
    pub faces: BTreeMap<Vec<u8>, Track>,
    /// The camera.
    pub camera: VmdCamera,
    /// Colour and direction of the light.
    pub light: Option<Track>,
    /// Mode and distance of the self-shadow.
    pub shadow: Option<Track>,
    /// Whether the model is shown, 1 or 0.
    pub shown: Option<Track>,
    /// Frames of the clip in a frame of the file.
    pub frames: f64,
}

/// Bytes of the records behind the bones.
const MORPH: usize = MORPH_NAME + 8;
const CAMERA: usize = 61;
const LIGHT: usize = 28;
const SHADOW: usize = 9;

/// A record: its bytes, and its place in the file.
#[derive(Clone, Copy)]
struct Record<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Record<'_> {
    fn word(self, at: usize) -> u32 {
        u32::from_le_bytes(std::array::from_fn(|byte| self.bytes[at + byte]))
    }

    fn single(self, at: usize) -> Result<f64, Error> {
        let number = f64::from(f32::from_bits(self.word(at)));
        let message = "a key has a value that is no number";
        if number.is_finite() { Ok(number) } else { Err(damaged(self.at + at, message)) }
    }

    fn singles<const N: usize>(self, at: usize) -> Result<[f64; N], Error> {
        let mut numbers = [0.0; N];
        for (index, number) in numbers.iter_mut().enumerate() {
            *number = self.single(at + 4 * index)?;
        }
        Ok(numbers)
    }
}

impl Default for VmdBeside {
    fn default() -> Self {
        let (faces, camera) = (BTreeMap::new(), VmdCamera::default());
        Self { faces, camera, light: None, shadow: None, shown: None, frames: 1.0 }
    }
}

impl VmdBeside {
    /// Reads the records behind those of the bones, up to the switches of IK.
    pub(super) fn read(bytes: &mut Bytes<'_>) -> Result<Self, Error> {
        let mut faces: BTreeMap<Vec<u8>, Vec<(u32, [f64; 1])>> = BTreeMap::new();
        each(bytes, MORPH, "keys of the face", |record| {
            let name = up_to_zero(&record.bytes[..MORPH_NAME]).to_vec();
            let weight = record.singles(MORPH_NAME + 4)?;
            faces.entry(name).or_default().push((record.word(MORPH_NAME), weight));
            Ok(())
        })?;
        let mut camera = Vec::new();
        each(bytes, CAMERA, "keys of the camera", |record| {
            let [distance, x, y, z, turn_x, turn_y, turn_z] = record.singles(4)?;
            camera.push(VmdCameraKey {
                frame: record.word(0),
                values: [distance, x, y, z, turn_x, turn_y, turn_z, f64::from(record.word(56))],
                curves: std::array::from_fn(|at| record.bytes[32 + at]),
                perspective: record.bytes[60],
            });
            Ok(())
        })?;
        let (mut light, mut shadow) = (Vec::new(), Vec::new());
        each(bytes, LIGHT, "keys of the light", |record| {
            light.push((record.word(0), record.singles::<6>(4)?));
            Ok(())
        })?;
        each(bytes, SHADOW, "keys of the shadow", |record| {
            shadow.push((record.word(0), [f64::from(record.bytes[4]), record.single(5)?]));
            Ok(())
        })?;
        let face = |(name, keys)| Some((name, track(keys, Between::Linear)?));
        Ok(Self {
            faces: faces.into_iter().filter_map(face).collect(),
            camera: VmdCamera::new(camera),
            light: track(light, Between::Linear),
            shadow: track(shadow, Between::Step),
            ..Self::default()
        })
    }

    /// Sets whether the model is shown, by frame. A model that is always shown needs no key.
    pub(super) fn show(&mut self, shown: Vec<(u32, [f64; 1])>) {
        self.shown = track(shown, Between::Step).filter(|track| track.values.contains(&0.0));
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// The kinds of keys, with the number of each.
    pub fn counts(&self) -> Vec<(usize, &'static str)> {
        let count = |track: &Option<Track>| track.as_ref().map_or(0, |track| track.places.len());
        let faces = self.faces.values().map(|track| track.places.len()).sum();
        let all = [
            (faces, "keys of the face"),
            (self.camera.keys.len(), "keys of the camera"),
            (count(&self.light), "keys of the light"),
            (count(&self.shadow), "keys of the shadow"),
            (count(&self.shown), "keys that show or hide the model"),
        ];
        all.into_iter().filter(|(count, _)| *count > 0).collect()
    }

    /// Counts the keys in words: `keys of the face (12), keys of the camera (3)`; `None` if there are none.
    pub fn words(&self) -> Option<String> {
        counted(&self.counts())
    }

    /// Describes what there is, if anything.
    pub(super) fn found(&self) -> Option<Found> {
        Some(Found::new("beside", format!("beside the body: {}", self.words()?)))
    }

    /// Returns the way of the camera over some frames of the clip; `None` without a camera.
    pub(super) fn camera_path(&self, frames: usize) -> Option<CameraPath> {
        let poses = self.camera.poses((0..frames).map(|frame| frame as f64 / self.frames));
        (!poses.is_empty()).then(|| CameraPath { name: "カメラ".into(), poses })
    }
}

/// Calls `take` with each record of a kind. Files of older versions end before the kinds that they do not know.
fn each<'a>(
    bytes: &mut Bytes<'a>,
    size: usize,
    what: &str,
    mut take: impl FnMut(Record<'a>) -> Result<(), Error>,
) -> Result<(), Error> {
    if bytes.is_done() {
        return Ok(());
    }
    let count = bytes.count(size, what)?;
    let begin = bytes.at;
    let records = bytes.take(count * size, what)?.chunks_exact(size);
    records.zip((begin..).step_by(size)).try_for_each(|(bytes, at)| take(Record { bytes, at }))
}

/// Sorts keys into a track; the later of two on one frame wins, as with bones.
fn track<const N: usize>(mut keys: Vec<(u32, [f64; N])>, between: Between) -> Option<Track> {
    keys.reverse();
    keys.sort_by_key(|(frame, _)| *frame);
    keys.dedup_by_key(|(frame, _)| *frame);
    let places: Vec<f64> = keys.iter().map(|(frame, _)| f64::from(*frame)).collect();
    let values = keys.into_iter().flat_map(|(_, value)| value).collect();
    (!places.is_empty()).then_some(Track { places, values, width: N, between })
}
