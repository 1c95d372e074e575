//! From turns to the keys of a layer: merged over joints, ranked by what they save, cut.

use serde::{Deserialize, Serialize};

use crate::edits::Edits;
use crate::error::Error;
use crate::keys::price::{self, Entry};
use crate::keys::reference::Reference;
use crate::keys::vote::Poll;
use crate::keys::{Candidate, Candidates, Key, LayerKeys, Origin, Wall, rest, sum};
use crate::motion::{Clip, JointId};
use crate::signal::{Signals, Turn, TurnFinder, TurnKind};
use crate::time::{Clock, Frame, Span};

/// How the turns of joints become the keys of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Merge {
    /// Every joint votes with the weight of what hangs on it; keys are the maxima of the vote.
    Vote,
    /// The joints' speeds are added first; keys are the valleys of the sum.
    Sum,
    /// A turn of any joint is a key [KT11 §3.3].
    #[default]
    Union,
}

/// By what the keys are ranked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rank {
    /// By what a key saves: how far the body would be off at the worst koma without it.
    #[default]
    Price,
    /// By how strong it is.
    Strength,
}

/// Chooses the keys (原画) of a layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Choose {
    /// How joints are merged. Default: `union`, and the price picks from it.
    pub merge: Merge,
    /// How far a joint's vote carries, frames or seconds. Default 0.06 s. Raised, it joins turns that
    /// lie further apart into one key, and quick double actions become one.
    pub reach: Span,
    /// By what keys are ranked. Default: `price`.
    pub rank: Rank,
    /// The least a key must save, in % of body height: how far the body would be off at the worst koma
    /// without it; 0 or more, default 3. Raised, small gestures lose their keys first. It counts when
    /// ranked by price.
    pub min_price: f64,
    /// The speed below which the whole body rests, in % of its height a second (root mean square over
    /// the joints); 0 or more, default 12, 0 for no rests. Both ends of a rest of half a second or more
    /// are keys whatever they save. Raised, slow gestures count as rests.
    pub rest: f64,
    /// The least strength of a key, 0 or more, default 0. Raised, moments on which few joints agree
    /// lose their keys.
    pub min_strength: f64,
    /// Found keys a second at the most, the best first; pins and the ends of rests come on top. Above
    /// 0, default 4.5, `inf` for no limit. Lowered, fast
    /// passages lose their keys first.
    pub per_second: f64,
}

impl Default for Choose {
    fn default() -> Self {
        Self {
            merge: Merge::Union,
            reach: Span::Seconds(0.06),
            rank: Rank::Price,
            min_price: 3.0,
            rest: 12.0,
            min_strength: 0.0,
            per_second: 4.5,
        }
    }
}

