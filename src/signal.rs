//! **Measure** (測る): how fast each joint moves, smoothed, and where its speed turns.

mod contact;
mod low_pass;
mod speed;
mod turns;

use nalgebra::DMatrix;

use crate::time::{Frame, FrameRate};

pub use contact::{Contact, ContactFinder, Limb};
pub use low_pass::{FilterKind, LowPass, Spectrum};
pub use speed::{Measure, Speed};
pub use turns::{Reading, Side, Steady, Turn, TurnFinder, TurnKind};

/// One value a frame and joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Signals {
    /// Frames × joints: a joint is a column, contiguous in memory.
    pub values: DMatrix<f64>,
    /// What the values count.
    pub unit: Unit,
    /// Frames a second.
    pub rate: FrameRate,
    /// The number of the first row in the file.
    pub first: Frame,
}

/// What a signal counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Radians a second; degrees a second for people.
    Angle,
    /// The file's length unit a second.
    Length,
    /// Multiples of the signal's own root mean square.
    Ratio,
}

impl Unit {
    /// The factor from the value in code to the value for people.
    pub fn for_people(self) -> f64 {
        match self {
            Self::Angle => 180.0 / std::f64::consts::PI,
            Self::Length | Self::Ratio => 1.0,
        }
    }

    /// How people write it.
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

    /// One joint's values, frame after frame.
    pub fn joint(&self, joint: crate::motion::JointId) -> &[f64] {
        let frames = self.frames();
        &self.values.as_slice()[joint.0 * frames..(joint.0 + 1) * frames]
    }
}
