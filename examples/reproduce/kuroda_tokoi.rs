//! The first paper: Kuroda and Tokoi 2011, from the capture to weighted inbetweens.

mod ball;
mod compared;
mod fit;
mod readings;
mod table_1;
mod walk;
mod walls;
mod wrist;

use crate::Outcome;
use crate::part::Part;
use crate::takes::Take;

/// Results from the samples.
pub(crate) fn from_samples() -> Outcome<Part> {
    let mut part = Part::default();
    wrist::add(&mut part)?;
    ball::add(&mut part)?;
    table_1::add(&mut part)?;
    compared::add_sample(&mut part)?;
    walls::add_sample(&mut part)?;
    Ok(part)
}

/// Results from the real clips.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let mut part = Part::default();
    walk::add(&mut part, takes)?;
    compared::add_takes(&mut part, takes)?;
    walls::add_takes(&mut part, takes)?;
    Ok(part)
}
