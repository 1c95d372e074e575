//! A skeleton read for work on several poses at once: which columns of a row turn and move what.

use std::array;
use std::iter;

use glam::DVec3;

use crate::motion::lanes::{LANES, LaneQuat, LaneVec, Lanes, ThreeAxes};
use crate::motion::{Axis, Channel, Skeleton};

/// One row of channel values a lane.
pub(crate) type Rows<'a> = [&'a [f64]; LANES];

/// The columns of each joint, looked up once instead of at every value.
#[derive(Debug, Clone)]
pub(crate) struct Rig {
    joints: Vec<RigJoint>,
}

#[derive(Debug, Clone)]
struct RigJoint {
    parent: Option<usize>,
    offset: DVec3,
    turns: Turns,
    /// Axis and column of each position.
    moves: Vec<(Axis, usize)>,
}

/// How the rotation of a joint comes out of a row.
#[derive(Debug, Clone)]
enum Turns {
    /// As nearly every file has it: three different axes, and their columns.
    Three(ThreeAxes, [usize; 3]),
    /// Axis and column of each rotation, in the order they are multiplied.
    Listed(Vec<(Axis, usize)>),
}

impl Turns {
    fn of(listed: Vec<(Axis, usize)>) -> Self {
        let three = |turns: [(Axis, usize); 3]| {
            let axes = ThreeAxes::new(turns.map(|(axis, _)| axis))?;
            Some(Self::Three(axes, turns.map(|(_, column)| column)))
        };
        listed[..].try_into().ok().and_then(three).unwrap_or(Self::Listed(listed))
    }
}

impl Rig {
    pub(crate) fn of(skeleton: &Skeleton) -> Self {
        let joint = |(_, joint): (_, &crate::motion::Joint)| {
            let (mut turns, mut moves) = (Vec::new(), Vec::new());
            for (column, channel) in (joint.first_channel..).zip(&joint.channels) {
                match *channel {
                    Channel::Rotation(axis) => turns.push((axis, column)),
                    Channel::Position(axis) => moves.push((axis, column)),
                }
            }
            let parent = joint.parent.map(|parent| parent.0);
            RigJoint { parent, offset: joint.offset, turns: Turns::of(turns), moves }
        };
        Self { joints: skeleton.iter().map(joint).collect() }
    }

    /// The part of a skeleton that carries some joints, with these, and where in it each of them is.
    pub(crate) fn carrying(skeleton: &Skeleton, joints: &[usize]) -> (Self, Vec<usize>) {
        let mut carries = vec![false; skeleton.len()];
        for joint in joints {
            let up = |joint: &usize| skeleton.joints[*joint].parent.map(|parent| parent.0);
            for joint in iter::successors(Some(*joint), up) {
                carries[joint] = true;
            }
        }
        let mut rig = Self::of(skeleton);
        let kept: Vec<usize> = (0..rig.len()).filter(|joint| carries[*joint]).collect();
        let place = |joint: &usize| kept.partition_point(|kept| kept < joint);
        let mut carries = carries.into_iter();
        rig.joints.retain(|_| carries.next().unwrap_or_default());
        for joint in &mut rig.joints {
            joint.parent = joint.parent.as_ref().map(place);
        }
        (rig, joints.iter().map(place).collect())
    }

    pub(crate) fn len(&self) -> usize {
        self.joints.len()
    }

    /// The rotation of a joint against its parent: [`local_rotation`](super::local_rotation) of each row.
    #[inline(always)]
    pub(crate) fn rotation(&self, joint: usize, rows: &Rows<'_>) -> LaneQuat {
        let half = |column: usize| gather(rows, column).half_sin_cos();
        match &self.joints[joint].turns {
            Turns::Three(axes, [a, b, c]) => axes.rotation([half(*a), half(*b), half(*c)]),
            Turns::Listed(turns) => {
                let turn = |rotation: LaneQuat, &(axis, column): &(Axis, usize)| {
                    rotation.turned(axis, half(column))
                };
                turns.iter().fold(LaneQuat::default(), turn)
            }
        }
    }

    /// The three different axes of a joint and their columns, where it has such.
    pub(crate) fn three_axes(&self, joint: usize) -> Option<(ThreeAxes, [usize; 3])> {
        match self.joints[joint].turns {
            Turns::Three(axes, columns) => Some((axes, columns)),
            Turns::Listed(_) => None,
        }
    }

    /// Where a joint stands against its parent: [`local_translation`](super::local_translation) of each
    /// row.
    #[inline(always)]
    pub(crate) fn translation(&self, joint: usize, rows: &Rows<'_>) -> LaneVec {
        let RigJoint { offset, moves, .. } = &self.joints[joint];
        let mut translation = LaneVec::splat(*offset);
        for &(axis, column) in moves {
            *translation.axis_mut(axis) = gather(rows, column);
        }
        translation
    }

    /// Turns local poses into world ones in place: rotations into world rotations, translations into
    /// positions.
    #[inline(always)]
    pub(crate) fn place(&self, rotations: &mut [LaneQuat], translations: &mut [LaneVec]) {
        for (joint, RigJoint { parent, .. }) in self.joints.iter().enumerate() {
            if let Some(parent) = *parent {
                let carrier = rotations[parent];
                translations[joint] = translations[parent] + carrier.rotate(translations[joint]);
                rotations[joint] = carrier * rotations[joint];
            }
        }
    }

    /// Joints that have a position of their own in the file.
    pub(crate) fn moving(&self) -> impl Iterator<Item = usize> + '_ {
        let moves = |(_, joint): &(usize, &RigJoint)| !joint.moves.is_empty();
        self.joints.iter().enumerate().filter(moves).map(|(joint, _)| joint)
    }

    /// The joint that carries a joint.
    #[inline(always)]
    pub(crate) fn parent(&self, joint: usize) -> Option<usize> {
        self.joints[joint].parent
    }

    /// The offset of a joint at rest.
    pub(crate) fn offset(&self, joint: usize) -> DVec3 {
        self.joints[joint].offset
    }
}

#[inline(always)]
fn gather(rows: &Rows<'_>, column: usize) -> Lanes {
    Lanes(array::from_fn(|lane| rows[lane][column]))
}
