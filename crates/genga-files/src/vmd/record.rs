//! The VMD file format: the contents of a motion for MMD, and their byte layout.

use serde::Serialize;

use genga::error::Error;
use genga::motion::body::names::bones::{LONGEST_NAME, cp932};
use genga_read::{MORPH_NAME, VmdCameraKey};

/// A frame of a VMD, from 0.
pub(super) type Frame = u32;

/// The name by which MMD knows the motion of a camera, and what it writes behind it.
const CAMERA: (&str, &[u8]) = ("カメラ・照明", b"\0on Data");

/// Maximum length of the name of a model or an IK bone, in bytes of CP932.
const LONGEST_MODEL: usize = 20;

/// The handles of a straight line, as MMD writes it.
pub(super) const LINEAR_CURVE: [u8; 4] = [20, 20, 107, 107];

/// The curves of a key that moves straight in all channels.
pub(crate) const LINEAR: [[u8; 4]; 4] = [LINEAR_CURVE; 4];

/// Lays out the curves of a key: a row of 16 bytes, each coordinate of all four curves, followed by the same row shifted
/// left by 1, 2 and 3 and filled with zeros. MMD reads every fourth byte of each row; several players (three.js, saba)
/// read the first row alone. Newer versions of MMD keep a physics switch in bytes 2 and 3 (0 on, 99 15 off), so their own
/// files turn wrongly in those players. The curves stay there, as in older files; no handle here is 99 15.
fn interpolation(curves: &[[u8; 4]; 4]) -> [u8; 64] {
    let mut bytes = [0; 64];
    for (at, byte) in bytes.iter_mut().enumerate() {
        let place = at / 16 + at % 16;
        if place < 16 {
            *byte = curves[place % 4][place / 4];
        }
    }
    bytes
}

/// A motion for MMD: the contents of a `.vmd` file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VmdMotion {
    /// Name of the target model. MMD warns if another model loads it, but loads it.
    pub model: String,
    /// Keys of bones, sorted by frame and then by bone.
    pub keys: Vec<VmdKey>,
    /// Inverse kinematics (IK) switched on on frame 0, by the names of their bones.
    pub ik_on: Vec<String>,
    /// IK switched off on frame 0.
    pub ik_off: Vec<String>,
    /// Keys of morphs (表情), sorted by frame.
    pub faces: Vec<VmdFaceKey>,
    /// Frames from which the model is shown or hidden; empty for a model that is always shown.
    pub shown: Vec<(u32, bool)>,
}

/// A key of a morph (表情).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VmdFaceKey {
    /// The bytes of its name, at most 15, as they are in the source.
    pub name: Vec<u8>,
    /// The frame, from 0.
    pub frame: u32,
    /// Its weight, 0 to 1.
    pub weight: f32,
}

/// The motion of MMD's camera (カメラモーション), which is a file of its own, with that of light and shadow.
#[derive(Debug, Clone, PartialEq)]
pub struct VmdCameraMotion {
    /// Keys of the camera, sorted by frame.
    pub keys: Vec<VmdCameraKey>,
    /// Colour and direction of the light, by frame.
    pub light: Vec<(u32, Vec<f64>)>,
    /// Mode and distance of the shadow, by frame.
    pub shadow: Vec<(u32, Vec<f64>)>,
}

impl VmdCameraMotion {
    /// Whether it has no key.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty() && self.light.is_empty() && self.shadow.is_empty()
    }

    /// Encodes the file, which has no bones and no morphs.
    ///
    /// # Errors
    /// [`Error::Clip`] if there are more keys than a file holds.
    pub fn bytes(&self) -> Result<Vec<u8>, Error> {
        let name = [&cp932(CAMERA.0, LONGEST_MODEL)?[..], CAMERA.1].concat();
        let mut bytes = head(&name);
        bytes.extend([0; 8]);
        bytes.extend(count(self.keys.len())?);
        for key in &self.keys {
            bytes.extend(key.frame.to_le_bytes());
            key.values[..7].iter().for_each(|value| bytes.extend((*value as f32).to_le_bytes()));
            bytes.extend(key.curves);
            bytes.extend((key.values[7].round() as u32).to_le_bytes());
            bytes.push(key.perspective);
        }
        bytes.extend(count(self.light.len())?);
        for (frame, values) in &self.light {
            bytes.extend(frame.to_le_bytes());
            values.iter().for_each(|value| bytes.extend((*value as f32).to_le_bytes()));
        }
        bytes.extend(count(self.shadow.len())?);
        for (frame, values) in &self.shadow {
            bytes.extend(frame.to_le_bytes());
            bytes.push(values[0] as u8);
            bytes.extend((values[1] as f32).to_le_bytes());
        }
        bytes.extend(count(0)?);
        Ok(bytes)
    }
}

