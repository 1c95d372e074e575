//! Decides whose answers count, and gives the reason for each exclusion.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use crate::Answer;
use crate::plan::{LEAST_HZ, MOST_DROPPED, MOST_SLOW, MOST_WRONG};
use genga::error::Error;

/// A person whose answers do not count.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Excluded {
    /// The person.
    pub person: String,
    /// The first reason that applies.
    pub reason: Reason,
}

/// Why a person's answers do not count.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Pairs are missing.
    Stopped {
        /// Number of answered pairs.
        answered: usize,
        /// Number of pairs.
        of: usize,
    },
    /// Too many catch pairs are wrong.
    Caught {
        /// Number of wrong catch pairs.
        wrong: usize,
        /// Number of catch pairs.
        of: usize,
    },
    /// The screen is too slow for the koma.
    Screen {
        /// Refresh rate in Hz.
        hz: f64,
        /// The share of late refreshes.
        slow: f64,
    },
    /// Too many koma were never on screen.
    Dropped {
        /// The share of those koma.
        share: f64,
    },
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stopped { answered, of } => write!(f, "answered {answered} of {of} pairs"),
            Self::Caught { wrong, of } => {
                write!(f, "took what stands still in {wrong} of {of} catch pairs")
            }
            Self::Screen { hz, slow } => write!(
                f,
                "the screen showed {hz:.0} refreshes a second, {:.0} % of them later than a koma",
                100.0 * slow
            ),
            Self::Dropped { share } => {
                write!(f, "{:.1} % of the koma never were on screen", 100.0 * share)
            }
        }
    }
}

/// The answers of a person, by pair number.
pub(super) type OfPerson = BTreeMap<usize, Answer>;

/// Groups answers by person. An answer that was saved twice counts once.
pub(super) fn by_person(answers: Vec<Answer>) -> Result<BTreeMap<String, OfPerson>, Error> {
    let wrong = |message| Error::Table { place: None, message, source: None };
    let mut persons: BTreeMap<String, OfPerson> = BTreeMap::new();
    let trial = answers.first().map(|answer| answer.trial.clone()).unwrap_or_default();
    for answer in answers {
        if answer.trial != trial {
            return Err(wrong(format!(
                "the answers are of two trials, {trial} and {}: read those of each by themselves",
                answer.trial
            )));
        }
        let own = persons.entry(answer.person.clone()).or_default();
        let (person, number) = (answer.person.clone(), answer.number);
        let before = own.insert(number, answer);
        if before.is_some_and(|before| before != own[&number]) {
            return Err(wrong(format!(
                "person {person} has two different answers number {number}: leave out the file that is not theirs"
            )));
        }
    }
    Ok(persons)
}

/// Returns why a person does not count; `None` if they do.
pub(super) fn reason(answers: &OfPerson) -> Option<Reason> {
    let any = answers.values().next()?;
    if answers.len() < any.of {
        return Some(Reason::Stopped { answered: answers.len(), of: any.of });
    }
    let catches = answers.values().filter(|answer| answer.is_catch());
    let wrong = catches.clone().filter(|answer| answer.is_caught()).count();
    if wrong > MOST_WRONG {
        return Some(Reason::Caught { wrong, of: catches.count() });
    }
    // If the screen was measured more than once, the worst measurement decides.
    let worst = |of: fn(&Answer) -> f64| answers.values().map(of).fold(0.0, f64::max);
    let hz = answers.values().map(|answer| answer.hz).fold(f64::INFINITY, f64::min);
    let slow = worst(|answer| answer.slow);
    if hz < LEAST_HZ || slow > MOST_SLOW {
        return Some(Reason::Screen { hz, slow });
    }
    let sum = |of: fn(&Answer) -> usize| answers.values().map(of).sum::<usize>() as f64;
    let share = sum(|answer| answer.dropped) / sum(|answer| answer.koma).max(1.0);
    (share > MOST_DROPPED).then_some(Reason::Dropped { share })
}
