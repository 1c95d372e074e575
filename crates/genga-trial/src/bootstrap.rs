//! Bootstrap confidence intervals (ブートストラップ): persons are resampled with replacement.

use serde::Serialize;

use crate::Tally;
use genga::maths::{Lots, erfc};

/// Persons are resampled rather than answers, as two answers of one person have more in common than those of two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bootstrap {
    /// Number of resamples; default 2000.
    pub draws: usize,
    /// The random seed; default 0.
    pub seed: u64,
}

/// A 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    /// The lower bound, exceeded by 97.5 %. Infinite for a single person, from whom the variation between persons is
    /// unknown.
    pub low: f64,
    /// The upper bound, exceeded by 2.5 %.
    pub high: f64,
}

impl Default for Bootstrap {
    fn default() -> Self {
        Self { draws: 2000, seed: 0 }
    }
}

impl Interval {
    /// Builds the interval from the figures of all resamples; `left_out` is the share cut off on each side.
    fn from_figures(mut figures: Vec<f64>, left_out: Option<f64>) -> Self {
        let Some(share) = left_out else {
            return Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
        };
        figures.sort_by(f64::total_cmp);
        Self { low: at(&figures, share), high: at(&figures, 1.0 - share) }
    }

    /// Whether a figure lies in the interval.
    pub fn holds(&self, figure: f64) -> bool {
        (self.low..=self.high).contains(&figure)
    }
}

impl Bootstrap {
    /// Returns an interval for each figure computed from the pooled answers of all persons; empty without persons.
    pub fn intervals(
        &self,
        persons: &[Tally],
        figures: impl Fn(&Tally) -> Vec<f64>,
    ) -> Vec<Interval> {
        let Some(first) = persons.first() else { return vec![] };
        let mut lots = Lots::new(self.seed);
        let mut drawn: Vec<Vec<f64>> = vec![];
        for _ in 0..self.draws {
            let mut again = Tally::new(first.conditions());
            persons.iter().for_each(|_| again.add(&persons[lots.below(persons.len())]));
            let found = figures(&again);
            drawn.resize(found.len(), vec![]);
            drawn.iter_mut().zip(found).for_each(|(row, figure)| row.push(figure));
        }
        let left_out = left_out(persons.len());
        drawn.into_iter().map(|figures| Interval::from_figures(figures, left_out)).collect()
    }
}

/// Returns the share of resamples to cut off on each side, so that 95 % of intervals of this many persons contain the
/// truth; `None` for one person. Resamples of few persons vary too little: Hesterberg (2015) cuts off fewer of them, by
/// Student's distribution.
fn left_out(persons: usize) -> Option<f64> {
    let (count, free) = (persons as f64, persons.checked_sub(2)? as f64 + 1.0);
    let z: f64 = 1.959_963_984_540_054;
    let (z3, z5, z7) = (z.powi(3), z.powi(5), z.powi(7));
    // Student's 97.5th percentile by the Cornish–Fisher expansion.
    let student = z
        + (z3 + z) / (4.0 * free)
        + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * free.powi(2))
        + (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * free.powi(3));
    Some(0.5 * erfc(student * (count / free).sqrt() / 2.0_f64.sqrt()))
}

/// Returns a quantile of the distribution behind sorted draws, interpolated linearly.
fn at(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1) as f64;
    let place = (share * (last + 2.0) - 1.0).clamp(0.0, last);
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_leaves_out_as_many_on_both_sides() {
        let found = Interval::from_figures((1..=999).rev().map(f64::from).collect(), Some(0.025));
        assert_eq!((found.low, found.high), (25.0, 975.0));
        assert!(found.holds(25.0) && !found.holds(24.0) && !found.holds(976.0));
        assert_eq!(
            Interval::from_figures(vec![3.0], Some(0.025)),
            Interval { low: 3.0, high: 3.0 }
        );
    }

    #[test]
    fn of_few_persons_fewer_draws_are_left_out() {
        // Student's percentile, and by how much resamples of so few would have to be wider.
        for (persons, student) in [(12, 2.200_985), (24, 2.068_658), (48, 2.011_741)] {
            let count = f64::from(persons);
            let wide: f64 = student * (count / (count - 1.0)).sqrt();
            let found = left_out(persons as usize).unwrap();
            assert!((found - 0.5 * erfc(wide / 2.0_f64.sqrt())).abs() < 1e-5, "{found}");
        }
        assert!((left_out(1_000_000).unwrap() - 0.025).abs() < 1e-6);
        assert_eq!((left_out(0), left_out(1)), (None, None));
        let one = Bootstrap::default().intervals(&[Tally::new(2)], |_| vec![0.3]);
        assert!(one[0].holds(1e300) && one[0].holds(-1e300), "one person says nothing of others");
    }

    #[test]
    fn persons_are_drawn_whole_and_the_same_for_the_same_seed() {
        // Each person gives the same answer ten times, so sums over resampled persons are multiples of ten.
        let person = |taken: usize| {
            let mut tally = Tally::new(2);
            (0..10).for_each(|_| tally.count(taken, 1 - taken));
            tally
        };
        let persons: Vec<Tally> = (0..8).map(|at| person(at % 2)).collect();
        let seen = std::cell::RefCell::new(vec![]);
        let asked = Bootstrap { draws: 100, seed: 3 };
        let wins = |tally: &Tally| {
            seen.borrow_mut().push(tally.wins(0, 1));
            assert_eq!(tally.taken(0).1, 80.0);
            vec![tally.wins(0, 1)]
        };
        let found = asked.intervals(&persons, wins);
        assert!(seen.borrow().iter().all(|wins| wins % 10.0 == 0.0));
        assert!(found[0].low >= 0.0 && found[0].low < 40.0 && found[0].high > 40.0);
        assert_eq!(asked.intervals(&persons, |tally| vec![tally.wins(0, 1)]), found);
        assert!(Bootstrap::default().intervals(&[], |_| vec![]).is_empty());
    }
}
