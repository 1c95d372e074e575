//! Headings of the options in the help: what people use first stands above them, without one.

/// Options of the files that are written.
pub(super) const FILES: &str = "Files";
/// Options of the sheet and its cut.
pub(super) const SHEET: &str = "Sheet";
/// Corrections of the keys and the timing.
pub(super) const CORRECTIONS: &str = "Corrections";
/// Options of a timesheet that the columns go into.
pub(super) const INTO: &str = "Existing timesheet";
/// Rare options, of how the motion is read.
pub(super) const READING: &str = "Reading the motion";
