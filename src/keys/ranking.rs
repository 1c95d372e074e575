//! All that could be keys in one nested list: the first n of it are the keys when n may stay.

use crate::edits::Edits;
use crate::keys::choose::{entries, is_found, strongest_first};
use crate::keys::price;
use crate::keys::{Candidates, Choose, JointTurns, Key, Rank, Reference};
use crate::motion::Clip;
use crate::time::Frame;

/// The keys of a layer in the order in which they are worth a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// Keys that no setting of price or number takes away, by frame: pins and the ends of rests.
    pub staying: Vec<Frame>,
    /// The others, the best first.
    pub found: Vec<Ranked>,
    rank: Rank,
    seconds: f64,
}

/// A key that was found, with what it is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ranked {
    /// The source frame it shows.
    pub frame: Frame,
    /// What it saves beside all that are better, in % of body height; its strength where keys are ranked
    /// by that. Prices need not fall from one to the next: leaving a key out may make its neighbour
    /// cheaper.
    pub worth: f64,
}

impl Choose {
    /// Every key that these settings could give, whatever its price and however many there are.
    pub fn ranking(
        &self,
        clip: &Clip,
        reference: &Reference,
        candidates: &Candidates,
        joints: &JointTurns<'_>,
        edits: &Edits,
    ) -> Ranking {
        let mut keys = self.eligible(clip, reference, candidates, joints.apart, edits);
        let staying = keys.iter().filter(|key| !is_found(key)).map(|key| key.frame).collect();
        let found = match self.rank {
            Rank::Price => by_price(clip, reference, &keys),
            Rank::Strength => {
                strongest_first(&mut keys);
                let found = keys.iter().filter(|key| is_found(key));
                found.map(|key| Ranked { frame: key.frame, worth: key.strength }).collect()
            }
        };
        Ranking { staying, found, rank: self.rank, seconds: reference.seconds() }
    }
}

fn by_price(clip: &Clip, reference: &Reference, keys: &[Key]) -> Vec<Ranked> {
    let entries = entries(clip, keys);
    let ranked = |(entry, worth): (usize, f64)| Ranked { frame: entries[entry].frame, worth };
    let going = price::going(clip, reference, &entries);
    going.into_iter().rev().map(ranked).collect()
}

impl Ranking {
    /// The settings that keep the first `count` of the found keys, or all when there are fewer, and every
    /// one that stays: a price where one parts them from the others, else a number a second.
    pub fn keeping(&self, count: usize, settings: &Choose) -> Choose {
        let count = count.min(self.found.len());
        let (kept, gone) = self.found.split_at(count);
        let mut settings = Choose { per_second: f64::INFINITY, ..settings.clone() };
        if self.rank == Rank::Strength {
            if !gone.is_empty() {
                settings.per_second = self.per_second(count);
            }
            return settings;
        }
        // The list is taken down from its end until the next costs enough.
        let dearest_gone = gone.iter().map(|key| key.worth).reduce(f64::max);
        let next = kept.last().map_or(f64::INFINITY, |key| key.worth);
        match dearest_gone {
            None => settings.min_price = 0.0,
            Some(gone) if gone < next => settings.min_price = price_between(gone, next),
            Some(_) => {
                settings.min_price = shortest(next, |price| price >= 0.0);
                settings.per_second = self.per_second(count);
            }
        }
        settings
    }

    /// A limit that lets through exactly so many.
    fn per_second(&self, count: usize) -> f64 {
        let allowed = |limit: f64| (limit * self.seconds).floor() == count as f64;
        shortest((count as f64 + 0.5) / self.seconds, |limit| limit > 0.0 && allowed(limit))
    }
}

/// The price of the fewest digits above one and at most another, which may be infinite.
fn price_between(gone: f64, next: f64) -> f64 {
    shortest(next.min(2.0 * gone + 1.0), |price| price > gone)
}

/// The number of the fewest decimals that is at most `number` and fits; `number` itself fits.
fn shortest(number: f64, fits: impl Fn(f64) -> bool) -> f64 {
    let rounded = |decimals| {
        let scale = 10_f64.powi(decimals);
        (number * scale).floor() / scale
    };
    (0..=15).map(rounded).find(|short| *short <= number && fits(*short)).unwrap_or(number)
}

#[cfg(test)]
mod tests;
