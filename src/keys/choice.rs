//! A choice (選択): what may be a key and what a key costs, and those that are picked.

use crate::keys::cheapest::{Cheapest, Entry};
use crate::keys::chords::Chords;

/// Seconds for which a key has to save its price: three koma of 24 a second.
const HELD: f64 = 0.125;

/// All on which it hangs which keys are picked, beside the chords. The same choice has the same outcome: it need
/// not be made again when nothing but the strength of the keys is another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Choice {
    /// What may be a key, by frame; the first and the last are the clip's ends and stay.
    pub(super) entries: Vec<Entry>,
    /// Frames from one key to the next at least.
    pub(super) apart: f64,
    /// How many may be there of their own.
    pub(super) most: usize,
    /// By what they are picked.
    pub(super) by: By,
}

/// By what keys are picked.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum By {
    /// By what they save: each costs so much, in % of body height.
    Price(f64),
    /// By the strength of each entry.
    Strength(Vec<f64>),
}

/// What was picked of a choice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picked {
    /// The places of the keys among the entries between the clip's ends, and what each saves.
    pub(super) kept: Vec<(usize, f64)>,
    /// How many more would be worth it.
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

    /// The set that loses least, each with what it saves.
    fn cheapest(&self, price: f64, chords: &Chords) -> Picked {
        let cheapest = Cheapest::among(&self.entries, chords, self.apart);
        let held = HELD * chords.koma_rate();
        let set = cheapest.set(price.powi(2) * held, self.most);
        let saves = cheapest.saves(&set.kept);
        let kept = set.kept.iter().zip(saves).filter(|(entry, _)| self.is_inner(**entry));
        let kept = kept.map(|(entry, saved)| (entry - 1, price_of(saved, held))).collect();
        Picked { kept, over_limit: set.over_limit }
    }

    /// What each entry between the ends saves beside all others, in % of body height; infinite where none is asked.
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

    /// The strongest beside those that stay, of equals the earlier.
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

    /// Whether it is none of the clip's ends.
    fn is_inner(&self, entry: usize) -> bool {
        (1..self.entries.len() - 1).contains(&entry)
    }
}

/// What is saved over so many koma, as an error in % of body height.
fn price_of(saved: f64, held: f64) -> f64 {
    (saved.max(0.0) / held).sqrt()
}
