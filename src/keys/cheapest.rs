//! The cheapest set (最も安い組): of all sets of keys, the one that loses least, each key at a price.
//!
//! Keys are not removed one at a time: tiny differences would decide which of two neighbours goes first, and with it
//! everything after. The whole set is found at once, by dynamic programming over the chords between instants, so that a
//! little noise or another rig of the same body changes little.

mod price;

use std::collections::BTreeMap;
use std::iter::successors;
use std::ops::Range;

use crate::keys::chords::Chords;
use crate::motion::lanes::wide;
use crate::time::Frame;

use price::LOWEST;

/// Longest gap between entries, in koma, that a row is updated across in one piece. Updating unused slots is cheaper
/// than starting a new piece.
const GAP: usize = 16;

/// A frame that may become a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Entry {
    /// The source frame.
    pub(super) frame: Frame,
    /// The koma nearest to it.
    pub(super) koma: usize,
    /// Whether it is always in the set: pins, ends of rests and contacts, and the clip's ends.
    pub(super) stays: bool,
    /// Its cost, as a share of the price.
    pub(super) cost: f64,
    /// The last koma up to which its pose holds.
    pub(super) holds: usize,
}

/// Chooses among entries. The first and the last are the clip's ends and stay.
#[derive(Debug, Clone)]
pub(super) struct Cheapest<'a> {
    chords: &'a Chords,
    /// Sorted by frame.
    entries: &'a [Entry],
    /// Least whole frames from one key to the next, unless both stay.
    apart: usize,
    /// Row 0 has the first entry of each koma, row 1 the second, and so on.
    rows: Vec<Row>,
    /// Slot of each entry's cost.
    slots: Vec<usize>,
    /// Number of slots.
    costs: usize,
}

/// Entries of different koma. Entries at most `GAP` koma apart have slots with the same spacing as their koma, so that
/// costs and losses line up.
#[derive(Debug, Clone)]
struct Row {
    /// Sorted by frame.
    entries: Vec<usize>,
    /// For each entry, the place of the first one behind it that is not in the same piece.
    ends: Vec<usize>,
}

/// The cheapest ways to the entries found so far. Predecessors are not stored but looked up on the way back, because
/// few entries lie on it.
#[derive(Debug)]
struct Ways {
    /// Cost of the way to each entry without the entry itself, by slot; infinite if no way is known.
    costs: Vec<f64>,
    /// For each row, the place behind the current entry (`next`), and behind the next entry that stays (`stops`).
    next: Vec<usize>,
    stops: Vec<usize>,
    /// Entries that no known chord leads to, each with its predecessor.
    far: BTreeMap<usize, usize>,
}

impl Ways {
    /// Extends a way that costs `cost` by one chord to each of some slots, with these losses, and keeps the cheaper
    /// way.
    #[inline(always)]
    fn pass_on(&mut self, cost: f64, others: Range<usize>, losses: &[f32]) {
        for (least, loss) in self.costs[others].iter_mut().zip(losses) {
            // A plain minimum is stored whole. The next entry would have to wait for a masked store.
            *least = least.min(cost + f64::from(*loss));
        }
    }
}

impl Row {
    /// Builds a row of entries whose slots begin at `slot`, and writes their slots.
    fn new(own: Vec<usize>, slot: usize, entries: &[Entry], slots: &mut [usize]) -> Self {
        let mut ends: Vec<usize> = (1..=own.len()).collect();
        slots[own[0]] = slot;
        for pair in own.windows(2) {
            let ahead = entries[pair[1]].koma - entries[pair[0]].koma;
            slots[pair[1]] = slots[pair[0]] + if ahead <= GAP { ahead } else { 1 };
        }
        for at in (1..own.len()).rev() {
            if entries[own[at]].koma - entries[own[at - 1]].koma <= GAP {
                ends[at - 1] = ends[at];
            }
        }
        Self { entries: own, ends }
    }

    /// Returns the first place from `from` on whose entry comes after `entry`.
    fn behind(&self, entry: usize, mut from: usize) -> usize {
        while self.entries.get(from).is_some_and(|own| *own <= entry) {
            from += 1;
        }
        from
    }
}

/// A set of entries, by index.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Set {
    pub(super) kept: Vec<usize>,
    /// Number of entries worth their price that the limit kept out.
    pub(super) over_limit: usize,
}

impl<'a> Cheapest<'a> {
    /// Chooses among entries sorted by frame, at least `apart` frames from each other.
    pub(super) fn among(entries: &'a [Entry], chords: &'a Chords, apart: f64) -> Self {
        let mut ranks: Vec<Vec<usize>> = Vec::new();
        let mut rank = 0;
        for (at, entry) in entries.iter().enumerate() {
            let is_second = at > 0 && entries[at - 1].koma == entry.koma;
            rank = if is_second { rank + 1 } else { 0 };
            if rank == ranks.len() {
                ranks.push(Vec::new());
            }
            ranks[rank].push(at);
        }
        let (mut slots, mut slot) = (vec![0; entries.len()], 0);
        let row = |row: Vec<usize>| {
            let last = row[row.len() - 1];
            let row = Row::new(row, slot, entries, &mut slots);
            slot = slots[last] + 1;
            row
        };
        let rows = ranks.into_iter().map(row).collect();
        Self { chords, entries, apart: apart.ceil() as usize, rows, slots, costs: slot }
    }