impl Choose {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        let at_least_0 = |value: f64| value >= 0.0 && value.is_finite();
        if !self.reach.is_length() {
            return Err(Error::setting("keys.reach", "must be a length of time, 0 or more"));
        }
        if !at_least_0(self.min_price) {
            return Err(Error::setting("keys.min_price", "must be 0 or more, in % of body height"));
        }
        if !at_least_0(self.rest) {
            return Err(Error::setting(
                "keys.rest",
                "must be 0 or more, in % of body height a second",
            ));
        }
        if !at_least_0(self.min_strength) {
            return Err(Error::setting("keys.min_strength", "must be 0 or more"));
        }
        if self.per_second.is_nan() || self.per_second <= 0.0 {
            return Err(Error::setting("keys.per_second", "must be above 0, or inf for no limit"));
        }
        Ok(())
    }

    /// What the joints say together.
    ///
    /// `turns` are the finder's on `filtered`; `weights` one value a joint, see [`weights`]; `delay`
    /// that of the filter and `apart` the least distance of two keys, both in frames.
    pub fn candidates(
        &self,
        finder: &TurnFinder,
        filtered: &Signals,
        turns: &[Vec<Turn>],
        weights: &[f64],
        delay: f64,
        apart: f64,
    ) -> Candidates {
        let merged = |kind| match self.merge {
            Merge::Sum => self.summed(finder, filtered, weights, delay, kind, apart),
            Merge::Vote => {
                let poll = self.poll(filtered, weights, apart);
                poll.elected(&poll.count(turns, kind))
            }
            Merge::Union => {
                let poll = self.poll(filtered, weights, apart);
                poll.named(turns, kind, &poll.count(turns, kind))
            }
        };
        let inside = |frame: Frame| {
            frame > filtered.first && frame.0 + 1 < filtered.first.0 + filtered.frames()
        };
        Candidates {
            keys: merged(TurnKind::Key)
                .into_iter()
                .filter(|(frame, strength)| inside(*frame) && *strength >= self.min_strength)
                .map(|(frame, strength)| Candidate { frame, strength })
                .collect(),
            walls: merged(TurnKind::Wall)
                .into_iter()
                .map(|(frame, strength)| Wall { frame, strength })
                .collect(),
        }
    }

    fn poll<'a>(&self, filtered: &Signals, weights: &'a [f64], apart: f64) -> Poll<'a> {
        let reach = self.reach.frames(filtered.rate);
        Poll { first: filtered.first, frames: filtered.frames(), weights, reach, apart }
    }

    fn summed(
        &self,
        finder: &TurnFinder,
        filtered: &Signals,
        weights: &[f64],
        delay: f64,
        kind: TurnKind,
        apart: f64,
    ) -> Vec<(Frame, f64)> {
        let mean = sum::mean_speed(filtered, weights);
        let turns = finder.find(&mean, delay).pop().unwrap_or_default();
        let margin = (delay.round() as usize).min(mean.frames()) + 1;
        let mut found = sum::prominences(&mean, &turns, kind, margin);
        found.retain(|(_, strength)| *strength > 0.0);
        let rows = found.into_iter().map(|(frame, strength)| (frame.0, strength)).collect();
        let apart = crate::keys::peaks::strongest_apart(rows, apart);
        apart.into_iter().map(|(frame, strength)| (Frame(frame), strength)).collect()
    }

    /// The keys that are worth a drawing, with who voted for them; a person's pins among them.
    pub fn choose(
        &self,
        clip: &Clip,
        clock: Clock,
        candidates: &Candidates,
        turns: &[Vec<Turn>],
        weights: &[f64],
        edits: &Edits,
    ) -> LayerKeys {
        let reference = Reference::of(clip, clock);
        let rests = rest::rest_ends(&reference, self.rest);
        let mut keys = corrected(candidates, &rests, edits, &reference);
        let over_limit = match self.rank {
            Rank::Price => self.keep_the_dear(&reference, &mut keys),
            Rank::Strength => self.keep_the_strong(reference.seconds(), &mut keys),
        };
        let reach = self.reach.frames(clip.rate()).max(clip.rate().fps() / clock.koma_rate);
        for key in &mut keys {
            key.voters = voters(turns, weights, key.frame, reach);
        }
        LayerKeys { keys, walls: candidates.walls.clone(), over_limit }
    }

    /// Leaves the keys that are worth a drawing, with their prices. Says how many more would be.
    fn keep_the_dear(&self, reference: &Reference<'_>, keys: &mut Vec<Key>) -> usize {
        let clip = reference.clip();
        let end = |frame| Entry { frame, stays: true };
        let entries: Vec<Entry> = std::iter::once(end(clip.first()))
            .chain(keys.iter().map(|key| Entry { frame: key.frame, stays: !is_found(key) }))
            .chain(std::iter::once(end(clip.last())))
            .collect();
        let most = self.most_keys(reference.seconds());
        let worthwhile = price::worthwhile(reference, &entries, self.min_price, most);
        let mut prices = worthwhile.prices[1..].iter();
        keys.retain_mut(|key| {
            let price = prices.next().copied().flatten();
            key.price = price.unwrap_or(key.price);
            price.is_some()
        });
        worthwhile.over_limit
    }

    /// Leaves the strongest keys. Says how many more there are.
    fn keep_the_strong(&self, seconds: f64, keys: &mut Vec<Key>) -> usize {
        let before = keys.len();
        let staying = keys.iter().filter(|key| !is_found(key)).count();
        let strength = |key: &Key| if is_found(key) { key.strength } else { f64::INFINITY };
        keys.sort_by(|a, b| strength(b).total_cmp(&strength(a)).then(a.frame.cmp(&b.frame)));
        keys.truncate(self.most_keys(seconds).saturating_add(staying));
        keys.sort_by_key(|key| key.frame);
        before - keys.len()
    }

    /// How many found keys a sheet of that length may have; pins and rests are not counted.
    fn most_keys(&self, seconds: f64) -> usize {
        (self.per_second * seconds).floor() as usize
    }
}

