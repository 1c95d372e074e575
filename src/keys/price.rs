//! What a key saves: how far the body would be off if it were left out and its neighbours slerped.
//!
//! Strength alone is a poor order: strong keys come in pairs round rests, and long fast passages get
//! none. So the cheapest key is taken away, its two neighbours are priced again, and so on: one nested
//! ranked list.
//!
//! "How far off" is the worst koma, not the sum over koma: a pose that is missed once shows more than
//! a small drift that lasts. And it is the root mean square over the body, not the mean: a foot that
//! misses its contact shows, though the rest be right.

use std::array;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

use glam::DVec3;

use crate::keys::Reference;
use crate::motion::Clip;
use crate::motion::lanes::{Arc, LANES, LaneQuat, LaneVec, Lanes};
use crate::motion::rig::Rig;
use crate::motion::sampler::LanePose;
use crate::time::Frame;

/// The local pose of each entry, read once for all bridges that begin or end there.
struct Stances {
    /// Entries × groups of [`LANES`] joints.
    rotations: Vec<LaneQuat>,
    /// Entries × joints that have a position of their own.
    translations: Vec<DVec3>,
    groups: usize,
    /// The joints that have a position of their own.
    moving: Vec<usize>,
}

impl Stances {
    fn of(clip: &Clip, rig: &Rig, entries: &[Entry]) -> Self {
        let moving: Vec<usize> = rig.moving().collect();
        let groups = rig.len().div_ceil(LANES);
        let mut rotations = vec![LaneQuat::default(); entries.len() * groups];
        let mut translations = Vec::with_capacity(entries.len() * moving.len());
        let mut pose = LanePose::rest(clip.skeleton());
        let into = rotations.chunks_mut((LANES * groups).max(1));
        for (entries, rotations) in entries.chunks(LANES).zip(into) {
            let entry = |lane: usize| entries[lane.min(entries.len() - 1)];
            pose.take_rows(rig, &array::from_fn(|lane| clip.row(entry(lane).frame)));
            for (lane, groups) in rotations.chunks_exact_mut(groups).enumerate() {
                for (joint, rotation) in pose.rotations.iter().enumerate() {
                    groups[joint / LANES].set_lane(joint % LANES, rotation.lane(lane));
                }
                translations
                    .extend(moving.iter().map(|joint| pose.translations[*joint].lane(lane)));
            }
        }
        Self { rotations, translations, groups, moving }
    }

    fn rotations(&self, entry: usize) -> &[LaneQuat] {
        &self.rotations[entry * self.groups..(entry + 1) * self.groups]
    }

    fn translations(&self, entry: usize) -> &[DVec3] {
        let moving = self.moving.len();
        &self.translations[entry * moving..(entry + 1) * moving]
    }
}

/// The error of slerping between two entries, with its buffers.
struct Bridge<'a> {
    reference: &'a Reference,
    entries: &'a [Entry],
    rig: Rig,
    stances: Stances,
    /// The way of each joint, [`LANES`] joints together.
    arcs: Vec<Arc>,
    pose: LanePose,
    positions: Vec<LaneVec>,
}

impl<'a> Bridge<'a> {
    fn new(clip: &'a Clip, reference: &'a Reference, entries: &'a [Entry]) -> Self {
        let rig = Rig::of(clip.skeleton());
        let stances = Stances::of(clip, &rig, entries);
        Self {
            reference,
            entries,
            arcs: vec![Arc::default(); stances.groups],
            stances,
            rig,
            pose: LanePose::rest(clip.skeleton()),
            positions: vec![LaneVec::default(); reference.points().len()],
        }
    }

    /// The position error of the worst koma between two entries, root mean square over the body's
    /// points, in % of body height.
    fn error(&mut self, from: usize, to: usize) -> f64 {
        let koma = self.koma(from, to);
        self.error_at(from, to, koma.clone(), koma)
    }