    /// Finds the cheapest set with at most `most` found entries, at the least price from `price` on that leaves so few.
    /// Then adds the next best entries that fit and are worth `price`. At a price of 0, takes every entry that fits.
    pub(super) fn set(&self, price: f64, most: usize) -> Set {
        let free = if price > 0.0 { self.at(price) } else { self.all() };
        let wanted = self.found(&free);
        if wanted <= most {
            return Set { kept: free, over_limit: 0 };
        }
        let many = if price > LOWEST { free.clone() } else { self.at(LOWEST) };
        let mut kept = self.limited(price.max(LOWEST), many, most);
        self.thin(&mut kept, most);
        self.fill(&mut kept, price, most);
        if price == 0.0 && self.found(&kept) < most {
            // So many fit only if they stand closer together than the best ones do.
            kept = free;
            self.thin(&mut kept, most);
        }
        let over_limit = if price > 0.0 { wanted - self.found(&kept) } else { 0 };
        Set { kept, over_limit }
    }

    /// Returns the extra loss if each entry of a set is left out; infinite for entries that stay.
    pub(super) fn saves(&self, kept: &[usize]) -> Vec<f64> {
        (0..kept.len()).map(|at| self.saves_at(kept, at)).collect()
    }

    fn saves_at(&self, kept: &[usize], at: usize) -> f64 {
        match (at.checked_sub(1), kept.get(at + 1)) {
            (Some(before), Some(after)) if !self.entries[kept[at]].stays => {
                self.saved(kept[before], kept[at], *after)
            }
            _ => f64::INFINITY,
        }
    }

    fn saved(&self, before: usize, at: usize, after: usize) -> f64 {
        self.loss(before, after) - self.loss(before, at) - self.loss(at, after)
    }

    fn loss(&self, from: usize, to: usize) -> f64 {
        self.chords.loss(self.entries[from].koma, self.entries[to].koma)
    }

    /// Counts the entries of a set that need not stay.
    fn found(&self, kept: &[usize]) -> usize {
        kept.iter().filter(|entry| !self.entries[**entry].stays).count()
    }

    /// Whether both may be neighbours: far enough apart, and the second pose not held by the first unless it is the
    /// clip's end.
    fn are_apart(&self, from: usize, to: usize) -> bool {
        let is_end = to + 1 == self.entries.len();
        let [from, to] = [from, to].map(|entry| &self.entries[entry]);
        let is_new = to.koma > from.holds || is_end;
        (from.stays && to.stays) || (is_new && to.frame.0 - from.frame.0 >= self.apart)
    }

    /// Takes as many entries as fit, from the first on.
    fn all(&self) -> Vec<usize> {
        let mut kept = vec![0];
        let mut staying = 0;
        for at in 1..self.entries.len() {
            if staying < at {
                let stays = |other: &usize| self.entries[*other].stays;
                staying = (at..self.entries.len()).find(stays).unwrap_or(at);
            }
            let before = kept[kept.len() - 1];
            if at == staying || (self.are_apart(before, at) && self.are_apart(at, staying)) {
                kept.push(at);
            }
        }
        kept
    }

    /// Finds the cheapest set at a price.
    fn at(&self, price: f64) -> Vec<usize> {
        let ways = wide(
            #[inline(always)]
            || self.ways(price),
        );
        let last = self.entries.len() - 1;
        let before = |at: &usize| (*at > 0).then(|| self.before(*at, price, &ways));
        let mut kept: Vec<usize> = successors(Some(last), before).collect();
        kept.reverse();
        self.join(&mut kept, price);
        kept
    }

    /// Finds the cheapest way from the first entry to every other at a price.
    #[inline(always)]
    fn ways(&self, price: f64) -> Ways {
        let count = self.entries.len();
        let mut ways = Ways {
            costs: vec![f64::INFINITY; self.costs],
            next: vec![0; self.rows.len()],
            stops: vec![0; self.rows.len()],
            far: BTreeMap::new(),
        };
        ways.costs[self.slots[0]] = 0.0;
        let (mut stayed, mut stays_next) = (0, 0);
        for (at, entry) in self.entries.iter().enumerate() {
            if ways.costs[self.slots[at]] == f64::INFINITY {
                self.reach_far(at, stayed, price, &mut ways);
            }
            if entry.stays {
                let stays = |other: &usize| self.entries[*other].stays;
                stays_next = (at + 1..count).find(stays).unwrap_or(at);
                stayed = at;
            }
            self.go_on(at, stays_next, price, &mut ways);
        }
        ways
    }

    /// Returns the cost of a way including its last entry.
    #[inline(always)]
    fn cost(&self, at: usize, price: f64, ways: &Ways) -> f64 {
        let Entry { stays, cost, .. } = self.entries[at];
        ways.costs[self.slots[at]] + if stays { 0.0 } else { price * cost }
    }

