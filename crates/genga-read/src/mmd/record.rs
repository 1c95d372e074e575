//! Reads the records of a VMD: bone keys and IK switches.

use std::collections::{BTreeMap, HashMap};

use glam::{DQuat, DVec3};

use super::beside::VmdBeside;
use super::curve::Curve;
use super::names::{self, Names};
use super::{RATE, SIGNATURE, damaged};
use crate::rates;
use genga::error::{Error, Place, Warning};

/// Bytes of each record or field: a bone key, its name, a switch of IK.
const KEY: usize = 111;
const NAME: usize = names::WIDTH;
const SWITCH: usize = 21;

/// A bone key, in right-handed axes with +Z in front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Key {
    pub(super) frame: u32,
    /// Offset from its rest position, in MMD units.
    pub(super) translation: DVec3,
    /// Rotation relative to its parent.
    pub(super) rotation: DQuat,
    /// Interpolation curves of X, Y, Z and the rotation, from the previous key to this one.
    pub(super) curves: [Curve; 4],
}

/// The bone data of a motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Motion {
    /// The model's name.
    pub(super) model: String,
    /// The encoding of the names.
    pub(super) names: Names,
    /// Keys by bone name, sorted by frame.
    pub(super) bones: BTreeMap<String, Vec<Key>>,
    /// Frames at which an IK is switched on or off, by the name of its bone, sorted.
    pub(super) switches: HashMap<String, Vec<(u32, bool)>>,
    /// The last keyed frame, and the byte offset of a key on it.
    pub(super) last: (u32, usize),
    /// What the file holds beside the bones.
    pub(super) beside: VmdBeside,
    /// The warning that keys lie too far behind the others to belong to this motion and are left out.
    pub(super) far: Option<Warning>,
}

/// The bytes of the file, and the offset of the next one.
pub(super) struct Bytes<'a> {
    all: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Bytes<'a> {
    pub(super) fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Error> {
        let taken = self.all.get(self.at..).and_then(|left| left.get(..count));
        let taken = taken.ok_or_else(|| {
            damaged(self.at, format!("the file ends in its {what}: {count} more bytes belong here"))
        })?;
        self.at += count;
        Ok(taken)
    }

    fn long(&mut self, what: &str) -> Result<u32, Error> {
        let bytes = self.take(4, what)?;
        Ok(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    }

    /// Reads the number of records that follow, and checks it against the bytes left.
    pub(super) fn count(&mut self, size: usize, what: &str) -> Result<usize, Error> {
        let at = self.at;
        let (count, left) = (self.long(what)? as usize, self.all.len() - self.at);
        if count > left / size {
            let message = format!("{count} {what} do not go into the {left} bytes that are left");
            return Err(damaged(at, message));
        }
        Ok(count)
    }

    /// Reads the bone-key records, as many as the file declares.
    fn records(&mut self, what: &str) -> Result<&'a [[u8; KEY]], Error> {
        let count = self.count(KEY, what)?;
        Ok(self.take(count * KEY, what)?.as_chunks().0)
    }

    /// Whether the file ends here. Files of older versions end between two kinds of records.
    pub(super) fn is_done(&self) -> bool {
        self.at >= self.all.len()
    }
}

impl Motion {
    /// Reads a VMD file that moves a body.
    ///
    /// # Errors
    /// [`Error::Motion`] with the byte if the file ends early, declares more records than it has, holds a
    /// non-finite number, or has no bone key.
    pub(super) fn read(all: &[u8]) -> Result<Self, Error> {
        let mut motion = Self::read_any(all)?;
        if motion.bones.is_empty() {
            let other = motion.beside.counts();
            let other: Vec<String> =
                other.into_iter().map(|(count, what)| format!("{count} {what}")).collect();
            let but = if other.is_empty() { "" } else { ", but " };
            let hint = if motion.beside.camera.keys.is_empty() {
                ""
            } else {
                "; give the motion of a body, and this with --camera-work"
            };
            let message = format!("this VMD has no key of a bone{but}{}{hint}", other.join(", "));
            return Err(damaged(all.len(), message));
        }
        motion.leave_out_far_keys()?;
        Ok(motion)
    }

    /// Reads a VMD file, which may have no bone.
    ///
    /// # Errors
    /// Those of [`Motion::read`], but for the bone key.
    pub(super) fn read_any(all: &[u8]) -> Result<Self, Error> {
        let mut bytes = Bytes { all, at: 0 };
        let signature = bytes.take(30, "signature")?;
        if !signature.starts_with(SIGNATURE) {
            return Err(damaged(0, "this is no VMD: expected Vocaloid Motion Data"));
        }
        // The first version, "Vocaloid Motion Data file", has a shorter name field.
        let is_first = signature[SIGNATURE.len()..].starts_with(b" file");
        let model = bytes.take(if is_first { 10 } else { 20 }, "model's name")?;
        let begin = bytes.at;
        let keys = bytes.records("keys of bones")?;
        let names = Names::new(&keys.iter().map(|record| &record[..NAME]).collect());
        let mut motion = Self {
            model: names.read(model),
            names,
            bones: BTreeMap::new(),
            switches: HashMap::new(),
            last: (0, begin),
            beside: VmdBeside::default(),
            far: None,
        };
        motion.read_keys(keys, begin + 4)?;
        motion.beside = VmdBeside::read(&mut bytes)?;
        motion.read_switches(&mut bytes)?;
        Ok(motion)
    }

