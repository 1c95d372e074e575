//! Stations: drawings with a koma of their own, namely the keys and both ends of the sheet.

use std::cmp::Reverse;
use std::sync::Arc;

use super::steps::Steps;
use super::timed::Timed;
use crate::keys::{Key, Origin};
use crate::motion::JointId;
use crate::sheet::{Drawing, Role, Source, Why};
use crate::time::Clock;

/// A drawing with a koma of its own: a key or an end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Station<'a> {
    pub(super) koma: usize,
    pub(super) place: f64,
    pub(super) role: Role,
    /// The key it shows; for an end, the key it took over.
    pub(super) key: Option<&'a Key>,
    /// Whether timed koma and koma of the source meet there.
    pub(super) is_border: bool,
}

/// Returns keys and ends by koma; of those too close to each other, the stronger.
///
/// `least` gives the fewest koma that the drawing of a koma has to stay. Drawings that a person set stay, however
/// close. The phases of `steps` have koma of their own. Koma that are not timed have no stations but those that a person
/// set.
pub(super) fn stations<'a>(
    keys: &'a [Key],
    steps: &Steps,
    timed: Timed<'_>,
    least: impl Fn(usize) -> usize,
) -> Vec<Station<'a>> {
    let (clock, Some(last)) = (timed.clock, timed.length.checked_sub(1)) else { return Vec::new() };
    let mut own = on_koma(keys, steps, (clock, last), &least);
    let set: Vec<usize> = own.iter().filter(|key| key.is_set()).map(|key| key.koma).collect();
    let stay = if last == 0 { 1 } else { least(last - 1) };
    let mut taken = ends(clock, last, stay, &set);
    taken.retain(|end| end.koma == 0 || timed.has(end.koma) && timed.has(last));
    taken.splice(0..0, timed.borders());
    taken.sort_by_key(|station| station.koma);
    taken.dedup_by_key(|station| station.koma);
    own.retain(|key| timed.has(key.koma) || key.is_set());
    // The strongest first; on a tie the earlier, as the sort is stable.
    own.sort_by(|a, b| b.strength().total_cmp(&a.strength()));
    own.sort_by_key(|station| Reverse(station.rank()));
    for station in own {
        let after = taken.partition_point(|other| other.koma <= station.koma);
        let (before, next) = (after - 1, after);
        let is_near = |other: &Station<'_>| {
            let [a, b] = [station.koma.min(other.koma), station.koma.max(other.koma)];
            let are_steps = station.is_step() && other.is_step();
            let least = || steps.least(a).unwrap_or_else(|| least(a));
            a == b || !are_steps && b - a < least()
        };
        let is_last_end =
            |at: usize| at > 0 && at + 1 == taken.len() && taken[at].role == Role::End;
        let near_before = is_near(&taken[before]);
        let near_next = taken.get(next).is_some_and(is_near);
        if is_last_end(before) || taken[before].koma == station.koma {
            taken[before].take_over(&station);
        } else if station.is_set() || !(near_before || near_next) {
            taken.insert(next, station);
        } else if near_next {
            taken[next].take_over(&station);
        } else {
            taken[before].take_over(&station);
        }
    }
    taken
}

/// Assigns keys to koma: the earlier of the two nearest to a key's frame, or the nearest if drawings stay for one koma.
///
/// A drawing that stays for two koma is on time on average if its frame lies between them. If a person already set a
/// drawing on that koma, further ones that they set go on the next.
fn on_koma<'a>(
    keys: &'a [Key],
    steps: &Steps,
    (clock, last): (Clock, usize),
    least: &impl Fn(usize) -> usize,
) -> Vec<Station<'a>> {
    let mut stations: Vec<Station<'a>> = Vec::with_capacity(keys.len());
    let mut set = None;
    for key in keys {
        let place = key.frame.0 as f64;
        let nearest = clock.koma_from_place(place).min(last);
        let earlier = koma_before(clock, place).min(last);
        let begins_earlier = earlier < nearest && least(earlier) > 1;
        let is_free = !key.origin.is_set() || set != Some(earlier);
        let is_phase = key.origin == Origin::Step || key.origin.is_set();
        let own = steps.koma(key.frame).filter(|_| is_phase);
        let koma = if begins_earlier && is_free { earlier } else { nearest };
        let koma = own.unwrap_or(koma).min(last);
        if key.origin.is_set() {
            set = Some(koma);
        }
        stations.push(Station { koma, place, role: Role::Genga, key: Some(key), is_border: false });
    }
    stations
}

