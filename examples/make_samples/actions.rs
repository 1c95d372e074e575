//! The actions of all samples.

mod kick;
mod pitch;
mod swing;
mod tennis;

use super::score::{self, Score};

/// All samples, in the order of the papers' tables.
pub(crate) fn all() -> Vec<Score> {
    vec![pitch::short(), kick::score(), tennis::score(), swing::score(), pitch::whole()]
}
