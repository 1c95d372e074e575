//! Local corrections (その場の修正): keys that no correction pushes out stay as they were.

use crate::edits::Edits;
use crate::keys::selection::Picked;
use crate::keys::{Alike, Choose, Chords, Key, Origin, Rank};
use crate::motion::Clip;
use crate::time::Frame;

/// The chosen keys, and how many more would be worth it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chosen {
    /// Keys by frame.
    pub(crate) keys: Vec<Key>,
    /// Number of keys dropped because there were too many a second.
    pub(crate) over_limit: usize,
}

impl Chosen {
    /// Takes the picked ones of some keys.
    pub(crate) fn new(keys: &[Key], picked: &Picked) -> Self {
        let kept = picked.kept.iter().map(|(at, price)| Key { price: *price, ..keys[*at].clone() });
        Self { keys: kept.collect(), over_limit: picked.over_limit }
    }
}

/// The fate of a chosen key under a person's corrections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    Stays,
    /// A pin is so near that it takes the key's place.
    GivesWay,
    Forbidden,
}

/// A person's corrections of a layer's keys, and the distances they need, in frames.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Word<'a> {
    pub(crate) edits: &'a Edits,
    /// Frames in a koma.
    pub(crate) koma: f64,
    /// Least distance of two found keys.
    pub(crate) apart: f64,
    /// Which poses count as one on the sheet.
    pub(crate) alike: &'a Alike,
}

impl Word<'_> {
    fn fate(&self, key: &Key, rank: Rank) -> Fate {
        let may_go = key.origin.is_found() && rank == Rank::Price;
        let apart = if may_go { self.apart.max(self.koma) } else { self.koma };
        let near = |frame: Frame| (frame.0.abs_diff(key.frame.0) as f64) < apart;
        if self.edits.pins.iter().any(|pin| near(pin.frame)) {
            Fate::GivesWay
        } else if self.edits.forbidden.iter().any(|range| range.reaches(key.frame, self.koma)) {
            Fate::Forbidden
        } else {
            Fate::Stays
        }
    }
}

impl Choose {
    /// Corrects chosen keys. Pins stand beside them or in their place. If forbidden keys leave a gap between two that
    /// stay, at most as many others are chosen in the gap. All else stays as it is.
    ///
    /// `eligible` has the possible keys after a person's corrections, by frame, including pins.
    pub(crate) fn correct(
        &self,
        (clip, chords): (&Clip, &Chords),
        chosen: &Chosen,
        eligible: &[Key],
        word: Word<'_>,
    ) -> Chosen {
        let pins = eligible.iter().filter(|key| key.origin == Origin::Pinned);
        let mut fixed: Vec<Key> = pins.cloned().collect();
        let mut gone: Vec<Frame> = Vec::new();
        for key in &chosen.keys {
            match word.fate(key, self.rank) {
                Fate::Stays => fixed.push(key.clone()),
                Fate::GivesWay => {}
                Fate::Forbidden => gone.push(key.frame),
            }
        }
        fixed.sort_by_key(|key| key.frame);
        let mut keys = fixed.clone();
        let inner = fixed.iter().map(|key| key.frame);
        let bounds: Vec<Frame> =
            [clip.first()].into_iter().chain(inner).chain([clip.last()]).collect();
        for gap in bounds.windows(2) {
            let inside = |frame: Frame| gap[0] < frame && frame < gap[1];
            let most = gone.iter().filter(|frame| inside(**frame)).count();
            if most > 0 {
                let near = |key: &Key| {
                    gap.iter().any(|end| (end.0.abs_diff(key.frame.0) as f64) < word.koma)
                };
                let own = eligible.iter().filter(|key| inside(key.frame) && !near(key));
                let own: Vec<Key> = own.cloned().collect();
                let judged = (chords, word.alike);
                let choice = self.choice_among(judged, (gap[0], gap[1]), &own, (word.apart, most));
                keys.extend(choice.pick(chords).kept.iter().map(|(at, _)| own[*at].clone()));
            }
        }
        keys.sort_by_key(|key| key.frame);
        self.price(&mut keys, clip, chords);
        Chosen { keys, over_limit: chosen.over_limit }
    }

    /// Returns the keys of an earlier sheet: the eligible key at each frame, else one that a person set. The ends of the
    /// rests that a key holds are among them, which a sheet does not draw.
    pub(crate) fn frozen(
        &self,
        (clip, chords): (&Clip, &Chords),
        alike: &Alike,
        frames: &[Frame],
        eligible: &[Key],
    ) -> Chosen {
        let mut frames: Vec<Frame> = frames.to_vec();
        frames.sort_unstable();
        frames.dedup();
        let key = |frame: &Frame| match eligible.binary_search_by_key(frame, |key| key.frame) {
            Ok(at) => eligible[at].clone(),
            Err(_) => Key::set(*frame),
        };
        let mut keys: Vec<Key> = frames.iter().map(key).collect();
        let is_held = |end: &&Key| {
            let after = frames.partition_point(|frame| *frame <= end.frame);
            let before = after.checked_sub(1).map_or(clip.first(), |at| frames[at]);
            let holds = alike.last(chords.koma_of(before));
            end.origin == Origin::Rest && before != end.frame && chords.koma_of(end.frame) <= holds
        };
        keys.extend(eligible.iter().filter(is_held).cloned());
        keys.sort_by_key(|key| key.frame);
        self.price(&mut keys, clip, chords);
        Chosen { keys, over_limit: 0 }
    }

    /// Sets the price of each key: what it saves beside the others.
    fn price(&self, keys: &mut [Key], clip: &Clip, chords: &Chords) {
        let ends = (clip.first(), clip.last());
        let all = (0.0, usize::MAX);
        let choice = self.choice_among((chords, &Alike::default()), ends, keys, all);
        let prices = choice.prices(chords);
        keys.iter_mut().zip(prices).for_each(|(key, price)| key.price = price);
    }
}