    /// What the error is at least, and whether it is that: looked at round one koma alone. It is
    /// largest where the movement turns, so the koma of the key left out says nearly all.
    fn least_error(&mut self, from: usize, at: usize, to: usize) -> (f64, bool) {
        let koma = self.koma(from, to);
        if koma.is_empty() {
            return (0.0, true);
        }
        let clock = self.reference.clock();
        let nearest = clock.koma_from_place(self.entries[at].frame.0 as f64);
        let block = nearest.clamp(koma.start, koma.end - 1) / LANES * LANES;
        let near = koma.start.max(block)..koma.end.min(block + LANES);
        let is_all = near == koma;
        (self.error_at(from, to, koma, near), is_all)
    }

    fn koma(&self, from: usize, to: usize) -> Range<usize> {
        if self.positions.is_empty() || self.reference.height() <= 0.0 {
            return 0..0;
        }
        self.reference.koma_between(self.entries[from].frame, self.entries[to].frame)
    }

    /// The error at the worst of the `looked` among the koma between two entries.
    fn error_at(
        &mut self,
        from: usize,
        to: usize,
        koma: Range<usize>,
        looked: Range<usize>,
    ) -> f64 {
        if koma.is_empty() {
            return 0.0;
        }
        let ends = self.stances.rotations(from).iter().zip(self.stances.rotations(to));
        for (arc, (from, to)) in self.arcs.iter_mut().zip(ends) {
            *arc = Arc::between(*from, *to);
        }
        let clock = self.reference.clock();
        let [begin, end] = [from, to].map(|entry| self.entries[entry].frame.0 as f64);
        let mut worst = 0.0;
        for block in looked.start / LANES..looked.end.div_ceil(LANES) {
            // Lanes outside the range show the nearest koma inside it: they change no maximum.
            let koma = |lane: usize| (block * LANES + lane).clamp(koma.start, koma.end - 1);
            let place = Lanes::from_fn(|lane| clock.place_from_koma(koma(lane)));
            self.pose_at(from, to, place.map(|place| (place - begin) / (end - begin)));
            let points = self.reference.points();
            points.place(&self.rig, &mut self.pose, &mut self.positions);
            let apart = points.apart(self.reference.positions(block), &self.positions);
            for (lane, apart) in apart.0.into_iter().enumerate() {
                if looked.contains(&(block * LANES + lane)) {
                    worst = f64::max(worst, apart);
                }
            }
        }
        100.0 * worst.sqrt() / self.reference.height()
    }

    /// The local pose some shares of the way along.
    fn pose_at(&mut self, from: usize, to: usize, shares: Lanes) {
        let starts = self.stances.rotations(from);
        for (joint, rotation) in self.pose.rotations.iter_mut().enumerate() {
            let (group, lane) = (joint / LANES, joint % LANES);
            let start = LaneQuat::splat(starts[group].lane(lane));
            let Arc { across, degrees } = &self.arcs[group];
            *rotation = if degrees.0[lane] == 0.0 {
                start
            } else {
                let (sin, cos) = (Lanes::splat(degrees.0[lane]) * shares).half_sin_cos();
                start.scaled(cos) + LaneQuat::splat(across.lane(lane)).scaled(sin)
            };
        }
        // Placing the pose in the world has overwritten what never changes as well.
        for (joint, translation) in self.pose.translations.iter_mut().enumerate() {
            *translation = LaneVec::splat(self.rig.offset(joint));
        }
        let ends = self.stances.translations(from).iter().zip(self.stances.translations(to));
        for (joint, (from, to)) in self.stances.moving.iter().zip(ends) {
            let (from, to) = (LaneVec::splat(*from), LaneVec::splat(*to));
            self.pose.translations[*joint] = from.lerp(to, shares);
        }
    }
}

/// A key that stands in the list to be priced.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub(super) frame: Frame,
    /// Pinned keys and the clip's ends are never taken away.
    pub(super) stays: bool,
}

/// What is worth keeping.
pub(super) struct Worthwhile {
    /// The price in % of body height of each entry that is kept: the error between its neighbours with
    /// it left out, infinite where it stays whatever it costs. None for those that go.
    pub(super) prices: Vec<Option<f64>>,
    /// How many went though they were worth it, because there were too many.
    pub(super) over_limit: usize,
}

