//! Corrections are local (その場の修正): keys that no correction pushes out stay what they were.

use crate::edits::Edits;
use crate::keys::choice::Picked;
use crate::keys::{Alike, Choose, Chords, Key, Origin, Rank};
use crate::motion::Clip;
use crate::time::Frame;

/// Keys that were chosen, and how many more would be worth it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chosen {
    /// Keys by frame.
    pub(crate) keys: Vec<Key>,
    /// Keys that went because there were too many a second.
    pub(crate) over_limit: usize,
}

impl Chosen {
    /// The keys that were picked of some.
    pub(crate) fn of(keys: &[Key], picked: &Picked) -> Self {
        let kept = picked.kept.iter().map(|(at, price)| Key { price: *price, ..keys[*at].clone() });
        Self { keys: kept.collect(), over_limit: picked.over_limit }
    }
}

/// What becomes of a key that was chosen before a person had a say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    Stays,
    /// A pin stands so near that it takes its place.
    GivesWay,
    Forbidden,
}

/// What a person says of the keys of a layer, and how near two are one, in frames.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Word<'a> {
    pub(crate) edits: &'a Edits,
    /// A koma.
    pub(crate) koma: f64,
    /// The least distance of two keys that are found.
    pub(crate) apart: f64,
    /// Which poses are one on the sheet.
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
    /// Corrects keys that were chosen. Pins stand beside them or in their place. Where forbidden ones leave a gap between
    /// two that stay, as many others are chosen in it as went, or fewer. All else stays as it is.
    ///
    /// `eligible` is what may be a key once a person has had a say, by frame, pins among it.
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

    /// The keys of a sheet before: what is chosen among, where it is there, else frames that a person set.
    pub(crate) fn frozen(
        &self,
        (clip, chords): (&Clip, &Chords),
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
        self.price(&mut keys, clip, chords);
        Chosen { keys, over_limit: 0 }
    }

    /// Says of each key what it saves beside the others.
    fn price(&self, keys: &mut [Key], clip: &Clip, chords: &Chords) {
        let ends = (clip.first(), clip.last());
        let all = (0.0, usize::MAX);
        let choice = self.choice_among((chords, &Alike::default()), ends, keys, all);
        let prices = choice.prices(chords);
        keys.iter_mut().zip(prices).for_each(|(key, price)| key.price = price);
    }
}
