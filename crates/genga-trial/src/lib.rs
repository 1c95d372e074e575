//! **Ask** (問う): a blind test in which people say which of two films they prefer.
//!
//! A [`Trial`] makes a page that shows films of the same figure two at a time: the source, even timings, the program's
//! sheet, and a person's own sheets. Its [`Plan`] fixes the questions, the participants and the evaluation before
//! anybody answers. [`Verdict`] reads the answers: scores by [`BradleyTerry`], intervals by a bootstrap over persons. A
//! [`Crowd`] answers like persons with known preferences, so that [`Power`] can tell how many people are needed.

// Tests may compare with the standard library.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod answers;
mod bootstrap;
mod bradley_terry;
mod conditions;
mod crowd;
mod exclusions;
mod page;
mod plan;
mod power;
mod tally;
#[cfg(test)]
mod tests;
mod verdict;

pub use answers::{Answer, Place};
pub use bootstrap::{Bootstrap, Interval};
pub use bradley_terry::BradleyTerry;
pub use conditions::Condition;
pub use crowd::Crowd;
pub use exclusions::{Excluded, Reason};
pub use page::{Files, OwnSheet, Take, Trial};
pub use plan::{Plan, Planned, Question, Shown};
pub use power::{Power, Study};
pub use tally::Tally;
pub use verdict::{Difference, Score, Verdict, Votes};

#[cfg(test)]
#[path = "../../../tests/cases/mod.rs"]
mod cases;
