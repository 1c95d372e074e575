//! Clips from arrays, and arrays of clips.

use genga::Error;
use genga::glam::{DQuat, DVec3};
use genga::motion::{
    Axis, Body, Channel, Clip, Joint, JointId, Pose, Skeleton, set_local_rotation,
};
use genga::time::{Frame, FrameRate};

/// How every joint turns in a clip from arrays: the order that most programs write.
const TURNS: [Channel; 3] =
    [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];

/// Where a root is.
const PLACE: [Channel; 3] =
    [Channel::Position(Axis::X), Channel::Position(Axis::Y), Channel::Position(Axis::Z)];

/// What a clip is made of; arrays are flat, the last index fastest.
pub struct Arrays<'a> {
    pub names: Vec<String>,
    pub parents: Vec<Option<usize>>,
    /// Joints × 3.
    pub offsets: &'a [f64],
    /// Frames × joints × 4, xyzw.
    pub rotations: &'a [f64],
    /// Frames × 3.
    pub root: &'a [f64],
    pub frames: usize,
    pub rate: f64,
}

impl Arrays<'_> {
    /// The clip: its angles run on past ±180°, so that speeds have no jumps.
    pub fn clip(&self) -> Result<Clip, Error> {
        let skeleton = Skeleton { joints: self.joints()? };
        let (joints, channels) = (skeleton.len(), skeleton.channels());
        let mut values = vec![0.0; self.frames * channels];
        for frame in 0..self.frames {
            if frame > 0 {
                // What stood there before is what the angles are to be near.
                values.copy_within((frame - 1) * channels..frame * channels, frame * channels);
            }
            let row = &mut values[frame * channels..(frame + 1) * channels];
            for (index, joint) in skeleton.joints.iter().enumerate() {
                if joint.parent.is_none() {
                    let place = &self.root[3 * frame..3 * frame + 3];
                    row[joint.first_channel..joint.first_channel + 3].copy_from_slice(place);
                }
                let at = 4 * (frame * joints + index);
                set_local_rotation(joint, self.rotation(at, frame, joint)?, row);
            }
        }
        Clip::new(skeleton, FrameRate::new(self.rate)?, Frame(0), self.frames, values)
    }

    fn rotation(&self, at: usize, frame: usize, joint: &Joint) -> Result<DQuat, Error> {
        let rotation = DQuat::from_slice(&self.rotations[at..at + 4]);
        // A length far from 1 is a slip: wxyz in place of xyzw has length 1 too, but a zero has not.
        match (rotation.length() - 1.0).abs() < 1e-2 {
            true => Ok(rotation.normalize()),
            false => Err(Error::clip(format!(
                "frame {frame}: the rotation of {} has length {}, a unit quaternion (x, y, z, w) has 1",
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
                    "{name} comes before its parent: parents come first, and a root has -1"
                )));
            }
            let channels = match parent {
                None => [PLACE, TURNS].concat(),
                Some(_) => TURNS.to_vec(),
            };
            let first = first_channel;
            first_channel += channels.len();
            Ok(Joint {
                name: name.clone(),
                parent: parent.map(JointId),
                offset: DVec3::from_slice(&self.offsets[3 * index..]),
                channels,
                first_channel: first,
                end_sites: Vec::new(),
            })
        };
        self.names.iter().enumerate().map(joint).collect()
    }
}

/// Frames × joints × 4, xyzw: the rotation of each joint against its parent.
pub fn rotations(clip: &Clip) -> Vec<f64> {
    let mut flat = Vec::with_capacity(clip.len() * clip.skeleton().len() * 4);
    let mut pose = Pose::rest(clip.skeleton());
    for frame in frames(clip) {
        pose.take_frame(clip, frame);
        flat.extend(pose.rotations.iter().flat_map(|rotation| rotation.to_array()));
    }
    flat
}

/// Frames × joints × 3: where each joint is in the world.
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
