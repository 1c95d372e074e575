//! BVH, the file as written ⇄ [`Clip`].
//!
//! Degrees and the file's own unit, right-handed, Y up by custom. A joint's rest rotation is the
//! identity; a position channel *replaces* the offset on its axis.
//!
//! Reading runs one way: bytes → text in UTF-8 → the skeleton and which columns of the table are its
//! channels → the table → [`Clip`]. `docs/formats.md` lists every peculiarity of real files and what
//! the reader does with it.

use crate::error::Warning;
use crate::motion::Clip;

mod careful;
mod cleaning;
mod columns;
mod ends;
mod file;
mod frame_time;
pub mod glitches;
mod hierarchy;
pub mod lead_in;
mod names;
mod number;
mod odd;
mod places;
mod ramps;
mod read;
mod repair;
#[cfg(test)]
pub(crate) mod sample;
mod scanner;
mod table;
#[cfg(test)]
mod tests;
mod text;
mod threads;
mod trees;
pub mod warnings;
mod write;

pub use cleaning::Cleaning;
pub use lead_in::LeadIn;
pub(super) use names::renamed;
pub use ramps::Ramps;
pub use read::{Options, open, read};
pub(super) use trees::no_tree;
pub use write::{Writer, write};

/// What a reader gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The motion.
    pub clip: Clip,
    /// What a person should know about the file, in the order of its lines: one warning a code, with
    /// the first place and how many there are. The codes are those of [`warnings`].
    pub warnings: Vec<Warning>,
    /// Seconds a frame as the file writes them, before they became a usual rate or another was asked
    /// for; NaN when the file writes no number there.
    pub written_frame_time: f64,
}
