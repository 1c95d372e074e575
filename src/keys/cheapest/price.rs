//! The price (値段) at which no more keys are worth it than a limit lets in.
//!
//! A dearer key leaves fewer of them. Between two prices their number is guessed. Where a guess tells nothing new, the
//! price is tried at which both sets cost the same. Either another set is cheaper there, or no number lies between them.

use crate::keys::cheapest::Cheapest;
use crate::maths;

/// The highest price that is tried for a limit, %² of body height times koma: more than anything loses.
const HIGHEST: f64 = 1e12;

/// The lowest, where the first is 0.
pub(super) const LOWEST: f64 = 1e-6;

/// By how much the price goes up at least, and at the most, until too few are worth it.
const STEPS: [f64; 2] = [2.0, 1000.0];

/// Prices that are tried between two in the search for one: more would not tell two sets apart.
const TRIES: usize = 40;

/// How far a price that is tried stays from both ends of the span, as a share of it.
const AWAY: f64 = 0.05;

/// Keys by which two sets may differ and the price between them be aimed at rather than halved for.
const CLOSE: usize = 4;

impl Cheapest<'_> {
    /// The cheapest set at a price, `low` or more, at which so few are worth it; `many` is that at `low`. It is the least
    /// such price, unless just as many as are let in are found at a higher one before.
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
            // Where both cost the same and no other is cheaper, no other is the cheapest at any price between.
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

    /// The price at which a set of many and one of fewer cost the same.
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

/// A price at which about so many are left of those that are found at a lower one: their number falls with its fourth root.
fn dearer(price: f64, found: usize, most: usize) -> f64 {
    let [found, most] = [found, most].map(|count| count as f64 + 0.5);
    let square = (found / most) * (found / most);
    price * (square * square).clamp(STEPS[0], STEPS[1])
}

/// The price between two at which so many would be left if their number were a power of it; not near either of them, lest
/// one end of the span stay for ever.
fn between(prices: [f64; 2], counts: [usize; 2], most: usize) -> f64 {
    let [low, high] = prices.map(maths::ln);
    let [many, few, most] = [counts[0], counts[1], most].map(|count| maths::ln(count as f64 + 0.5));
    let share = ((many - most) / (many - few)).clamp(AWAY, 1.0 - AWAY);
    maths::exp(low + share * (high - low))
}