fn is_found(key: &Key) -> bool {
    key.origin == Origin::Found
}

/// Candidates, the ends of rests and pins in order. A pin pushes out what lies nearer than a koma, a
/// forbidden frame too; the end of a rest pushes out candidates.
fn corrected(
    candidates: &Candidates,
    rests: &[Frame],
    edits: &Edits,
    reference: &Reference<'_>,
) -> Vec<Key> {
    let apart = reference.clock().frames_in_koma();
    let near = |a: Frame, b: Frame| (a.0.abs_diff(b.0) as f64) < apart;
    let clip = reference.clip();
    let unwanted = |frame: Frame| {
        edits.pins.iter().any(|pin| near(pin.frame, frame))
            || edits.forbidden.iter().any(|forbidden| near(*forbidden, frame))
    };
    let key = |frame, strength, origin| Key {
        frame,
        strength,
        price: f64::INFINITY,
        voters: Vec::new(),
        weight: None,
        name: None,
        origin,
    };
    let inside = |frame: &Frame| *frame > clip.first() && *frame < clip.last();
    let rests = rests.iter().copied().filter(inside);
    let mut keys: Vec<Key> = rests
        .filter(|frame| !unwanted(*frame))
        .map(|frame| key(frame, 1.0, Origin::Rest))
        .collect();
    let at_rest = |frame: Frame| keys.iter().any(|rest| near(rest.frame, frame));
    let found: Vec<Key> = candidates
        .keys
        .iter()
        .filter(|candidate| !unwanted(candidate.frame) && !at_rest(candidate.frame))
        .map(|candidate| key(candidate.frame, candidate.strength, Origin::Found))
        .collect();
    keys.extend(found);
    keys.extend(edits.pins.iter().map(|pin| Key {
        weight: pin.weight,
        name: pin.name.clone(),
        ..key(pin.frame, 1.0, Origin::Pinned)
    }));
    keys.sort_by_key(|key| key.frame);
    keys.dedup_by_key(|key| key.frame);
    keys
}

/// The joints that have a key turn of their own within `reach` frames, the heaviest first.
fn voters(turns: &[Vec<Turn>], weights: &[f64], frame: Frame, reach: f64) -> Vec<JointId> {
    let near =
        |turn: &Turn| turn.kind == TurnKind::Key && (turn.frame.0.abs_diff(frame.0) as f64) < reach;
    let from = Frame(frame.0.saturating_sub(reach.ceil() as usize));
    let speaks = |turns: &Vec<Turn>| {
        let begin = turns.partition_point(|turn| turn.frame < from);
        turns[begin..]
            .iter()
            .take_while(|turn| turn.frame.0 <= frame.0.saturating_add(reach as usize))
            .any(near)
    };
    let joints = turns.iter().enumerate().filter(|(_, turns)| speaks(turns));
    let mut voters: Vec<JointId> = joints.map(|(joint, _)| JointId(joint)).collect();
    voters.sort_by(|a, b| weights[b.0].total_cmp(&weights[a.0]));
    voters
}

/// The weight of each joint: how far its rotation carries, the largest set to 1, so that fingers
/// cannot outvote an arm.
pub fn weights(clip: &Clip) -> Vec<f64> {
    let mut weights = clip.skeleton().reaches();
    let largest = weights.iter().copied().fold(0.0, f64::max);
    if largest > 0.0 {
        weights.iter_mut().for_each(|weight| *weight /= largest);
    } else {
        weights.fill(1.0);
    }
    weights
}
