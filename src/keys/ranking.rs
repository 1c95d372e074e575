//! All that could be keys in one nested list: the first n of it are the keys when n may stay.

use std::collections::BTreeSet;

use crate::edits::Edits;
use crate::keys::bridge::Bridge;
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
    /// Every key that these settings could give, whatever its price and however many there are, before any
    /// is moved.
    pub fn ranking(
        &self,
        clip: &Clip,
        reference: &Reference,
        candidates: &Candidates,
        joints: &JointTurns<'_>,
        edits: &Edits,
    ) -> Ranking {
        if edits.only_pins {
            let keys = self.choose(clip, reference, candidates, joints, edits).keys;
            let staying = keys.iter().map(|key| key.frame).collect();
            return Ranking {
                staying,
                found: vec![],
                rank: self.rank,
                seconds: reference.seconds(),
            };
        }
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

    /// The fewest found keys with which the body is nowhere further off than `most`, in % of its height,
    /// when it is slerped from key to key and between them and the clip's ends; where no number of them
    /// will do, the fewest with which it is so on the fewest koma.
    ///
    /// A key more may well put the body further off somewhere. So keys are added one by one, and the first
    /// number that will do is the answer: no smaller one does.
    pub fn fewest_within(&self, most: f64, clip: &Clip, reference: &Reference) -> usize {
        let ends = [clip.first(), clip.last()];
        let found = self.found.iter().map(|key| key.frame);
        let all: BTreeSet<Frame> =
            ends.into_iter().chain(self.staying.iter().copied()).chain(found.clone()).collect();
        let frames: Vec<Frame> = all.into_iter().collect();
        let mut rebuilt = Rebuilt::between_ends(clip, reference, &frames);
        self.staying.iter().for_each(|frame| rebuilt.add(*frame));
        let mut fewest = (rebuilt.koma_beyond(most), 0);
        for (before, frame) in found.enumerate() {
            if fewest.0 == 0 {
                break;
            }
            rebuilt.add(frame);
            fewest = fewest.min((rebuilt.koma_beyond(most), before + 1));
        }
        fewest.1
    }

    /// A limit that lets through exactly so many.
    fn per_second(&self, count: usize) -> f64 {
        let allowed = |limit: f64| (limit * self.seconds).floor() == count as f64;
        shortest((count as f64 + 0.5) / self.seconds, |limit| limit > 0.0 && allowed(limit))
    }
}

/// The body made again from some keys, to which others are added.
struct Rebuilt<'a> {
    bridge: Bridge<'a>,
    reference: &'a Reference,
    /// All that can be keys, and the clip's ends.
    frames: &'a [Frame],
    /// Those that are, by their place in the list.
    kept: BTreeSet<usize>,
    /// How far off the body is at each koma, in % of its height.
    errors: Vec<f64>,
}

impl<'a> Rebuilt<'a> {
    /// From the first of some frames to the last and nothing between.
    fn between_ends(clip: &Clip, reference: &'a Reference, frames: &'a [Frame]) -> Self {
        let last = frames.len() - 1;
        let mut rebuilt = Self {
            bridge: Bridge::new(clip, reference, frames),
            reference,
            frames,
            kept: BTreeSet::from([0, last]),
            errors: vec![0.0; reference.koma()],
        };
        rebuilt.slerp(0, last);
        rebuilt
    }

    fn koma_beyond(&self, most: f64) -> usize {
        self.errors.iter().filter(|error| **error > most).count()
    }

    fn add(&mut self, frame: Frame) {
        let at = self.frames.partition_point(|other| *other < frame);
        if !self.kept.insert(at) {
            return;
        }
        let before = self.kept.range(..at).next_back().copied().unwrap_or(at);
        let after = self.kept.range(at + 1..).next().copied().unwrap_or(at);
        // A koma on the key itself lies in neither half.
        self.errors[self.reference.koma_between(self.frames[before], self.frames[after])].fill(0.0);
        self.slerp(before, at);
        self.slerp(at, after);
    }

    fn slerp(&mut self, from: usize, to: usize) {
        let errors = &mut self.errors;
        self.bridge.errors(from, to, |koma, error| errors[koma] = error);
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
