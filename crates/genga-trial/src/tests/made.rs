//! Files of answers, as the page would save them.

use crate::Tally;
use crate::plan::{CATCHES, COLUMNS, SCHEMA};

/// The names of the conditions, by their index in a tally.
pub(super) const NAMES: [&str; 5] = ["source", "twos", "threes", "uniform", "genga"];

/// A person who answers.
#[derive(Debug, Clone)]
pub(super) struct Made {
    pub(super) person: String,
    pub(super) trial: &'static str,
    pub(super) hz: f64,
    pub(super) slow: f64,
    /// Number of koma of a pair that were never on screen.
    pub(super) dropped: usize,
    /// Number of wrong catch pairs over all.
    pub(super) wrong: usize,
}

impl Made {
    pub(super) fn new(person: usize) -> Self {
        let person = format!("{person:08x}");
        Self { person, trial: "t1", hz: 60.0, slow: 0.0, dropped: 0, wrong: 0 }
    }

    /// Writes one row per answer, the same for both questions.
    pub(super) fn rows(&self, answers: &Tally) -> Vec<String> {
        let mut pairs = vec![];
        for (taken, left) in (0..5).flat_map(|a| (0..5).map(move |b| (a, b))) {
            for _ in 0..answers.wins(taken, left) as usize {
                pairs.push((NAMES[taken], NAMES[left]));
            }
        }
        let of = 2 * (pairs.len() + CATCHES);
        let mut wrong = self.wrong;
        let mut rows = vec![];
        for question in ["anime", "use"] {
            let catches = (0..CATCHES).map(|_| {
                let is_wrong = wrong > 0;
                wrong = wrong.saturating_sub(1);
                if is_wrong { ("stuck", "genga") } else { ("genga", "stuck") }
            });
            for (taken, left) in pairs.clone().into_iter().chain(catches) {
                let number = rows.len() + 1;
                let (first, second, chosen) =
                    if number % 2 == 0 { (taken, left, "first") } else { (left, taken, "second") };
                let Self { person, trial, hz, slow, dropped, .. } = self;
                rows.push(format!(
                    "{SCHEMA},{trial},{person},7,draws,en,{hz},{slow},{of},{number},{question},kick,{first},{second},{chosen},0,1.5,184,{dropped},24\n"
                ));
            }
        }
        rows
    }

    pub(super) fn file(&self, answers: &Tally) -> String {
        COLUMNS.join(",") + "\n" + &self.rows(answers).concat()
    }
}

/// Writes the file of a person who counts.
pub(super) fn file(person: usize, answers: &Tally) -> String {
    Made::new(person).file(answers)
}
