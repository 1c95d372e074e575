//! Spacing (詰め): inbetweens between keys, even in time, crowded towards the keys in what they show
//! [KT11 §3.4].

mod interval;

use serde::{Deserialize, Serialize};

use self::interval::Interval;
use crate::error::Error;
use crate::keys::{Key, LayerKeys, Origin};
use crate::motion::Skeleton;
use crate::sheet::{Drawing, Exposure, Layer, Role, Source, Why};
use crate::time::{Clock, Frame};
use crate::timing::on::{On, Pace};

/// What an inbetween shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum InbetweenSource {
    /// The source at the inbetween's place: the performer's own arc.
    #[default]
    Sample,
    /// A slerp of the two key poses alone, as an inbetweener would draw it.
    Blend,
}

/// Drawings between two keys beyond which nobody spaces.
const MOST: usize = 1000;

/// Puts inbetweens (中割り) between keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spacing {
    /// A drawing every so many koma, 1 or more. Default 2, on twos (2コマ打ち). Raised, fast arcs turn
    /// into straight jumps. A range, `1-3`, chooses for each interval by `step`.
    pub on: On,
    /// Where `on` is a range: how far the body may go from one drawing to the next, in % of its height
    /// (root mean square over its bones, in the mean over the interval); above 0, default 9, which gives
    /// about as many drawings as twos do. Raised, more of the motion is on threes.
    pub step: f64,
    /// A fixed number of inbetweens between two keys instead; default none. An interval too short for
    /// them takes as many as fit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inbetweens: Option<usize>,
    /// How far inbetweens are drawn towards their key, 0 ≤ w < 1, default 0.3; 0 is even spacing
    /// (均等割り). A key may have a weight of its own. Raised, the middle of a movement becomes a jump.
    pub weight: f64,
    /// How far a place may move from its own koma, in koma; 0 or more, default 2. Raised, the jump over
    /// the middle grows with the distance of the keys.
    pub max_shift: f64,
    /// What an inbetween shows. Default: `sample`.
    pub source: InbetweenSource,
}

impl Default for Spacing {
    fn default() -> Self {
        Self {
            on: On::every(2),
            step: 9.0,
            inbetweens: None,
            weight: 0.3,
            max_shift: 2.0,
            source: InbetweenSource::Sample,
        }
    }
}

/// A layer on the sheet, before anything is left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Spaced {
    /// Drawings and exposures, one exposure a drawing.
    pub layer: Layer,
    /// Inbetweens asked for that did not fit between their keys.
    pub did_not_fit: usize,
}

/// What a hand asks for that pulls an inbetween towards a key or away from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The key on whose side the inbetween stands.
    pub key: Frame,
    /// The spacing weight of that key with which the inbetween is where the hand is; 0 to 0.95.
    pub weight: f64,
}

/// A drawing that stands at a koma of its own: a key or an end.
struct Station<'a> {
    koma: usize,
    place: f64,
    role: Role,
    /// The key it shows, or for an end the key it took over.
    key: Option<&'a Key>,
}

