//! Converts arrays to clips, and clips to arrays.

use genga::Error;
use genga::glam::{DQuat, DVec3};
use genga::motion::{
    Axis, Body, Channel, Clip, Declared, EndSite, Joint, JointId, Pose, Skeleton, Word,
    set_local_rotation,
};
use genga::time::{Frame, FrameRate};

/// Rotation channels of every joint in a clip from arrays, in the order that most programs write.
const TURNS: [Channel; 3] =
    [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];

/// Position channels of a root, or of a joint that travels relative to its parent.
const PLACE: [Channel; 3] =
    [Channel::Position(Axis::X), Channel::Position(Axis::Y), Channel::Position(Axis::Z)];

/// The content of a clip. Arrays are flat, the last index fastest.
pub struct Arrays<'a> {
    pub names: Vec<String>,
    pub parents: Vec<Option<usize>>,
    /// Joints × 3.
    pub offsets: &'a [f64],
    /// Frames × joints × 4, xyzw.
    pub rotations: &'a [f64],
    pub places: Places<'a>,
    /// Joints × tips of a joint × 3: the ends of each joint's bones, NaN for those that it does not have.
    pub tips: Option<&'a [f64]>,
    pub frames: usize,
    /// Number of the first frame.
    pub first: usize,
    pub rate: f64,
    /// The axis that points up, if it is known.
    pub up: Option<Axis>,
    /// Metres per unit of length, if they are known.
    pub metres: Option<f64>,
}

/// Positions of joints relative to their parents.
#[derive(Clone, Copy)]
pub enum Places<'a> {
    /// Frames × 3: positions of the roots; other joints keep their offsets.
    Root(&'a [f64]),
    /// Frames × joints × 3.
    Each(&'a [f64]),
}

impl Places<'_> {
    fn values(&self) -> &[f64] {
        let (Self::Root(flat) | Self::Each(flat)) = self;
        flat
    }

    fn row(&self, frame: usize, joints: usize, index: usize) -> &[f64] {
        match self {
            Self::Root(flat) => &flat[3 * frame..3 * frame + 3],
            Self::Each(flat) => &flat[3 * (frame * joints + index)..][..3],
        }
    }
}

impl Arrays<'_> {
    /// Builds the clip. Its angles continue past ±180°, so that speeds have no jumps.
    pub fn clip(&self) -> Result<Clip, Error> {
        self.check()?;
        let skeleton = Skeleton { joints: self.joints()? };
        let (joints, channels) = (skeleton.len(), skeleton.channels());
        let mut values = vec![0.0; self.frames * channels];
        for frame in 0..self.frames {
            if frame > 0 {
                // Copies the previous row, because the new angles are chosen nearest to it.
                values.copy_within((frame - 1) * channels..frame * channels, frame * channels);
            }
            let row = &mut values[frame * channels..(frame + 1) * channels];
            for (index, joint) in skeleton.joints.iter().enumerate() {
                if joint.channels.len() > TURNS.len() {
                    let place = self.places.row(frame, joints, index);
                    row[joint.first_channel..joint.first_channel + 3].copy_from_slice(place);
                }
                let at = 4 * (frame * joints + index);
                set_local_rotation(joint, self.rotation(at, frame, joint)?, row);
            }
        }
        let rate = FrameRate::new(self.rate)?;
        let clip = Clip::new(skeleton, rate, Frame(self.first), self.frames, values)?;
        clip.check_size()?;
        let up = self.up.map(|axis| (axis, Word::Person));
        Ok(clip.with_declared(Declared { up, metres: self.metres, ..Declared::default() }))
    }

    /// Refuses what is no motion.
    fn check(&self) -> Result<(), Error> {
        if self.names.is_empty() || self.frames == 0 {
            return Err(Error::clip("the clip has no motion: it needs a joint and a frame"));
        }
        if self.metres.is_some_and(|metres| !(metres > 0.0 && metres.is_finite())) {
            return Err(Error::clip("metres is the length of a unit: above 0, as in 0.01"));
        }
        let numbers = [("offsets", self.offsets), ("translations", self.places.values())];
        for (what, values) in numbers {
            self.finite(what, values)?;
        }
        let tips = self.tips.unwrap_or_default().chunks_exact(3);
        let mut halves = tips.filter(|tip| !is_unknown(tip));
        match halves.find(|tip| tip.iter().any(|value| !value.is_finite())) {
            None => Ok(()),
            Some(tip) => Err(Error::clip(format!(
                "tips holds {tip:?}: a tip is three numbers, or three NaN if it is unknown"
            ))),
        }
    }

    fn finite(&self, what: &str, values: &[f64]) -> Result<(), Error> {
        let Some(at) = values.iter().position(|value| !value.is_finite()) else { return Ok(()) };
        let (joints, value) = (self.names.len(), values[at]);
        let place = match (what, self.places) {
            ("offsets", _) => format!("offsets of {}", self.names[at / 3]),
            (_, Places::Root(_)) => format!("root, row {}", at / 3),
            (_, Places::Each(_)) => {
                let joint = &self.names[at / 3 % joints];
                format!("translations of {joint}, row {}", at / 3 / joints)
            }
        };
        Err(Error::clip(format!(
            "{place}: {value} is not a length; fill gaps of the capture first"
        )))
    }

    fn rotation(&self, at: usize, frame: usize, joint: &Joint) -> Result<DQuat, Error> {
        let rotation = DQuat::from_slice(&self.rotations[at..at + 4]);
        // A length far from 1 is a mistake, such as a zero quaternion. Swapped wxyz has length 1 too and is not
        // detected.
        match (rotation.length() - 1.0).abs() < 1e-2 {
            true => Ok(rotation.normalize()),
            false => Err(Error::clip(format!(
                "row {frame}: the rotation of {} has length {}; a unit quaternion (x, y, z, w) has length 1",
                joint.name,
                rotation.length()
            ))),
        }
    }

    fn joints(&self) -> Result<Vec<Joint>, Error> {
        let mut first_channel = 0;
        let joint = |(index, name): (usize, &String)| {
            let parent = self.parents[index];
            if parent.is_some_and(|parent| parent >= index) {
                return Err(Error::clip(format!(
                    "{name} comes before its parent: list parents first, and give a root -1"
                )));
            }
            let channels = match parent.is_none() || self.travels(index) {
                true => [PLACE, TURNS].concat(),
                false => TURNS.to_vec(),
            };
            let first = first_channel;
            first_channel += channels.len();
            Ok(Joint {
                name: name.clone(),
                parent: parent.map(JointId),
                offset: DVec3::from_slice(&self.offsets[3 * index..]),
                channels,
                first_channel: first,
                end_sites: self.tips_of(index).collect(),
            })
        };
        self.names.iter().enumerate().map(joint).collect()
    }

    /// Whether a joint visibly leaves its offset in any frame, relative to the skeleton's size.
    fn travels(&self, index: usize) -> bool {
        let offset = DVec3::from_slice(&self.offsets[3 * index..]);
        let longest = self.offsets.chunks_exact(3).map(|offset| DVec3::from_slice(offset).length());
        let seen = 1e-4 * longest.fold(0.0, f64::max);
        let is_off = |frame| {
            let place = DVec3::from_slice(self.places.row(frame, self.names.len(), index));
            (place - offset).length() > seen
        };
        matches!(self.places, Places::Each(_)) && (0..self.frames).any(is_off)
    }

    fn tips_of(&self, index: usize) -> impl Iterator<Item = EndSite> {
        let tips = self.tips.unwrap_or_default();
        let width = tips.len() / self.names.len();
        let own = tips[index * width..(index + 1) * width].chunks_exact(3);
        own.filter(|tip| !is_unknown(tip))
            .map(|tip| EndSite { name: "Site".into(), offset: DVec3::from_slice(tip) })
    }
}

