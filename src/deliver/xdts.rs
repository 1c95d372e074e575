//! XDTS (デジタルタイムシート), the timesheet that drawing and compositing programs read: a signature line
//! and JSON, version 5.
//!
//! A file has one column of the paper, so a sheet is two files: what the key animator writes into
//! ACTION (keys numbered, a mark an inbetween) and what the inbetweener writes into CELL (every
//! drawing numbered). What is spoken (S) stands in both. TDTS, made of the same parts, has all in one file.

mod file;
mod pins;
mod read;
mod retimed;
mod speech;
mod tdts;
#[cfg(test)]
pub(super) mod tests;
mod write;

pub use pins::{Numbered, marked_keys, pins};
pub use read::{Change, Column, Exchange, Mark, read, read_cells};
pub use retimed::retimed;
pub use tdts::Tdts;
pub(super) use write::name as column;
pub use write::{Xdts, XdtsPair};

/// Whether a file begins as an XDTS or a TDTS file does.
pub fn is_timesheet(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    [SIGNATURE, TDTS_SIGNATURE].iter().any(|line| bytes.starts_with(line.as_bytes()))
}

/// How an XDTS file begins.
const SIGNATURE: &str = "exchangeDigitalTimeSheet Save Data";
/// How a TDTS file begins, which is made of the same parts.
const TDTS_SIGNATURE: &str = "toeiDigitalTimeSheet Save Data";

/// The field of cels; in a TDTS file the ACTION column.
const CELS: u32 = 0;
/// The S column: dialogue; in a TDTS file sound.
const SPEECH: u32 = 3;
/// The CELL column of a TDTS file.
const TDTS_CELL: u32 = 4;

const INBETWEEN: &str = "SYMBOL_TICK_1";
const REVERSE: &str = "SYMBOL_TICK_2";
const BLANK: &str = "SYMBOL_NULL_CELL";
const CONTINUED: &str = "SYMBOL_HYPHEN";

/// An extension of OpenToonz: the number is circled. A file that uses it says so by [`EXTENDED`].
const CIRCLED: &str = "OPTION_KEYFRAME";
const EXTENDED: &str = "p1";
