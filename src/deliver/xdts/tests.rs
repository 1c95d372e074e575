//! The two files of a sheet, and what is read back from them.

mod examples;
mod laws;
mod marked;
mod open_toonz;
mod reading;
mod sheets;
mod writing;
