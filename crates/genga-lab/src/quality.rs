//! **Judge** (評価): measures of the quality of keys or a sheet, and other methods to compare with.
//!
//! An [`Evaluation`] measures a sheet against its source and against reference keys. A [`Comparison`] compares several
//! ways to choose the same number of keys. `docs/quality.md` has the figures of all real clips.

pub mod baselines;
mod comparison;
mod evaluation;
mod extrema;
mod feet;
mod hits;
mod koma_frames;
mod method;
mod pops;
mod shown;
#[cfg(test)]
mod tests;
mod timing;

pub use comparison::{Compare, Comparison, Row};
pub use evaluation::{Counts, Evaluation, Off};
pub use extrema::{Extrema, Moment};
pub use feet::Slip;
pub use koma_frames::KomaFrames;
pub use method::Method;
pub use pops::{Pop, Pops};
pub use timing::Timing;
