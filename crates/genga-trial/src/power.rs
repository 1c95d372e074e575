//! Power analysis by simulated studies (検出力): how many people are needed.

use rayon::prelude::*;
use serde::Serialize;

use crate::{Bootstrap, BradleyTerry, Crowd, Tally};

/// A simulated study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Study {
    /// How often a person of average taste prefers the first condition to the second: 0.5 for no difference.
    pub chance: f64,
    /// Number of conditions, 2 or more; the others equal the second.
    pub conditions: usize,
    /// Spread of tastes: see [`Crowd::spread`].
    pub spread: f64,
    /// Number of pairs that a person sees.
    pub pairs: usize,
    /// Number of persons who count.
    pub persons: usize,
}

/// The outcome of many simulated studies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Power {
    /// The share of studies that detect the difference: their interval lies above 0.
    pub found: f64,
    /// The share of studies whose interval contains the true difference; 0.95 is nominal.
    pub covered: f64,
}

/// Resamples per study; fewer than for real answers, whose interval is computed only once.
const DRAWS: usize = 200;

/// Number of persons from whom the true difference is estimated. With individual tastes it is smaller than that of the
/// average taste.
const ALL: usize = 20_000;

impl Study {
    /// Simulates a number of studies.
    ///
    /// ```
    /// use genga_trial::Study;
    ///
    /// let study = Study { chance: 0.75, conditions: 3, spread: 0.5, pairs: 20, persons: 16 };
    /// assert!(study.power(20, 0).found > 0.9, "so large a difference is hardly missed");
    /// ```
    pub fn power(&self, studies: usize, seed: u64) -> Power {
        let conditions = self.conditions.max(2);
        let mut scores = vec![0.0; conditions];
        scores[0] = BradleyTerry::difference(self.chance);
        let crowd = Crowd { scores, spread: self.spread, pairs: self.pairs };
        let truth = difference(&Tally::sum(conditions, &crowd.answers(ALL, !seed)));
        let one = |study: usize| {
            let seed = seed.wrapping_add(study as u64);
            let persons = crowd.answers(self.persons, seed);
            let asked = Bootstrap { draws: DRAWS, seed };
            let intervals = asked.intervals(&persons, |tally| vec![difference(tally)]);
            intervals.first().map(|interval| (interval.low > 0.0, interval.holds(truth)))
        };
        let done: Vec<(bool, bool)> = (0..studies).into_par_iter().filter_map(one).collect();
        let found = done.iter().filter(|(found, _)| *found).count();
        let covered = done.iter().filter(|(_, covered)| *covered).count();
        let share = |count: usize| count as f64 / studies.max(1) as f64;
        Power { found: share(found), covered: share(covered) }
    }
}

/// Returns the first score minus the second.
fn difference(answers: &Tally) -> f64 {
    let scores = BradleyTerry::default().scores(answers);
    scores[0] - scores[1]
}
