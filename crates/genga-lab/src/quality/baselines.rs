//! Other ways to choose keys (比較手法), each for any number of keys.
//!
//! All choose among the frames of a [`KomaFrames`](crate::quality::KomaFrames). They return places in its list,
//! sorted, without the two ends, which every method has.

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
