//! Motion capture to Japanese limited animation.
#[cfg(feature = "cli")]
pub mod cli;
pub mod deliver;
pub mod edits;
pub mod error;
pub mod keys;
pub mod motion;
pub mod pipeline;
pub mod plot;
pub mod recipe;
pub mod sheet;
pub mod signal;
pub mod study;
pub mod time;
pub mod timing;

pub use error::{Error, Warning};
