//! The two files of a sheet, and reading them back.

mod examples;
pub(super) mod laws;
mod marked;
mod open_toonz;
mod reading;
pub(crate) mod sheets;
mod spoken;
mod writing;
