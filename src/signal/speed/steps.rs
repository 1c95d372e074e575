//! Computes the angles a joint turns by from frame to frame, a block of frames at a time.

use std::array;

use glam::DQuat;

use crate::motion::clip::rig::Rig;
use crate::motion::lanes::{LANES, LaneQuat, Lanes, ThreeAxes};

/// Frames read for one joint before the next, so that their rows stay in the fastest cache.
pub(super) const BLOCK: usize = PARTS * LANES;

/// Number of lane vectors in a block.
pub(super) const PARTS: usize = 8;

/// The rows of a block.
pub(super) type Rows<'a> = [&'a [f64]; BLOCK];

/// Returns the first rows of many; a last block that is not full repeats its last row.
#[inline(always)]
pub(super) fn block<'a>(rows: &[&'a [f64]]) -> Rows<'a> {
    array::from_fn(|at| rows[at.min(rows.len() - 1)])
}

/// One joint on its way through the clip.
pub(super) struct JointSteps<'a> {
    reading: Reading<'a>,
    /// The rotation at the frame before the block.
    before: DQuat,
}

/// How the rotations of a joint are read from its channels.
enum Reading<'a> {
    /// Three axes and their columns, as in nearly every file.
    ThreeAxes(ThreeAxes, [usize; 3]),
    /// Any other list of channels.
    Listed(&'a Rig, usize),
}

impl<'a> JointSteps<'a> {
    /// Prepares every joint for its first step, which goes from the first row to itself.
    pub(super) fn prepare(rig: &'a Rig, first: &[f64]) -> Vec<Self> {
        let joint = |joint: usize| {
            let reading = match rig.three_axes(joint) {
                Some((axes, columns)) => Reading::ThreeAxes(axes, columns),
                None => Reading::Listed(rig, joint),
            };
            let mut rotations = [LaneQuat::default(); PARTS];
            reading.rotations(&[first; BLOCK], &mut rotations);
            Self { reading, before: rotations[0].lane(0) }
        };
        (0..rig.len()).map(joint).collect()
    }

    /// Computes the angle of the step into each frame of the next block, in radians.
    #[inline(always)]
    pub(super) fn steps(&mut self, rows: &Rows<'_>, steps: &mut [Lanes; PARTS]) {
        let mut rotations = [LaneQuat::default(); PARTS];
        self.reading.rotations(rows, &mut rotations);
        for (step, now) in steps.iter_mut().zip(&rotations) {
            *step = now.shifted(self.before).angle_to(*now);
            self.before = now.lane(LANES - 1);
        }
    }
}

impl Reading<'_> {
    // Loops over buffers, because closures over whole arrays are not inlined.
    #[inline(always)]
    fn rotations(&self, rows: &Rows<'_>, rotations: &mut [LaneQuat; PARTS]) {
        match *self {
            Self::ThreeAxes(axes, columns) => {
                let mut halves = [[(Lanes::ZERO, Lanes::ZERO); PARTS]; 3];
                for (halves, column) in halves.iter_mut().zip(columns) {
                    half_sines(rows, column, halves);
                }
                let [a, b, c] = &halves;
                for (part, rotation) in rotations.iter_mut().enumerate() {
                    *rotation = axes.product([a[part], b[part], c[part]]);
                }
            }
            Self::Listed(rig, joint) => {
                for (rows, rotation) in rows.as_chunks().0.iter().zip(rotations) {
                    *rotation = rig.rotation(joint, rows);
                }
            }
        }
    }
}

/// Computes sines and cosines of half of each angle. Most channels stay within a quarter turn, which is checked once
/// for the whole block.
#[inline(always)]
fn half_sines(rows: &Rows<'_>, column: usize, halves: &mut [(Lanes, Lanes); PARTS]) {
    let mut degrees = [Lanes::ZERO; PARTS];
    let mut near = true;
    for (rows, degrees) in rows.as_chunks::<LANES>().0.iter().zip(&mut degrees) {
        *degrees = Lanes::from_fn(|lane| rows[lane][column]);
        near &= degrees.all_near();
    }
    for (half, degrees) in halves.iter_mut().zip(degrees) {
        *half = if near { degrees.near_half_sin_cos() } else { degrees.half_sin_cos() };
    }
}
