//! XDTS (デジタルタイムシート), the timesheet format of drawing and compositing programs: a signature line
//! and JSON, version 5.
//!
//! A file holds one column of the paper, so a sheet becomes two files: what the key animator writes into
//! ACTION (numbered keys, and a mark per inbetween) and what the inbetweener writes into CELL (every drawing
//! numbered). Both hold the dialogue (S). TDTS has the same structure and holds everything in one file.

mod file;
mod into;
mod pins;
mod read;
mod retimed;
mod speech;
mod tdts;
#[cfg(test)]
pub(super) mod tests;
mod unread;
mod write;

pub use into::{IntoTimesheet, PaperColumn, PutInto};
pub use pins::{MarkedKey, Numbered, marked_keys, pins};
pub use read::{Change, Column, Exchange, Mark, read, read_cells};
pub use retimed::retimed;
pub use tdts::Tdts;
pub use unread::unread;
pub use write::unsaid_rate;
pub use write::{Xdts, XdtsPair};
pub(super) use write::{name as column, notes};

/// Whether a file begins like an XDTS or a TDTS file.
pub fn is_timesheet(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    [SIGNATURE, TDTS_SIGNATURE].iter().any(|line| bytes.starts_with(line.as_bytes()))
}

/// Signature line of XDTS.
const SIGNATURE: &str = "exchangeDigitalTimeSheet Save Data";
/// Signature line of TDTS, which has the same structure.
const TDTS_SIGNATURE: &str = "toeiDigitalTimeSheet Save Data";

/// Field ID of cels; in TDTS of the ACTION column.
const CELS: u32 = 0;
/// Field ID of the S column: dialogue; in TDTS sound.
const SPEECH: u32 = 3;
/// Field ID of the CAMERA column.
const CAMERA: u32 = 5;
/// Field ID of the CELL column in TDTS.
const TDTS_CELL: u32 = 4;

const INBETWEEN: &str = "SYMBOL_TICK_1";
const REVERSE: &str = "SYMBOL_TICK_2";
const BLANK: &str = "SYMBOL_NULL_CELL";
const CONTINUED: &str = "SYMBOL_HYPHEN";

/// OpenToonz extension that circles a number. A file that uses it declares [`EXTENDED`].
const CIRCLED: &str = "OPTION_KEYFRAME";
const EXTENDED: &str = "p1";
