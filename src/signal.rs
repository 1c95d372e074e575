//! **Measure** (測る): measures how fast each joint moves, smooths the speeds, and finds where they turn.

mod low_pass;
mod speed;
mod turns;

use nalgebra::DMatrix;

use crate::motion::{JointId, Skeleton};
use crate::time::{Frame, FrameRate};

pub use crate::motion::{Contact, ContactFinder, Limb};
pub use low_pass::{FilterKind, LowPass, Spectrum};
pub use speed::{Measure, Speed};
pub use turns::{Drawn, Reading, Side, Steady, Turn, TurnFinder, TurnKind};

/// One value a frame and joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Signals {
    /// Frames × joints: a joint is a column, contiguous in memory.
    pub values: DMatrix<f64>,
    /// Quantity and unit of the values.
    pub unit: Quantity,
    /// Frames a second.
    pub rate: FrameRate,
    /// Number of the first row's frame in the file.
    pub first: Frame,
}

/// The quantity that a signal measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Radians a second; degrees a second for people.
    Angle,
    /// The file's length unit a second.
    Length,
    /// Multiples of the signal's own root mean square.
    Ratio,
}

impl Quantity {
    /// Returns the factor from the value in code to the value for people.
    pub fn for_people(self) -> f64 {
        match self {
            Self::Angle => 180.0 / std::f64::consts::PI,
            Self::Length | Self::Ratio => 1.0,
        }
    }

    /// Returns the unit as people write it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Angle => "°/s",
            Self::Length => "units/s",
            Self::Ratio => "× RMS",
        }
    }
}

impl Signals {
    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.values.nrows()
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.values.ncols()
    }

    /// Returns one joint's values, frame by frame.
    pub fn joint(&self, joint: JointId) -> &[f64] {
        let frames = self.frames();
        &self.values.as_slice()[joint.0 * frames..(joint.0 + 1) * frames]
    }

    /// Returns the joints by how much they carry through the world, the most first: the length of the bones below them
    /// times their mean speed.
    pub fn movers_first(&self, skeleton: &Skeleton) -> Vec<JointId> {
        let carried = |(joint, reach): (usize, f64)| {
            let joint = JointId(joint);
            (joint, reach * self.joint(joint).iter().map(|speed| speed.abs()).sum::<f64>())
        };
        let mut joints: Vec<_> = skeleton.reaches().into_iter().enumerate().map(carried).collect();
        joints.sort_by(|a, b| b.1.total_cmp(&a.1));
        joints.into_iter().map(|(joint, _)| joint).collect()
    }
}
