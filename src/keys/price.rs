//! What a key saves: how far the body would be off if it were left out and its neighbours slerped.
//!
//! Strength alone is a poor order: strong keys come in pairs round rests, and long fast passages get
//! none. So the cheapest key is taken away, its two neighbours are priced again, and so on: one nested
//! ranked list.
//!
//! "How far off" is the worst koma, not the sum over koma: a pose that is missed once shows more than
//! a small drift that lasts. And it is the root mean square over the body, not the mean: a foot that
//! misses its contact shows, though the rest be right.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DQuat, DVec3};

use crate::keys::Reference;
use crate::motion::{Body, Clip, Pose};
use crate::time::Frame;

/// The error of slerping between two keys, with its buffers.
struct Bridge<'a> {
    clip: &'a Clip,
    reference: &'a Reference,
    from: Pose,
    to: Pose,
    /// The rotation of a joint from one koma to the next.
    step: Vec<DQuat>,
    pose: Pose,
    body: Body,
    positions: Vec<DVec3>,
}

impl<'a> Bridge<'a> {
    fn new(clip: &'a Clip, reference: &'a Reference) -> Self {
        let skeleton = clip.skeleton();
        let rest = Pose::rest(skeleton);
        Self {
            clip,
            reference,
            from: rest.clone(),
            to: rest.clone(),
            step: vec![DQuat::IDENTITY; skeleton.len()],
            pose: rest,
            body: Body::new(skeleton),
            positions: vec![DVec3::ZERO; reference.points().len()],
        }
    }

    /// The position error of the worst koma between, root mean square over the body's points, in % of
    /// body height.
    fn error(&mut self, from: Frame, to: Frame) -> f64 {
        let (clip, clock) = (self.clip, self.reference.clock());
        let range = self.reference.koma_between(from, to);
        if range.is_empty() || self.positions.is_empty() || self.reference.height() <= 0.0 {
            return 0.0;
        }
        self.from.take_frame(clip, from);
        self.to.take_frame(clip, to);
        let share =
            |koma: usize| (clock.place_from_koma(koma) - from.0 as f64) / (to.0 - from.0) as f64;
        let first = share(range.start);
        self.pose.take_blend(&self.from, &self.to, first);
        // Koma stand evenly, so from one to the next each joint turns by the same rotation: a product
        // instead of a slerp.
        let koma_share = clock.frames_in_koma() / (to.0 - from.0) as f64;
        for (step, (from, to)) in
            self.step.iter_mut().zip(self.from.rotations.iter().zip(&self.to.rotations))
        {
            *step = DQuat::IDENTITY.slerp(from.conjugate() * *to, koma_share);
        }
        let mut worst = 0.0;
        for koma in range.clone() {
            if koma > range.start {
                self.advance(share(koma));
            }
            let points = self.reference.points();
            points.place(&mut self.body, &self.pose, &mut self.positions);
            worst = f64::max(worst, points.apart(self.reference.positions(koma), &self.positions));
        }
        100.0 * worst.sqrt() / self.reference.height()
    }

    fn advance(&mut self, share: f64) {
        for (rotation, step) in self.pose.rotations.iter_mut().zip(&self.step) {
            *rotation *= *step;
        }
        let ends = self.from.translations.iter().zip(&self.to.translations);
        for (translation, (from, to)) in self.pose.translations.iter_mut().zip(ends) {
            *translation = from.lerp(*to, share);
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
    let kept = |entry: usize| {
        let price = list.price[entry];
        if entries[entry].stays { Some(f64::INFINITY) } else { (!price.is_nan()).then_some(price) }
    };
    Worthwhile { prices: (0..entries.len()).map(kept).collect(), over_limit }
}

/// Keys in a doubly linked list with the price of each, cheapest first.
struct RankedList<'a> {
    entries: &'a [Entry],
    bridge: Bridge<'a>,
    before: Vec<usize>,
    after: Vec<usize>,
    /// What an entry costs now; NaN where it stays or once it is gone.
    price: Vec<f64>,
    queue: BinaryHeap<Reverse<(OrderedPrice, usize)>>,
}

impl<'a> RankedList<'a> {
    fn new(clip: &'a Clip, reference: &'a Reference, entries: &'a [Entry]) -> Self {
        let count = entries.len();
        let mut list = Self {
            entries,
            bridge: Bridge::new(clip, reference),
            before: (0..count).map(|entry| entry.saturating_sub(1)).collect(),
            after: (1..=count).collect(),
            price: vec![f64::NAN; count],
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
        let price = self.bridge.error(self.entries[before].frame, self.entries[after].frame);
        self.price[entry] = price;
        self.queue.push(Reverse((OrderedPrice(price), entry)));
    }

    fn cheapest(&mut self) -> Option<(f64, usize)> {
        while let Some(Reverse((OrderedPrice(price), entry))) = self.queue.pop() {
            // What is in the queue may be an old price, or an entry that is gone.
            if self.price[entry] == price {
                return Some((price, entry));
            }
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
