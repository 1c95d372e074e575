//! Short digests that identify a sheet, its clip, and the files of a folder. They detect mistakes, not forgeries.

use super::layer::LayerLines;
use genga::exaggerate::Exaggerate;
use genga::motion::{Axis, Channel, Clip, Skeleton};
use genga::sheet::{Feet, RootMotion, Sheet};

/// FNV-1a of 64 bits, taking whole 64-bit words.
struct Digest(u64);

impl Digest {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        // Multiplication carries upwards only. Without this, the sign bit would hardly affect the digest.
        self.0 ^= self.0 >> 32;
    }

    fn number(&mut self, value: f64) {
        // Adding 0 turns −0 into 0, as writing to a file does.
        self.word((value + 0.0).to_bits());
    }

    fn text(self) -> String {
        format!("{:016x}", self.0)
    }
}

/// Digest of the joints' parents, offsets, channels and End Sites. Names are left out.
pub(crate) fn skeleton(skeleton: &Skeleton) -> String {
    let mut digest = Digest::new();
    for joint in &skeleton.joints {
        digest.word(joint.parent.map_or(u64::MAX, |parent| parent.0 as u64));
        joint.offset.to_array().into_iter().for_each(|value| digest.number(value));
        digest.word(joint.channels.len() as u64);
        joint.channels.iter().for_each(|channel| digest.word(number_of(*channel)));
        digest.word(joint.end_sites.len() as u64);
        for end in &joint.end_sites {
            end.offset.to_array().into_iter().for_each(|value| digest.number(value));
        }
    }
    digest.text()
}

/// Digest of every channel value of every frame.
pub(crate) fn motion(clip: &Clip) -> String {
    let mut digest = Digest::new();
    clip.rows().flatten().for_each(|value| digest.number(*value));
    digest.text()
}

/// Digest of a file's length and bytes.
pub(crate) fn bytes(bytes: &[u8]) -> String {
    let mut digest = Digest::new();
    digest.word(bytes.len() as u64);
    let (words, rest) = bytes.as_chunks::<8>();
    words.iter().for_each(|word| digest.word(u64::from_le_bytes(*word)));
    rest.iter().for_each(|byte| digest.word(u64::from(*byte)));
    digest.text()
}

/// Digest of the layers as lines with drawings from 0, as in the first schema, the spoken lines, the exaggeration,
/// root and feet if they are not moved with their drawings, and blank koma,
/// camera work and slate if there are any.
pub(super) fn sheet(sheet: &Sheet, exaggerate: &Exaggerate) -> String {
    let mut digest = Digest::new();
    for layer in &sheet.layers {
        let text =
            serde_json::to_string(&LayerLines::new(layer, 0)).expect("a layer is plain data");
        text.bytes().for_each(|byte| digest.word(u64::from(byte)));
    }
    if sheet.root == RootMotion::Ones {
        digest.word(1);
    }
    if sheet.feet == Feet::Held {
        digest.word(2);
    }
    if let Some(round) = sheet.repeat {
        digest.word(3);
        digest.word(round.frames as u64);
        digest.word(round.koma as u64);
    }
    if !sheet.lines.is_empty() {
        let text = serde_json::to_string(&sheet.lines).expect("lines are plain data");
        text.bytes().for_each(|byte| digest.word(u64::from(byte)));
    }
    if !sheet.blank.is_none() {
        digest.word(3);
        digest.word(sheet.blank.before as u64);
        digest.word(sheet.blank.after as u64);
    }
    if !sheet.camera.is_empty() {
        let text = serde_json::to_string(&sheet.camera).expect("camera work is plain data");
        text.bytes().for_each(|byte| digest.word(u64::from(byte)));
    }
    if !sheet.slate.is_empty() {
        digest.word(4);
        sheet.slate.to_string().bytes().for_each(|byte| digest.word(u64::from(byte)));
    }
    if !exaggerate.is_off() {
        let text = serde_json::to_string(exaggerate).expect("settings are plain data");
        text.bytes().for_each(|byte| digest.word(u64::from(byte)));
    }
    digest.text()
}

fn number_of(channel: Channel) -> u64 {
    let (kind, axis) = match channel {
        Channel::Position(axis) => (0, axis),
        Channel::Rotation(axis) => (3, axis),
    };
    let axis = match axis {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    };
    kind + axis
}