fn is_unknown(tip: &[f64]) -> bool {
    tip.iter().all(|value| value.is_nan())
}

/// Frames × joints × 4, xyzw: the rotation of each joint relative to its parent.
pub fn rotations(clip: &Clip) -> Vec<f64> {
    let mut flat = Vec::with_capacity(clip.len() * clip.skeleton().len() * 4);
    let mut pose = Pose::rest(clip.skeleton());
    for frame in frames(clip) {
        pose.take_frame(clip, frame);
        flat.extend(pose.rotations.iter().flat_map(|rotation| rotation.to_array()));
    }
    flat
}

/// Frames × joints × 3: the position of each joint relative to its parent.
pub fn translations(clip: &Clip) -> Vec<f64> {
    let mut flat = Vec::with_capacity(clip.len() * clip.skeleton().len() * 3);
    let mut pose = Pose::rest(clip.skeleton());
    for frame in frames(clip) {
        pose.take_frame(clip, frame);
        flat.extend(pose.translations.iter().flat_map(|place| place.to_array()));
    }
    flat
}

/// Joints × T × 3: the ends of each joint's bones, NaN for those that it does not have; and T, at least 1.
pub fn tips(clip: &Clip) -> (Vec<f64>, usize) {
    let joints = &clip.skeleton().joints;
    let most = joints.iter().map(|joint| joint.end_sites.len()).max().unwrap_or(0).max(1);
    let of_joint = |joint: &Joint| {
        let own = joint.end_sites.iter().map(|tip| tip.offset.to_array());
        own.chain(std::iter::repeat([f64::NAN; 3])).take(most).flatten().collect::<Vec<_>>()
    };
    (joints.iter().flat_map(of_joint).collect(), most)
}

/// Frames × joints × 3: the position of each joint in the world.
pub fn positions(clip: &Clip) -> Vec<f64> {
    let mut flat = Vec::with_capacity(clip.len() * clip.skeleton().len() * 3);
    let (mut pose, mut body) = (Pose::rest(clip.skeleton()), Body::new(clip.skeleton()));
    for frame in frames(clip) {
        pose.take_frame(clip, frame);
        body.place(&pose);
        flat.extend(body.positions().iter().flat_map(|position| position.to_array()));
    }
    flat
}

fn frames(clip: &Clip) -> impl Iterator<Item = Frame> {
    (clip.first().0..clip.first().0 + clip.len()).map(Frame)
}
