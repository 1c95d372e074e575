//! BVH, the file as written ⇄ [`Clip`].
//!
//! Degrees and the file's own unit, right-handed, Y up by custom. A joint's rest rotation is the
//! identity; a position channel *replaces* the offset on its axis.

use crate::error::Warning;
use crate::motion::Clip;

mod file;
mod hierarchy;
pub mod lead_in;
mod number;
mod read;
mod rows;
#[cfg(test)]
pub(crate) mod sample;
mod scanner;
mod table;
#[cfg(test)]
mod tests;
mod threads;
mod write;

pub use lead_in::LeadIn;
pub use read::read;
pub use write::{Writer, write};

/// What a reader gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The motion.
    pub clip: Clip,
    /// What a person should know about the file.
    pub warnings: Vec<Warning>,
}
