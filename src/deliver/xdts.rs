//! XDTS (デジタルタイムシート), the timesheet that drawing and compositing programs read: a signature line
//! and JSON, version 5.
//!
//! A file has one column of the paper, so a sheet is two files: what the key animator writes into
//! ACTION (keys numbered, a mark an inbetween) and what the inbetweener writes into CELL (every
//! drawing numbered). TDTS, made of the same parts, has both in one file.

mod file;
mod pins;
mod read;
mod tdts;
#[cfg(test)]
pub(super) mod tests;
mod write;

pub use pins::{Numbered, marked_keys, pins};
pub use read::{Change, Column, Exchange, Mark, read};
pub use tdts::Tdts;
pub use write::{Xdts, XdtsPair};

/// How an XDTS file begins.
const SIGNATURE: &str = "exchangeDigitalTimeSheet Save Data";
/// How a TDTS file begins, which is made of the same parts.
const TDTS_SIGNATURE: &str = "toeiDigitalTimeSheet Save Data";

/// The field of cels; in a TDTS file the ACTION column.
const CELS: u32 = 0;
/// The CELL column of a TDTS file.
const TDTS_CELL: u32 = 4;

const INBETWEEN: &str = "SYMBOL_TICK_1";
const REVERSE: &str = "SYMBOL_TICK_2";
const BLANK: &str = "SYMBOL_NULL_CELL";
const CONTINUED: &str = "SYMBOL_HYPHEN";

/// An extension of OpenToonz: the number is circled. A file that uses it says so by [`EXTENDED`].
const CIRCLED: &str = "OPTION_KEYFRAME";
const EXTENDED: &str = "p1";
