//! Reads and writes BVH files: the file as written ⇄ [`Clip`].
//!
//! Angles are in degrees, lengths in the file's own unit; axes are right-handed, with Y up by convention. A
//! joint's rest rotation is the identity; a position channel *replaces* the offset on its axis.
//!
//! Reading has four stages: bytes → UTF-8 text → skeleton, with the table column of each channel → motion
//! table → [`Clip`]. `docs/input.md` lists every peculiarity of real files and how the reader handles it.

use crate::error::Warning;
use crate::motion::Clip;

mod columns;
mod file;
mod frame_time;
mod hierarchy;
mod line_column;
mod names;
mod number;
mod number_spellings;
mod read;
mod repair;
#[cfg(test)]
pub(crate) mod sample;
mod scanner;
mod table_fast;
mod table_tolerant;
#[cfg(test)]
mod tests;
mod text;
mod threads;
mod trees;
pub mod warnings;
mod write;

pub use names::renamed;
pub use read::{Options, open, read};
pub use trees::no_tree;
pub use write::{Writer, write};

/// A built-in sample, `data/kick.bvh`: a kick of 92 frames at 24 fps, synthetic and as free as the program.
pub const KICK: &str = include_str!("../../data/kick.bvh");

/// The result of reading a BVH file.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The motion.
    pub clip: Clip,
    /// Warnings about the file, in the order of its lines. Each code of [`warnings`] appears at most once,
    /// with its first place and the number of occurrences.
    pub warnings: Vec<Warning>,
    /// Seconds per frame as written in the file, before snapping to a usual rate or an override by
    /// [`Options::fps`]; NaN if the file writes no number there.
    pub written_frame_time: f64,
}
