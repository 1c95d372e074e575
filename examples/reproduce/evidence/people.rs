//! Estimates how many people a blind test needs, with simulated studies.

use genga_trial::{Condition, Study, Trial};

use crate::table::{Table, percent};

/// Number of studies of each kind. It gives a share of 0.9 to within 0.02.
const STUDIES: usize = 200;
/// Probabilities that one condition is preferred over the other. At the first there is nothing to find.
const CHANCES: [f64; 4] = [0.5, 0.6, 0.65, 0.7];
/// Standard deviation of people's tastes, in logits: with 0.5, two out of three people are within it of the mean.
const SPREAD: f64 = 0.5;

/// A table with one row per number of people.
pub(crate) fn table() -> String {
    let chances = CHANCES.map(|chance| format!(">{} in 100", (100.0 * chance).round()));
    let names = [">persons who count"].into_iter().chain(chances.iter().map(String::as_str));
    let mut table =
        Table::new(&names.chain([">intervals that hold the truth"]).collect::<Vec<_>>());
    for persons in [12, 24, 48, 96] {
        let power = CHANCES.map(|chance| {
            let (conditions, pairs) = (Condition::ALL.len(), Trial::default().pairs);
            Study { chance, conditions, spread: SPREAD, pairs, persons }.power(STUDIES, 0)
        });
        let held = power.iter().map(|power| power.covered).sum::<f64>() / CHANCES.len() as f64;
        let found = power.iter().map(|power| percent(power.found));
        let row = [persons.to_string()].into_iter().chain(found).chain([percent(held)]);
        table.row(&row.collect::<Vec<_>>());
    }
    table.text()
}