    /// Reads the bone keys, the first of which begins at the byte `begin`.
    fn read_keys(&mut self, records: &[[u8; KEY]], begin: usize) -> Result<(), Error> {
        let mut names: HashMap<&[u8], String> = HashMap::new();
        for (record, at) in records.iter().zip((begin..).step_by(KEY)) {
            let field = &record[..NAME];
            let name = names.entry(field).or_insert_with(|| self.names.read(field));
            let key = Key::from_record(record, at, name)?;
            if key.frame >= self.last.0 {
                self.last = (key.frame, at);
            }
            match self.bones.get_mut(name.as_str()) {
                Some(keys) => keys.push(key),
                None => drop(self.bones.insert(name.clone(), vec![key])),
            }
        }
        for keys in self.bones.values_mut() {
            // The later of two keys on one frame wins, as if read over the other.
            keys.reverse();
            keys.sort_by_key(|key| key.frame);
            keys.dedup_by_key(|key| key.frame);
        }
        Ok(())
    }

    /// Drops the keys behind a gap too long for one motion, every frame of which would be played.
    fn leave_out_far_keys(&mut self) -> Result<(), Error> {
        let keys = self.bones.values().flatten().map(|key| key.frame);
        let mut frames: Vec<u32> = keys.chain([0]).collect();
        frames.sort_unstable();
        frames.dedup();
        let times: Vec<f64> = frames.iter().map(|frame| f64::from(*frame) / RATE).collect();
        let place = Place::Byte(self.last.1 as u64);
        let (near, far) = rates::cut(&times, place, |at| format!("frame {}", frames[at]))?;
        if far.is_none() {
            return Ok(());
        }
        let end = frames[near - 1];
        (self.far, self.last.0) = (far, end);
        self.bones.values_mut().for_each(|keys| keys.retain(|key| key.frame <= end));
        self.bones.retain(|_, keys| !keys.is_empty());
        Ok(())
    }

    fn read_switches(&mut self, bytes: &mut Bytes<'_>) -> Result<(), Error> {
        if bytes.is_done() {
            return Ok(());
        }
        let mut shown = Vec::new();
        for _ in 0..bytes.count(4 + 1 + 4, "switches of IK")? {
            let frame = bytes.long("switches of IK")?;
            let is_shown = bytes.take(1, "switches of IK")? != [0];
            shown.push((frame, [f64::from(u8::from(is_shown))]));
            for _ in 0..bytes.count(SWITCH, "switches of IK")? {
                let switch = bytes.take(SWITCH, "switches of IK")?;
                let ik = self.names.read(&switch[..SWITCH - 1]);
                let of = self.switches.entry(ik).or_default();
                of.push((frame, switch[SWITCH - 1] != 0));
            }
        }
        self.switches.values_mut().for_each(|of| of.sort_by_key(|(frame, _)| *frame));
        self.beside.show(shown);
        Ok(())
    }

    /// Whether an IK is on at a frame; it is on until it is switched off.
    pub(super) fn is_on(&self, ik: &str, frame: u32) -> bool {
        let before = |of: &Vec<(u32, bool)>| {
            of[..of.partition_point(|(from, _)| *from <= frame)].last().is_none_or(|(_, on)| *on)
        };
        self.switches.get(ik).is_none_or(before)
    }
}

impl Key {
    /// Reads a key of the bone `name` from a record that begins at the byte `at`.
    fn from_record(record: &[u8; KEY], at: usize, name: &str) -> Result<Self, Error> {
        let long =
            |from: usize| [record[from], record[from + 1], record[from + 2], record[from + 3]];
        let single = |from: usize| -> Result<f64, Error> {
            let number = f64::from(f32::from_le_bytes(long(from)));
            if number.is_finite() {
                Ok(number)
            } else {
                Err(damaged(at + from, format!("a key of {name} has a value that is no number")))
            }
        };
        let [x, y, z] = [single(19)?, single(23)?, single(27)?];
        let [a, b, c, d] = [single(31)?, single(35)?, single(39)?, single(43)?];
        // An all-zero rotation means no rotation.
        let rotation = DQuat::from_xyzw(-a, -b, c, d);
        let is_none = rotation.length_squared() < 1e-12;
        let rotation = if is_none { DQuat::IDENTITY } else { rotation.normalize() };
        let curve = |of: usize| Curve::from_bytes(CURVES[of].map(|at| record[INTERPOLATION + at]));
        Ok(Self {
            frame: u32::from_le_bytes(long(NAME)),
            translation: DVec3::new(x, y, -z),
            rotation,
            curves: [curve(0), curve(1), curve(2), curve(3)],
        })
    }
}

/// Offset of the curves in a record.
const INTERPOLATION: usize = 47;

/// Offsets of the four bytes of the curves for X, Y, Z and the rotation. Newer versions of MMD overwrite
/// the third and fourth byte with other data, so those two are read from their copies in the second row.
const CURVES: [[usize; 4]; 4] = [[0, 4, 8, 12], [1, 5, 9, 13], [17, 6, 10, 14], [18, 7, 11, 15]];
