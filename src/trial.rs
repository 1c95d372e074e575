//! **Ask** (問う): a blind test, in which people say which of two films they take.
//!
//! A [`Trial`] makes a page that shows films of the same figure two at a time: the source, even timings, the sheet of this
//! program, sheets of a person's own. What is asked, of whom and how it is evaluated stands in its [`Plan`] before anybody
//! answers. [`Verdict`] reads the answers: scores by [`BradleyTerry`], intervals by a bootstrap over persons. A [`Crowd`]
//! answers as persons with known preferences would, so that [`Power`] can say how many people are needed.

mod answers;
mod bootstrap;
mod bradley_terry;
mod conditions;
mod counted;
mod crowd;
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
pub use counted::{Excluded, Reason};
pub use crowd::Crowd;
pub use page::{Files, OwnSheet, Take, Trial};
pub use plan::{Plan, Planned, Question, Shown};
pub use power::{Power, Study};
pub use tally::Tally;
pub use verdict::{Difference, Score, Verdict, Votes};
