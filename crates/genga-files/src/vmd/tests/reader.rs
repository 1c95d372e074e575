//! A reader of VMD files, written from the layout and independent of the writer.

use encoding_rs::SHIFT_JIS;

use super::super::{VmdKey, VmdMotion};

/// The parsed file, including fields that the writer always sets alike.
pub(super) struct Read {
    pub(super) motion: VmdMotion,
    pub(super) interpolation: Vec<Vec<u8>>,
    pub(super) visible: Vec<u8>,
}

struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(count);
        self.0 = rest;
        taken
    }

    fn whole(&mut self) -> u32 {
        u32::from_le_bytes(self.take(4).try_into().unwrap())
    }

    fn single(&mut self) -> f32 {
        f32::from_le_bytes(self.take(4).try_into().unwrap())
    }

    fn name(&mut self, width: usize) -> String {
        let field = self.take(width);
        let end = field.iter().position(|byte| *byte == 0).unwrap_or(width);
        assert!(field[end..].iter().all(|byte| *byte == 0), "something stands behind a name");
        let (name, _, wrong) = SHIFT_JIS.decode(&field[..end]);
        assert!(!wrong, "a name is no CP932: {field:?}");
        name.into_owned()
    }
}

pub(super) fn read(bytes: &[u8]) -> Read {
    let mut bytes = Bytes(bytes);
    assert_eq!(bytes.name(30), "Vocaloid Motion Data 0002");
    let model = bytes.name(20);
    let (mut keys, mut interpolation) = (Vec::new(), Vec::new());
    for _ in 0..bytes.whole() {
        let bone = bytes.name(15);
        let frame = bytes.whole();
        let translation = [0; 3].map(|_| bytes.single());
        let rotation = [0; 4].map(|_| bytes.single());
        let rows = bytes.take(64).to_vec();
        // Coordinate by coordinate, curve by curve. The second row begins with the second byte of the first.
        let curves = [0, 1, 2, 3].map(|curve| {
            [0, 1, 2, 3].map(|coordinate| match 4 * coordinate + curve {
                0 => rows[0],
                at => rows[16 + at - 1],
            })
        });
        interpolation.push(rows);
        keys.push(VmdKey { bone, frame, translation, rotation, curves });
    }
    for section in ["morphs", "camera", "light", "self-shadow"] {
        assert_eq!(bytes.whole(), 0, "{section}");
    }
    let (mut ik_on, mut ik_off, mut visible) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..bytes.whole() {
        assert_eq!(bytes.whole(), 0, "the property record stands on frame 0");
        visible.push(bytes.take(1)[0]);
        for _ in 0..bytes.whole() {
            let name = bytes.name(20);
            match bytes.take(1) {
                [1] => ik_on.push(name),
                other => {
                    assert_eq!(other, [0]);
                    ik_off.push(name);
                }
            }
        }
    }
    assert!(bytes.0.is_empty(), "{} bytes are left", bytes.0.len());
    let motion = VmdMotion { model, keys, ik_on, ik_off, faces: vec![], shown: vec![] };
    Read { motion, interpolation, visible }
}
