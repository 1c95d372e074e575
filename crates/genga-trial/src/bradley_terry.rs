//! The model of Bradley and Terry (1952): each condition has a score, and the difference of two scores gives how often
//! one is preferred.

use crate::Tally;
use genga::maths::{exp, ln};

/// Settings of the score fit.
///
/// One condition is preferred to another with probability 1 / (1 + e^−d), where d is the difference of their scores.
/// The scores are the maximum-likelihood estimate with a mean of 0. They are found by the iteration of Hunter (2004),
/// each step of which increases the likelihood.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BradleyTerry {
    /// Answers added to each pair, half each way; default 0.2. Without them a condition that was always or never
    /// preferred has no score. More of them draw all scores together.
    pub added: f64,
    /// Maximum number of steps; default 10000.
    pub steps: usize,
}

/// The iteration ends when no strength changes by more than this share.
const STILL: f64 = 1e-8;

impl Default for BradleyTerry {
    fn default() -> Self {
        Self { added: 0.2, steps: 10_000 }
    }
}

impl BradleyTerry {
    /// Returns the scores of all conditions in logits, with a mean of 0.
    ///
    /// ```
    /// use genga_trial::{BradleyTerry, Tally};
    ///
    /// let mut answers = Tally::new(2);
    /// (0..30).for_each(|_| answers.count(0, 1));
    /// (0..10).for_each(|_| answers.count(1, 0));
    /// let [one, other] = BradleyTerry { added: 0.0, ..BradleyTerry::default() }.scores(&answers)[..] else { panic!() };
    /// assert!((one - other - f64::ln(3.0)).abs() < 1e-6, "three times of four");
    /// ```
    pub fn scores(&self, answers: &Tally) -> Vec<f64> {
        let count = answers.conditions();
        let half = 0.5 * self.added;
        let taken: Vec<f64> = (0..count)
            .map(|one| answers.taken(one).0 + half * count.saturating_sub(1) as f64)
            .collect();
        let mut strengths = vec![1.0; count];
        for _ in 0..self.steps {
            let before = strengths.clone();
            for one in 0..count {
                let others = (0..count).filter(|other| *other != one);
                let met = |other| answers.wins(one, other) + answers.wins(other, one) + self.added;
                let sum: f64 =
                    others.map(|other| met(other) / (strengths[one] + strengths[other])).sum();
                // No answers concern this condition.
                strengths[one] = if sum > 0.0 { taken[one] / sum } else { 1.0 };
            }
            let is_still = |(now, then): (&f64, &f64)| (now - then).abs() <= STILL * then;
            if strengths.iter().zip(&before).all(is_still) {
                break;
            }
        }
        centred(&strengths)
    }

    /// Returns the probability that a condition is preferred to another, from the difference of their scores.
    pub fn chance(difference: f64) -> f64 {
        1.0 / (1.0 + exp(-difference))
    }

    /// Returns the difference of scores that gives a probability.
    pub fn difference(chance: f64) -> f64 {
        ln(chance / (1.0 - chance))
    }
}

/// Returns the logarithms minus their mean.
fn centred(strengths: &[f64]) -> Vec<f64> {
    // A condition that was never preferred, without added answers, gets the smallest strength that has a logarithm.
    let logs = strengths.iter().map(|strength| ln(strength.max(f64::MIN_POSITIVE)));
    let logs: Vec<f64> = logs.collect();
    let mean = logs.iter().sum::<f64>() / logs.len().max(1) as f64;
    logs.into_iter().map(|log| log - mean).collect()
}
