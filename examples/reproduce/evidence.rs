//! `docs/lab/evidence.md`: the quality of the default keys on real clips.

mod actions;
mod events;
mod keys;
mod laws;
mod people;
mod poses;
mod rates;
mod rigs;
mod timing;

use crate::part::Part;
use crate::takes::Take;
use crate::{Outcome, root, windows};

/// Results that need no clip.
pub(crate) fn from_samples() -> Outcome<Part> {
    let mut part = Part::default();
    part.text("people", people::table());
    Ok(part)
}

/// Results from the real clips.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let events = events::read(&root().join("docs/lab/evidence/events.csv"))?;
    let marks = events::read(&root().join("docs/lab/evidence/timing.csv"))?;
    let mut part = Part::default();
    for (name, text) in [
        ("timing", timing::table(takes, &marks)?),
        ("rates", rates::table(takes)),
        ("merges", rates::merges(takes, &events)?),
        ("hits", events::summary(takes, &events)?),
        ("rests", events::rests(takes, &events)?),
        ("actions", actions::table(takes)),
        ("rigs", rigs::table(takes)?),
        ("windows", windows::table(takes)?),
        ("genga-lost", laws::table(takes)?),
    ] {
        part.text(name, text);
    }
    for (name, text) in keys::tables(takes, &events)? {
        part.text(name, text);
    }
    for (name, clip) in poses::PICTURES {
        part.picture(&format!("{name}-poses"), poses::draw(takes, clip)?);
    }
    Ok(part)
}