/// Encodes signature and model.
fn head(model: &[u8]) -> Vec<u8> {
    let mut bytes = padded::<30>(b"Vocaloid Motion Data 0002").to_vec();
    bytes.extend(padded::<LONGEST_MODEL>(model));
    bytes
}

/// A key of a bone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VmdKey {
    /// The bone (ボーン).
    pub bone: String,
    /// The frame, from 0.
    pub frame: u32,
    /// Translation from its rest position, in MMD units and MMD's left-handed axes.
    pub translation: [f32; 3],
    /// Rotation relative to its parent and its rest: a unit quaternion x, y, z, w in the same axes.
    pub rotation: [f32; 4],
    /// Interpolation from the key before (補間曲線), of x, y, z and the rotation: a Bézier curve over the time from (0, 0)
    /// to (127, 127), by the coordinates x₁, y₁, x₂, y₂ of its two handles.
    pub curves: [[u8; 4]; 4],
}

impl VmdMotion {
    /// Encodes the file: signature, model, bone keys, morphs, no camera, no light, no self-shadow. Property records follow
    /// if there is IK to switch, or if the model is hidden at times.
    ///
    /// # Errors
    /// [`Error::Setting`] if a name cannot be encoded in CP932 or is too long: 15 bytes for a bone,
    /// 20 for the model and for IK.
    pub fn bytes(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = head(&cp932(&self.model, LONGEST_MODEL)?);
        bytes.reserve(100 + 111 * self.keys.len());
        bytes.extend(count(self.keys.len())?);
        for key in &self.keys {
            bytes.extend(padded::<LONGEST_NAME>(&cp932(&key.bone, LONGEST_NAME)?));
            bytes.extend(key.frame.to_le_bytes());
            let numbers = key.translation.iter().chain(&key.rotation);
            numbers.for_each(|number| bytes.extend(number.to_le_bytes()));
            bytes.extend(interpolation(&key.curves));
        }
        bytes.extend(count(self.faces.len())?);
        for key in &self.faces {
            bytes.extend(padded::<MORPH_NAME>(&key.name));
            bytes.extend(key.frame.to_le_bytes());
            bytes.extend(key.weight.to_le_bytes());
        }
        let (cameras, lights, shadows) = ([0; 4], [0; 4], [0; 4]);
        [cameras, lights, shadows].iter().for_each(|none| bytes.extend(none));
        self.write_properties(&mut bytes)?;
        Ok(bytes)
    }

    fn write_properties(&self, bytes: &mut Vec<u8>) -> Result<(), Error> {
        let on = self.ik_on.iter().map(|bone| (bone, true));
        let switches: Vec<_> = on.chain(self.ik_off.iter().map(|bone| (bone, false))).collect();
        let mut shown = self.shown.clone();
        if shown.first().is_none_or(|(frame, _)| *frame > 0) && !switches.is_empty() {
            shown.insert(0, (0, true));
        }
        bytes.extend(count(shown.len())?);
        for (frame, is_shown) in shown {
            bytes.extend(frame.to_le_bytes());
            bytes.push(u8::from(is_shown));
            bytes.extend(count(switches.len())?);
            for (bone, is_on) in &switches {
                bytes.extend(padded::<LONGEST_MODEL>(&cp932(bone, LONGEST_MODEL)?));
                bytes.push(u8::from(*is_on));
            }
        }
        Ok(())
    }
}

fn count(count: usize) -> Result<[u8; 4], Error> {
    let count = u32::try_from(count);
    count.map(u32::to_le_bytes).map_err(|_| Error::clip("too many keys for a VMD file"))
}

/// Pads a field with zeros to its width.
fn padded<const WIDTH: usize>(text: &[u8]) -> [u8; WIDTH] {
    let mut field = [0; WIDTH];
    field[..text.len()].copy_from_slice(text);
    field
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_row_has_all_curves() {
        let rows = [
            [20, 20, 20, 20, 20, 20, 20, 20, 107, 107, 107, 107, 107, 107, 107, 107],
            [20, 20, 20, 20, 20, 20, 20, 107, 107, 107, 107, 107, 107, 107, 107, 0],
            [20, 20, 20, 20, 20, 20, 107, 107, 107, 107, 107, 107, 107, 107, 0, 0],
            [20, 20, 20, 20, 20, 107, 107, 107, 107, 107, 107, 107, 107, 0, 0, 0],
        ];
        assert_eq!(interpolation(&LINEAR).to_vec(), rows.concat());
    }
}
