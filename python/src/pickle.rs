//! What pickle takes of a clip, so that it goes through pools of processes unchanged.

use genga::motion::{
    Axis, Beside, CameraPath, Channel, Clip as Motion, Declared, EndSite, Joint, JointId, Skeleton,
    Word,
};
use genga::time::{Frame, FrameRate};
use genga_read::{GltfScene, VmdBeside};
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};

/// The function that makes an object again, and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>);

/// All of a clip but its values.
#[derive(Serialize, Deserialize)]
pub struct Head {
    joints: Vec<Bone>,
    rate: f64,
    first: usize,
    frames: usize,
    /// The axis that points up, and whether a person said so.
    up: Option<(usize, bool)>,
    metres: Option<f64>,
    limbs: [Option<[usize; 3]>; 4],
    head: Option<usize>,
    beside: Option<Others>,
}

/// What stands beside the body: the camera, and what each reader keeps for the writer of its format.
#[derive(Serialize, Deserialize)]
struct Others {
    camera: Option<CameraPath>,
    vmd: Option<VmdBeside>,
    gltf: Option<GltfScene>,
}

#[derive(Serialize, Deserialize)]
struct Bone {
    name: String,
    parent: Option<usize>,
    offset: [f64; 3],
    /// Whether each channel turns, and its axis.
    channels: Vec<(bool, usize)>,
    tips: Vec<(String, [f64; 3])>,
}

impl Head {
    /// Takes a clip apart.
    pub fn of(motion: &Motion) -> Self {
        let Declared { up, metres, limbs, head } = motion.declared();
        Self {
            joints: motion.skeleton().joints.iter().map(Bone::of).collect(),
            rate: motion.rate().fps(),
            first: motion.first().0,
            frames: motion.len(),
            up: up.map(|(axis, word)| (axis as usize, word == Word::Person)),
            metres,
            limbs: limbs.map(|limb| limb.map(|joints| joints.map(|joint| joint.0))),
            head: head.map(|joint| joint.0),
            beside: motion.beside().map(Others::of),
        }
    }

    /// Puts the clip together.
    pub fn motion(self, values: Vec<f64>) -> Result<Motion, genga::Error> {
        let mut first_channel = 0;
        let joints = self.joints.into_iter().map(|bone| {
            let first = first_channel;
            first_channel += bone.channels.len();
            bone.joint(first)
        });
        let skeleton = Skeleton { joints: joints.collect() };
        let word = |is_person| if is_person { Word::Person } else { Word::File };
        let declared = Declared {
            up: self.up.map(|(axis, is_person)| (axis_of(axis), word(is_person))),
            metres: self.metres,
            limbs: self.limbs.map(|limb| limb.map(|joints| joints.map(JointId))),
            head: self.head.map(JointId),
        };
        let rate = FrameRate::new(self.rate)?;
        let motion = Motion::new(skeleton, rate, Frame(self.first), self.frames, values)?;
        let motion = motion.with_declared(declared);
        Ok(match self.beside {
            Some(others) => motion.with_beside(others.beside()),
            None => motion,
        })
    }
}

impl Others {
    fn of(beside: &Beside) -> Self {
        let (vmd, gltf) = (beside.kept().cloned(), beside.kept().cloned());
        Self { camera: beside.camera.clone(), vmd, gltf }
    }

    fn beside(self) -> Beside {
        let mut beside = Beside::new(self.camera);
        if let Some(vmd) = self.vmd {
            beside = beside.keep(vmd);
        }
        if let Some(gltf) = self.gltf {
            beside = beside.keep(gltf);
        }
        beside
    }
}

impl Bone {
    fn of(joint: &Joint) -> Self {
        let channel = |channel: &Channel| match *channel {
            Channel::Position(axis) => (false, axis as usize),
            Channel::Rotation(axis) => (true, axis as usize),
        };
        let tip = |tip: &EndSite| (tip.name.clone(), tip.offset.to_array());
        Self {
            name: joint.name.clone(),
            parent: joint.parent.map(|parent| parent.0),
            offset: joint.offset.to_array(),
            channels: joint.channels.iter().map(channel).collect(),
            tips: joint.end_sites.iter().map(tip).collect(),
        }
    }

    fn joint(self, first_channel: usize) -> Joint {
        let channel = |(turns, axis)| match turns {
            true => Channel::Rotation(axis_of(axis)),
            false => Channel::Position(axis_of(axis)),
        };
        let tip = |(name, offset): (String, [f64; 3])| EndSite { name, offset: offset.into() };
        Joint {
            name: self.name,
            parent: self.parent.map(JointId),
            offset: self.offset.into(),
            channels: self.channels.into_iter().map(channel).collect(),
            first_channel,
            end_sites: self.tips.into_iter().map(tip).collect(),
        }
    }
}

fn axis_of(number: usize) -> Axis {
    [Axis::X, Axis::Y, Axis::Z][number.min(2)]
}