    /// Finds the predecessor of an entry on the cheapest way to it; the nearest if several tie.
    fn before(&self, at: usize, price: f64, ways: &Ways) -> usize {
        if let Some(from) = ways.far.get(&at) {
            return *from;
        }
        let is_before = |from: &usize| {
            let way = self.cost(*from, price, ways) + self.loss(*from, at);
            way == ways.costs[self.slots[at]] && self.are_apart(*from, at)
        };
        (0..at).rev().find(is_before).expect("the cheapest way came from somewhere")
    }

    /// Removes entries that are in the set only because no known chord is long enough to pass them: in a rest, or where
    /// the body hardly moves.
    fn join(&self, kept: &mut Vec<usize>, price: f64) {
        let mut saves = self.saves(kept);
        while let Some(at) =
            least(&saves).filter(|at| saves[*at] < price * self.entries[kept[*at]].cost)
        {
            self.leave_out(kept, &mut saves, at);
        }
    }

    /// Makes `from` the predecessor of every entry within reach to which that is the cheapest way yet. The next entry
    /// that stays is not passed over.
    #[inline(always)]
    fn go_on(&self, from: usize, stays_next: usize, price: f64, ways: &mut Ways) {
        let (begin, cost) = (self.entries[from].koma, self.cost(from, price, ways));
        let known = self.chords.known(begin);
        for (rank, row) in self.rows.iter().enumerate() {
            let next = row.behind(from, ways.next[rank]);
            let stop = row.behind(stays_next, ways.stops[rank]);
            (ways.next[rank], ways.stops[rank]) = (next, stop);
            let is_apart = |at: &usize| self.are_apart(from, row.entries[*at]);
            let mut at = (next..stop).find(is_apart).unwrap_or(stop);
            while at < stop {
                let end = row.ends[at].min(stop);
                let [to, last] = [at, end - 1].map(|at| row.entries[at]);
                let Some(losses) = known.get(self.entries[to].koma - begin..) else { break };
                ways.pass_on(cost, self.slots[to]..self.slots[last] + 1, losses);
                at = end;
            }
        }
    }

    /// Finds a way to an entry without a possible predecessor within reach. The way starts at the last possible entry
    /// before it or, if the entry stays, at the last entry that stays.
    fn reach_far(&self, to: usize, stayed: usize, price: f64, ways: &mut Ways) {
        let is_way = |from: &usize| {
            ways.costs[self.slots[*from]] < f64::INFINITY && self.are_apart(*from, to)
        };
        let stays = self.entries[to].stays.then_some(stayed);
        if let Some(from) = (stayed..to).rev().find(is_way).or(stays) {
            ways.costs[self.slots[to]] = self.cost(from, price, ways) + self.loss(from, to);
            ways.far.insert(to, from);
        }
    }

    /// Removes the entries that save least until few enough are left. Needed if no chord is long enough for so few.
    fn thin(&self, kept: &mut Vec<usize>, most: usize) {
        let mut saves = self.saves(kept);
        for _ in most..self.found(kept) {
            let Some(at) = least(&saves) else { return };
            self.leave_out(kept, &mut saves, at);
        }
    }

    /// Removes an entry that need not stay, and updates what its neighbours save.
    fn leave_out(&self, kept: &mut Vec<usize>, saves: &mut Vec<f64>, at: usize) {
        kept.remove(at);
        saves.remove(at);
        saves[at - 1] = self.saves_at(kept, at - 1);
        saves[at] = self.saves_at(kept, at);
    }

    /// Adds back the best of the entries left out, while there is room and they save what they cost.
    fn fill(&self, kept: &mut Vec<usize>, price: f64, most: usize) {
        while self.found(kept) < most {
            let gaps = kept.windows(2).enumerate();
            let best = gaps
                .filter_map(|(gap, ends)| Some((gap, self.best_between(ends[0], ends[1], price)?)));
            let Some((gap, (entry, _))) =
                best.reduce(|best, other| if other.1.1 > best.1.1 { other } else { best })
            else {
                break;
            };
            kept.insert(gap + 1, entry);
        }
    }

    /// Finds the entry between two neighbours that saves most beyond its cost, and that gain.
    fn best_between(&self, from: usize, to: usize, price: f64) -> Option<(usize, f64)> {
        let whole = self.loss(from, to);
        let fits = |at: &usize| self.are_apart(from, *at) && self.are_apart(*at, to);
        let gain = |at: usize| {
            (at, whole - self.loss(from, at) - self.loss(at, to) - price * self.entries[at].cost)
        };
        let is_worth_it = |(_, gain): &(usize, f64)| *gain > 0.0 || price == 0.0;
        let gains = (from + 1..to).filter(fits).map(gain).filter(is_worth_it);
        gains.reduce(|best, other| if other.1 > best.1 { other } else { best })
    }
}

/// Returns the place that saves least, the first if several tie; `None` if all stay.
fn least(saves: &[f64]) -> Option<usize> {
    let at = (0..saves.len()).min_by(|a, b| saves[*a].total_cmp(&saves[*b]))?;
    saves[at].is_finite().then_some(at)
}

#[cfg(test)]
mod tests;
