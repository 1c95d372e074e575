//! The first paper: Kuroda and Tokoi 2011, from the capture to weighted inbetweens.

mod table_1;

use crate::Outcome;
use crate::part::Part;
use crate::takes::Take;

/// What the samples show.
pub(crate) fn from_samples() -> Outcome<Part> {
    let mut part = Part::default();
    table_1::add(&mut part)?;
    Ok(part)
}

/// What the real clips show.
pub(crate) fn from_takes(_takes: &[Take]) -> Outcome<Part> {
    Ok(Part::default())
}