/// Which entries are worth keeping.
///
/// `entries` by frame, the first and the last of them the clip's ends. The cheapest goes first, then
/// its neighbours are priced again, until the cheapest costs at least `enough` and no more than `most`
/// are left besides those that stay. What is kept for a smaller `most` or a larger `enough` is
/// therefore part of what is kept for a larger or smaller one.
pub(super) fn worthwhile(
    clip: &Clip,
    reference: &Reference,
    entries: &[Entry],
    enough: f64,
    most: usize,
) -> Worthwhile {
    let mut list = RankedList::new(clip, reference, entries);
    let mut left = entries.iter().filter(|entry| !entry.stays).count();
    let mut over_limit = 0;
    while let Some((price, entry)) = list.cheapest() {
        if price >= enough && left <= most {
            break;
        }
        over_limit += usize::from(price >= enough);
        list.remove(entry);
        left -= 1;
    }
    let mut kept = |entry: usize| {
        if entries[entry].stays { Some(f64::INFINITY) } else { list.exact_price(entry) }
    };
    Worthwhile { prices: (0..entries.len()).map(&mut kept).collect(), over_limit }
}

/// Keys in a doubly linked list with the price of each, cheapest first.
///
/// A key is first listed with the least that it may cost, and priced in full when it comes up as the
/// cheapest: most are never asked again before a neighbour goes.
struct RankedList<'a> {
    entries: &'a [Entry],
    bridge: Bridge<'a>,
    before: Vec<usize>,
    after: Vec<usize>,
    /// What an entry costs now, or costs at least; NaN where it stays or once it is gone.
    price: Vec<f64>,
    /// Whether that is the whole price.
    exact: Vec<bool>,
    queue: BinaryHeap<Reverse<(OrderedPrice, usize)>>,
}

impl<'a> RankedList<'a> {
    fn new(clip: &'a Clip, reference: &'a Reference, entries: &'a [Entry]) -> Self {
        let count = entries.len();
        let mut list = Self {
            entries,
            bridge: Bridge::new(clip, reference, entries),
            before: (0..count).map(|entry| entry.saturating_sub(1)).collect(),
            after: (1..=count).collect(),
            price: vec![f64::NAN; count],
            exact: vec![false; count],
            queue: BinaryHeap::with_capacity(count),
        };
        (0..count).for_each(|entry| list.set_price(entry));
        list
    }

    fn set_price(&mut self, entry: usize) {
        if self.entries[entry].stays {
            return;
        }
        let (before, after) = (self.before[entry], self.after[entry]);
        (self.price[entry], self.exact[entry]) = self.bridge.least_error(before, entry, after);
        self.queue.push(Reverse((OrderedPrice(self.price[entry]), entry)));
    }

    /// The whole price of an entry; none once it is gone.
    fn exact_price(&mut self, entry: usize) -> Option<f64> {
        if !self.exact[entry] && !self.price[entry].is_nan() {
            self.price[entry] = self.bridge.error(self.before[entry], self.after[entry]);
            self.exact[entry] = true;
        }
        Some(self.price[entry]).filter(|price| !price.is_nan())
    }

    fn cheapest(&mut self) -> Option<(f64, usize)> {
        while let Some(Reverse((OrderedPrice(price), entry))) = self.queue.pop() {
            // What is in the queue may be an old price, or an entry that is gone.
            if self.price[entry] != price {
                continue;
            }
            if self.exact[entry] {
                return Some((price, entry));
            }
            let price = self.exact_price(entry).unwrap_or(price);
            self.queue.push(Reverse((OrderedPrice(price), entry)));
        }
        None
    }

    fn remove(&mut self, entry: usize) {
        let (before, after) = (self.before[entry], self.after[entry]);
        self.after[before] = after;
        self.before[after] = before;
        self.price[entry] = f64::NAN;
        self.set_price(before);
        self.set_price(after);
    }
}

/// A price in the order of numbers; prices are never NaN.
#[derive(PartialEq)]
struct OrderedPrice(f64);

impl Eq for OrderedPrice {}

impl Ord for OrderedPrice {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for OrderedPrice {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
pub(super) mod tests;
