//! **Judge** (評価): how good a set of keys or a sheet is, and the other methods it is measured against.
//!
//! An [`Evaluation`] measures a sheet against its source and against the keys of somebody else; a
//! [`Comparison`] lays several ways to choose the same number of keys side by side. `docs/quality.md`
//! has the figures of all real clips.

pub mod baselines;
mod comparison;
mod evaluation;
mod extrema;
mod feet;
mod hits;
mod holds;
mod koma_frames;
mod method;
mod shown;
#[cfg(test)]
mod tests;
mod timing;

pub use comparison::{Compare, Comparison, Row};
pub use evaluation::{Counts, Evaluation, Off};
pub use extrema::{Extrema, Moment};
pub use feet::Slip;
pub use holds::{Pop, Pops};
pub use koma_frames::KomaFrames;
pub use method::Method;
pub use timing::Timing;