/// Returns the last koma at or before a place.
pub(super) fn koma_before(clock: Clock, place: f64) -> usize {
    let nearest = clock.koma_from_place(place);
    let is_behind = nearest > 0 && place < clock.place_from_koma(nearest) - HAIR;
    nearest - usize::from(is_behind)
}

/// Places closer than this, in frames, are equal.
const HAIR: f64 = 1e-6;

/// Returns the drawings of both ends, or one for a sheet too short for two. The last stays for `stay` koma like any
/// other, or for one if a person wants two drawings there; `set` are the koma of the drawings that they set.
fn ends<'a>(clock: Clock, last: usize, stay: usize, set: &[usize]) -> Vec<Station<'a>> {
    let end = |koma, shown: usize| Station {
        koma,
        place: clock.place_from_koma(shown),
        role: Role::End,
        key: None,
        is_border: false,
    };
    let begin = (last + 1).saturating_sub(stay);
    let wanted = set.iter().filter(|koma| **koma >= begin.max(1)).count();
    let is_one = begin < stay;
    match if wanted > usize::from(!is_one) { last } else { begin } {
        begin if begin == 0 || (is_one && wanted == 0) => vec![end(0, 0)],
        begin => vec![end(0, 0), end(begin, last)],
    }
}

impl Station<'_> {
    /// Whether a person placed it.
    pub(super) fn is_set(&self) -> bool {
        self.key.is_some_and(|key| key.origin.is_set())
    }

    /// Whether it is drawn whatever the body does: a person placed it, a contact happens there, it is a phase of a gait,
    /// or it joins the source.
    pub(super) fn is_fixed(&self) -> bool {
        let is_event = matches!(self.origin(), Some(Origin::Contact | Origin::Step));
        self.is_border || self.is_set() || is_event
    }

    /// Whether it is a phase of a step in a gait.
    fn is_step(&self) -> bool {
        self.origin() == Some(Origin::Step)
    }

    /// Whether it is an end of the sheet that no person placed.
    pub(super) fn is_free_end(&self) -> bool {
        self.role == Role::End && !self.is_set() && !self.is_border
    }

    /// Whether a rest begins or ends there, within the sheet.
    pub(super) fn is_rest(&self) -> bool {
        self.role == Role::Genga && self.origin() == Some(Origin::Rest)
    }

    fn origin(&self) -> Option<Origin> {
        self.key.map(|key| key.origin)
    }

    /// Returns its priority, which precedes strength.
    fn rank(&self) -> usize {
        match self.origin() {
            Some(Origin::Pinned | Origin::Moved { .. }) => 4,
            Some(Origin::Step) => 3,
            Some(Origin::Rest) => 2,
            Some(Origin::Contact) => 1,
            Some(Origin::Turn | Origin::Fill) | None => 0,
        }
    }

    /// Returns what the key saves; its strength, if keys are not priced.
    fn strength(&self) -> f64 {
        let of = |key: &Key| if key.price.is_finite() { key.price } else { key.strength };
        self.key.map_or(0.0, of)
    }

    /// Returns the drawing; `names` are the names of all joints.
    pub(super) fn drawing(&self, names: &[Arc<str>]) -> Drawing {
        let mut why = Why::default();
        if let Some(key) = self.key {
            let name = |joint: &JointId| Arc::clone(&names[joint.0]);
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
        Drawing::new(Source::At(self.place), self.role, why)
    }
}

impl<'a> Station<'a> {
    /// Lets an end take over the reasons of the strongest key that gives way to it. It keeps its own pose, unless a
    /// person placed the key.
    fn take_over(&mut self, given: &Station<'a>) {
        if self.role != Role::End || self.key.is_some() {
            return;
        }
        self.key = given.key;
        if given.is_set() {
            self.place = given.place;
        }
    }
}
