//! A choice (選択): the possible keys, their costs, and those that are picked.

use crate::keys::cheapest::{Cheapest, Entry};
use crate::keys::chords::Chords;

/// Seconds for which a key has to save its price: three koma at 24 a second.
const HELD: f64 = 0.125;

/// Everything that decides which keys are picked, besides the chords. Equal choices have equal outcomes: if nothing but
/// the strength of the keys changes, the picking need not be repeated.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Choice {
    /// Possible keys by frame. The first and the last are the clip's ends and stay.
    pub(super) entries: Vec<Entry>,
    /// Least frames from one key to the next.
    pub(super) apart: f64,
    /// Most found keys, besides those that stay.
    pub(super) most: usize,
    /// How they are picked.
    pub(super) by: By,
}

/// How keys are picked.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum By {
    /// By what they save, each at this price in % of body height.
    Price(f64),
    /// By the strength of each entry.
    Strength(Vec<f64>),
}

/// The outcome of a choice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picked {
    /// Places of the keys among the entries between the clip's ends, and what each saves.
    pub(super) kept: Vec<(usize, f64)>,
    /// Number of keys that would also be worth it.
    pub(super) over_limit: usize,
}

impl Choice {
    /// Picks the keys.
    pub(crate) fn pick(&self, chords: &Chords) -> Picked {
        match &self.by {
            By::Price(price) => self.cheapest(*price, chords),
            By::Strength(strengths) => self.strongest(strengths),
        }
    }

    /// Picks the set that loses least, with what each key saves.
    fn cheapest(&self, price: f64, chords: &Chords) -> Picked {
        let cheapest = Cheapest::among(&self.entries, chords, self.apart);
        let held = HELD * chords.koma_rate();
        let set = cheapest.set(price.powi(2) * held, self.most);
        let saves = cheapest.saves(&set.kept);
        let kept = set.kept.iter().zip(saves).filter(|(entry, _)| self.is_inner(**entry));
        let kept = kept.map(|(entry, saved)| (entry - 1, price_of(saved, held))).collect();
        Picked { kept, over_limit: set.over_limit }
    }

    /// Returns what each entry between the ends saves beside all others, in % of body height; infinite if keys have no
    /// price.
    pub(super) fn prices(&self, chords: &Chords) -> Vec<f64> {
        let inner = self.entries.len() - 2;
        if let By::Strength(_) = self.by {
            return vec![f64::INFINITY; inner];
        }
        let all: Vec<usize> = (0..self.entries.len()).collect();
        let saves = Cheapest::among(&self.entries, chords, self.apart).saves(&all);
        let held = HELD * chords.koma_rate();
        saves[1..=inner].iter().map(|saved| price_of(*saved, held)).collect()
    }

    /// Picks the strongest besides those that stay; of equals the earlier.
    fn strongest(&self, strengths: &[f64]) -> Picked {
        let inner = (0..self.entries.len()).filter(|entry| self.is_inner(*entry));
        let (mut kept, mut found): (Vec<usize>, Vec<usize>) =
            inner.partition(|entry| self.entries[*entry].stays);
        found.sort_by(|a, b| strengths[*b].total_cmp(&strengths[*a]));
        let over_limit = found.len().saturating_sub(self.most);
        kept.extend(found.into_iter().take(self.most));
        kept.sort_unstable();
        let kept = kept.into_iter().map(|entry| (entry - 1, f64::INFINITY)).collect();
        Picked { kept, over_limit }
    }

    /// Whether an entry is not one of the clip's ends.
    fn is_inner(&self, entry: usize) -> bool {
        (1..self.entries.len() - 1).contains(&entry)
    }
}

/// Converts a loss over `held` koma to an error in % of body height.
fn price_of(saved: f64, held: f64) -> f64 {
    (saved.max(0.0) / held).sqrt()
}