impl Spacing {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        if !self.on.is_spacing() {
            let message = "must be 1 (ones) to 1000 koma, or the fewest and the most, as 1-3";
            return Err(Error::setting("spacing.on", message));
        }
        if !(self.step > 0.0 && self.step.is_finite()) {
            return Err(Error::setting("spacing.step", "must be above 0, in % of body height"));
        }
        if self.inbetweens.is_some_and(|count| count > MOST) {
            return Err(Error::setting("spacing.inbetweens", "must be 1000 at the most, or none"));
        }
        if !(0.0..1.0).contains(&self.weight) {
            return Err(Error::setting("spacing.weight", "must be at least 0 (even) and below 1"));
        }
        if !(self.max_shift >= 0.0 && self.max_shift.is_finite()) {
            return Err(Error::setting("spacing.max_shift", "must be 0 koma or more"));
        }
        Ok(())
    }

    /// Places the keys of a layer and the inbetweens between them on a sheet of `koma` koma.
    ///
    /// The first and the last koma always show an `end`; a key that falls on one gives way to it and
    /// hands over its voters. Of two keys on one koma the dearer stays. The pace is asked for where
    /// `on` is a range.
    pub fn place(
        &self,
        layer: &LayerKeys,
        skeleton: &Skeleton,
        clock: Clock,
        koma: usize,
        pace: &Pace,
    ) -> Spaced {
        let stations = stations(&layer.keys, clock, koma);
        let mut drawings = Vec::with_capacity(koma);
        let mut begins = Vec::with_capacity(koma);
        let mut did_not_fit = 0;
        for (at, station) in stations.iter().enumerate() {
            drawings.push(station.drawing(skeleton));
            begins.push(station.koma);
            let Some(next) = stations.get(at + 1) else { continue };
            let interval = Interval::new(self, station, next, &layer.walls, clock);
            let koma = self.koma_between(station.koma, next.koma, pace);
            let asked = self.inbetweens.unwrap_or(koma.len());
            did_not_fit += asked - koma.len();
            for koma in koma {
                drawings.push(interval.inbetween(koma));
                begins.push(koma);
            }
        }
        let ends = begins.iter().skip(1).copied().chain(std::iter::once(koma));
        let exposures = begins
            .iter()
            .zip(ends)
            .enumerate()
            .map(|(drawing, (begin, end))| Exposure { drawing, koma: end - begin })
            .collect();
        Spaced {
            layer: Layer { name: "A".into(), joints: vec![], drawings, exposures },
            did_not_fit,
        }
    }

    /// The weight of a key that takes the inbetween of a koma to a place, or as near as `max_shift` lets it.
    ///
    /// `koma` counts on the sheet before anything was left out, which has `length` koma. None where no inbetween can
    /// stand, in the very middle of its interval, and on the side of an end of the clip that is no key.
    pub fn pulled(
        &self,
        layer: &LayerKeys,
        clock: Clock,
        length: usize,
        koma: usize,
        place: f64,
    ) -> Option<Pull> {
        let stations = stations(&layer.keys, clock, length);
        let after = stations.partition_point(|station| station.koma <= koma);
        let (from, to) = (stations.get(after.checked_sub(1)?)?, stations.get(after)?);
        let interval = Interval::new(self, from, to, &layer.walls, clock);
        let (side, weight) = interval.weight_at(koma, place)?;
        let key = [from, to][side].key?;
        Some(Pull { key: key.frame, weight })
    }

    /// The koma on which inbetweens stand between two koma.
    fn koma_between(&self, from: usize, to: usize, pace: &Pace) -> Vec<usize> {
        let distance = to - from;
        match self.inbetweens {
            None => {
                let on = self.on.within(from, to, pace, self.step);
                (from + on..to).step_by(on).collect()
            }
            Some(asked) => {
                let count = asked.min(distance - 1);
                let koma = |at: usize| (at * distance) as f64 / (count + 1) as f64;
                (1..=count).map(|at| from + koma(at).round() as usize).collect()
            }
        }
    }
}

/// Keys and ends by koma, no two on one.
fn stations(keys: &[Key], clock: Clock, koma: usize) -> Vec<Station<'_>> {
    let end = |koma: usize| Station {
        koma,
        place: clock.place_from_koma(koma),
        role: Role::End,
        key: None,
    };
    let Some(last) = koma.checked_sub(1) else { return Vec::new() };
    let mut stations = vec![end(0)];
    for key in keys {
        let place = key.frame.0 as f64;
        let koma = clock.koma_from_place(place).min(last);
        let station = Station { koma, place, role: Role::Genga, key: Some(key) };
        match stations.last_mut().filter(|before| before.koma == koma) {
            None => stations.push(station),
            Some(before) if before.role == Role::End => before.take_over(key),
            Some(before) if before.key.is_some_and(|other| key.price > other.price) => {
                *before = station
            }
            Some(_) => {}
        }
    }
    match stations.last_mut().filter(|station| station.koma == last) {
        Some(station) if station.role == Role::End => {}
        Some(station) => {
            let key = station.key;
            *station = end(last);
            key.into_iter().for_each(|key| station.take_over(key));
        }
        None => stations.push(end(last)),
    }
    stations
}

impl Station<'_> {
    fn drawing(&self, skeleton: &Skeleton) -> Drawing {
        let mut why = Why::default();
        if let Some(key) = self.key {
            let name = |joint: &crate::motion::JointId| skeleton.joints[joint.0].name.clone();
            why.voters = key.voters.iter().map(name).collect();
            why.strength = Some(key.strength);
            if key.origin.is_set() {
                why.pinned = Some(key.name.clone().unwrap_or_default());
            }
            if let Origin::Moved { from } = key.origin {
                why.moved_from = Some(from.0);
            }
            if self.role == Role::Genga {
                why.reason = Some(key.origin.reason());
            }
            why.price = Some(key.price).filter(|price| price.is_finite());
        }
        Drawing { source: Source::At(self.place), role: self.role, why }
    }
}

impl<'a> Station<'a> {
    /// An end shows what it shows, unless a person wants the key there.
    fn take_over(&mut self, key: &'a Key) {
        if self.key.is_none_or(|other| key.price > other.price) {
            self.key = Some(key);
        }
        if key.origin.is_set() {
            self.place = key.frame.0 as f64;
        }
    }
}

#[cfg(test)]
mod tests;
