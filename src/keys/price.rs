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

use crate::keys::Reference;
use crate::keys::bridge::Bridge;
use crate::motion::Clip;
use crate::time::Frame;

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
    let frames: Vec<Frame> = entries.iter().map(|entry| entry.frame).collect();
    let mut list = RankedList::new(Bridge::new(clip, reference, &frames), entries);
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
    fn new(bridge: Bridge<'a>, entries: &'a [Entry]) -> Self {
        let count = entries.len();
        let mut list = Self {
            entries,
            bridge,
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
            let (before, after) = (self.before[entry], self.after[entry]);
            self.price[entry] = self.bridge.error(before, entry, after, self.price[entry]);
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
