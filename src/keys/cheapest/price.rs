//! The price (値段) at which no more keys are worth it than a limit allows.
//!
//! A higher price leaves fewer keys. Between two prices the number of keys is interpolated. If a guess tells nothing
//! new, the price is tried at which both sets cost the same. Either a third set is cheaper there, or no number lies
//! between.

use crate::keys::cheapest::Cheapest;
use crate::maths;

/// Highest price that is tried for a limit, in %² of body height times koma: more than anything loses.
const HIGHEST: f64 = 1e12;

/// Lowest price that is tried, used if the given price is 0.
pub(super) const LOWEST: f64 = 1e-6;

/// Least and largest factor by which the price rises in a step, until few enough keys are worth it.
const STEPS: [f64; 2] = [2.0, 1000.0];

/// Most prices tried between two bounds: more would not tell two sets apart.
const TRIES: usize = 40;

/// Distance of a tried price from both ends of the span, as a share of the span.
const AWAY: f64 = 0.05;

/// Difference in keys up to which two sets are tried at their crossing price instead of an interpolated one.
const CLOSE: usize = 4;

impl Cheapest<'_> {
    /// Finds the cheapest set with at most `most` found keys, at a price of `low` or more. `many` is the set at `low`.
    /// It is the least such price, unless a higher price tried before leaves exactly `most`.
    pub(super) fn limited(&self, mut low: f64, mut many: Vec<usize>, most: usize) -> Vec<usize> {
        if self.found(&many) <= most {
            return many;
        }
        let (mut high, mut few) = loop {
            let high = dearer(low, self.found(&many), most);
            let few = self.at(high);
            if self.found(&few) <= most || high >= HIGHEST {
                break (high, few);
            }
            (low, many) = (high, few);
        };
        let mut aims = false;
        for _ in 0..TRIES {
            let counts = [&many, &few].map(|set| self.found(set));
            if counts[1] >= most {
                break;
            }
            aims |= counts[0] <= counts[1] + CLOSE;
            let price = if aims {
                self.crossing(&many, &few).clamp(low, high)
            } else {
                between([low, high], counts, most)
            };
            let set = self.at(price);
            // If both sets tie for the minimum here, no third set is optimal in between (lower envelope).
            if aims && (set == many || set == few) {
                break;
            }
            let found = self.found(&set);
            aims |= counts.contains(&found);
            if found > most {
                (low, many) = (price, set);
            } else {
                (high, few) = (price, set);
            }
        }
        few
    }

    /// Returns the price at which a larger and a smaller set cost the same.
    fn crossing(&self, many: &[usize], few: &[usize]) -> f64 {
        let loss =
            |set: &[usize]| set.windows(2).map(|ends| self.loss(ends[0], ends[1])).sum::<f64>();
        let cost = |set: &[usize]| {
            let found = set.iter().map(|at| self.entries[*at]).filter(|entry| !entry.stays);
            found.map(|entry| entry.cost).sum::<f64>()
        };
        (loss(few) - loss(many)) / (cost(many) - cost(few)).max(1e-9)
    }
}

/// Guesses a price that leaves about `most` of `found` keys: their number falls with the fourth root of the price.
fn dearer(price: f64, found: usize, most: usize) -> f64 {
    let [found, most] = [found, most].map(|count| count as f64 + 0.5);
    let square = (found / most) * (found / most);
    price * (square * square).clamp(STEPS[0], STEPS[1])
}

/// Guesses the price between two that leaves `most` keys, if their number is a power of the price. Stays away from both
/// bounds, lest one of them never move.
fn between(prices: [f64; 2], counts: [usize; 2], most: usize) -> f64 {
    let [low, high] = prices.map(maths::ln);
    let [many, few, most] = [counts[0], counts[1], most].map(|count| maths::ln(count as f64 + 0.5));
    let share = ((many - most) / (many - few)).clamp(AWAY, 1.0 - AWAY);
    maths::exp(low + share * (high - low))
}
