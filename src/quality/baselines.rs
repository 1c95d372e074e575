//! Other ways to choose keys (比較手法), each for any number of them.
//!
//! All choose among the frames of a [`KomaFrames`](crate::quality::KomaFrames) and give places in its list, by
//! number and without the two ends, which every method has.

mod optimal;
mod polyline;
mod segments;
mod simplified;
mod uniform;

pub use optimal::{Objective, Optimal};
pub use polyline::LongestPolyline;
pub use segments::Segments;
pub use simplified::Simplified;
pub use uniform::{every, uniform};
