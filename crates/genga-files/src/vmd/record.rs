//! The VMD file format: the contents of a motion for MMD, and their byte layout.

use serde::Serialize;

use genga::error::Error;
use genga::motion::body::names::bones::{LONGEST_NAME, cp932};

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
    /// Inverse kinematics (IK) switched off on frame 0, by the names of their bones.
    pub ik_off: Vec<String>,
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
    /// Encodes the file: signature, model, bone keys, no morphs, no camera, no light, no self-shadow. One property
    /// record follows if there is IK to switch off.
    ///
    /// # Errors
    /// [`Error::Setting`] if a name cannot be encoded in CP932 or is too long: 15 bytes for a bone,
    /// 20 for the model and for IK.
    pub fn bytes(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::with_capacity(100 + 111 * self.keys.len());
        bytes.extend(padded::<30>(b"Vocaloid Motion Data 0002"));
        bytes.extend(padded::<LONGEST_MODEL>(&cp932(&self.model, LONGEST_MODEL)?));
        bytes.extend(count(self.keys.len())?);
        for key in &self.keys {
            bytes.extend(padded::<LONGEST_NAME>(&cp932(&key.bone, LONGEST_NAME)?));
            bytes.extend(key.frame.to_le_bytes());
            let numbers = key.translation.iter().chain(&key.rotation);
            numbers.for_each(|number| bytes.extend(number.to_le_bytes()));
            bytes.extend(interpolation(&key.curves));
        }
        let (morphs, cameras, lights, shadows) = ([0; 4], [0; 4], [0; 4], [0; 4]);
        [morphs, cameras, lights, shadows].iter().for_each(|none| bytes.extend(none));
        self.write_properties(&mut bytes)?;
        Ok(bytes)
    }

    fn write_properties(&self, bytes: &mut Vec<u8>) -> Result<(), Error> {
        if self.ik_off.is_empty() {
            bytes.extend(count(0)?);
            return Ok(());
        }
        bytes.extend(count(1)?);
        let (frame, visible) = (0u32, 1u8);
        bytes.extend(frame.to_le_bytes());
        bytes.push(visible);
        bytes.extend(count(self.ik_off.len())?);
        for bone in &self.ik_off {
            bytes.extend(padded::<LONGEST_MODEL>(&cp932(bone, LONGEST_MODEL)?));
            bytes.push(0);
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
