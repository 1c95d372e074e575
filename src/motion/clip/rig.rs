//! A skeleton prepared for computing several poses at once: which columns of a row rotate and move each joint.

use std::array;
use std::iter;

use glam::DVec3;

use crate::motion::lanes::{LANES, LaneQuat, LaneVec, Lanes, ThreeAxes};
use crate::motion::{Axis, Channel, Skeleton};

/// One row of channel values per lane.
pub(crate) type Rows<'a> = [&'a [f64]; LANES];

/// The columns of each joint, looked up once rather than for every value.
#[derive(Debug, Clone)]
pub(crate) struct Rig {
    joints: Vec<RigJoint>,
}

#[derive(Debug, Clone)]
struct RigJoint {
    parent: Option<usize>,
    offset: DVec3,
    turns: Turns,
    /// Axis and column of each position channel.
    moves: Vec<(Axis, usize)>,
}

/// How to compute a joint's rotation from a row.
#[derive(Debug, Clone)]
enum Turns {
    /// Three different axes and their columns, as in nearly every file.
    Three(ThreeAxes, [usize; 3]),
    /// Axis and column of each rotation, in the order of multiplication.
    Listed(Vec<(Axis, usize)>),
}

impl Turns {
    fn new(listed: Vec<(Axis, usize)>) -> Self {
        let three = |turns: [(Axis, usize); 3]| {
            let axes = ThreeAxes::new(turns.map(|(axis, _)| axis))?;
            Some(Self::Three(axes, turns.map(|(_, column)| column)))
        };
        listed[..].try_into().ok().and_then(three).unwrap_or(Self::Listed(listed))
    }
}

impl Rig {
    pub(crate) fn new(skeleton: &Skeleton) -> Self {
        let joint = |(_, joint): (_, &crate::motion::Joint)| {
            let (mut turns, mut moves) = (Vec::new(), Vec::new());
            for (column, channel) in (joint.first_channel..).zip(&joint.channels) {
                match *channel {
                    Channel::Rotation(axis) => turns.push((axis, column)),
                    Channel::Position(axis) => moves.push((axis, column)),
                }
            }
            let parent = joint.parent.map(|parent| parent.0);
            RigJoint { parent, offset: joint.offset, turns: Turns::new(turns), moves }
        };
        Self { joints: skeleton.iter().map(joint).collect() }
    }

    /// Builds the part of a skeleton that consists of some joints and their ancestors. Also returns the index of each
    /// of these joints in it.
    pub(crate) fn carrying(skeleton: &Skeleton, joints: &[usize]) -> (Self, Vec<usize>) {
        let mut carries = vec![false; skeleton.len()];
        for joint in joints {
            let up = |joint: &usize| skeleton.joints[*joint].parent.map(|parent| parent.0);
            for joint in iter::successors(Some(*joint), up) {
                carries[joint] = true;
            }
        }
        let mut rig = Self::new(skeleton);
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

    /// Computes the rotation of a joint relative to its parent: [`local_rotation`](super::local_rotation) of each
    /// row.
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

    /// Returns the three different axes of a joint and their columns, if it has them.
    pub(crate) fn three_axes(&self, joint: usize) -> Option<(ThreeAxes, [usize; 3])> {
        match self.joints[joint].turns {
            Turns::Three(axes, columns) => Some((axes, columns)),
            Turns::Listed(_) => None,
        }
    }

    /// Computes the position of a joint relative to its parent: [`local_translation`](super::local_translation) of
    /// each row.
    #[inline(always)]
    pub(crate) fn translation(&self, joint: usize, rows: &Rows<'_>) -> LaneVec {
        let RigJoint { offset, moves, .. } = &self.joints[joint];
        let mut translation = LaneVec::splat(*offset);
        for &(axis, column) in moves {
            *translation.axis_mut(axis) = gather(rows, column);
        }
        translation
    }

    /// Converts local poses into world poses in place: rotations into world rotations, translations into positions.
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

    /// Returns the joints that have position channels.
    pub(crate) fn moving(&self) -> impl Iterator<Item = usize> + '_ {
        let moves = |(_, joint): &(usize, &RigJoint)| !joint.moves.is_empty();
        self.joints.iter().enumerate().filter(moves).map(|(joint, _)| joint)
    }

    /// Returns the parent of a joint.
    #[inline(always)]
    pub(crate) fn parent(&self, joint: usize) -> Option<usize> {
        self.joints[joint].parent
    }

    /// Returns the offset of a joint at rest.
    pub(crate) fn offset(&self, joint: usize) -> DVec3 {
        self.joints[joint].offset
    }
}

#[inline(always)]
fn gather(rows: &Rows<'_>, column: usize) -> Lanes {
    Lanes(array::from_fn(|lane| rows[lane][column]))
}
