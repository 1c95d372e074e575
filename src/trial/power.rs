//! How many people are needed (検出力), by studies that are made up.

use rayon::prelude::*;
use serde::Serialize;

use crate::trial::{Bootstrap, BradleyTerry, Crowd, Tally};

/// A made-up study, done again and again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Study {
    /// How often somebody of middling taste takes the first condition before the second: 0.5 for no difference.
    pub chance: f64,
    /// Conditions in all, 2 or more; the others are as good as the second.
    pub conditions: usize,
    /// How far tastes lie apart: see [`Crowd::spread`].
    pub spread: f64,
    /// Pairs that a person sees.
    pub pairs: usize,
    /// Persons who count.
    pub persons: usize,
}

/// What came out of such studies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Power {
    /// The share of studies that find the difference: its interval lies above 0.
    pub found: f64,
    /// The share of studies whose interval has the true difference in it; 0.95 is promised.
    pub covered: f64,
}

/// Draws of the bootstrap in each study: fewer than for real answers, whose interval is made once.
const DRAWS: usize = 200;

/// Persons of whom the true difference is known: with own tastes it is less than that of their middle.
const ALL: usize = 20_000;

impl Study {
    /// Does so many studies.
    ///
    /// ```
    /// use genga::trial::Study;
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

/// The first score minus the second.
fn difference(answers: &Tally) -> f64 {
    let scores = BradleyTerry::default().scores(answers);
    scores[0] - scores[1]
}
