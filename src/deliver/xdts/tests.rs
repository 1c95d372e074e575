//! The two files of a sheet, and what is read back from them.

mod examples;
mod laws;
mod marked;
mod open_toonz;
mod reading;
pub(in crate::deliver) mod sheets;
mod spoken;
mod writing;
