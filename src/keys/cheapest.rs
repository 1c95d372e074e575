//! The cheapest set (最も安い組): of all sets of keys the one that loses least, each key at a price.
//!
//! Keys are not taken away one by one: which of two neighbours goes first would hang on a hair, and all
//! that follows on it. The set is found as a whole, by dynamic programming over the chords between
//! instants, so that a little noise or another rig of the same body changes little.

mod price;

use std::collections::BTreeMap;
use std::iter::successors;
use std::ops::Range;

use crate::keys::chords::Chords;
use crate::motion::lanes::wide;
use crate::time::Frame;

use price::LOWEST;

/// Koma without an entry that a row is carried over in one piece: to pass something on to nobody is cheaper than to begin
/// anew.
const GAP: usize = 16;

/// What may be a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Entry {
    /// The source frame.
    pub(super) frame: Frame,
    /// The koma that is nearest to it.
    pub(super) koma: usize,
    /// Pins, ends of rests and of contacts, and the clip's ends are always in the set.
    pub(super) stays: bool,
    /// What it costs, as a share of the price.
    pub(super) cost: f64,
    /// The last koma up to which its pose holds.
    pub(super) holds: usize,
}

/// Chooses among entries, the first and the last of which are the clip's ends and stay.
#[derive(Debug, Clone)]
pub(super) struct Cheapest<'a> {
    chords: &'a Chords,
    /// By frame.
    entries: &'a [Entry],
    /// Whole frames from one key to the next at least, unless both stay.
    apart: usize,
    /// The entries that are the first on their koma, those that are the second, and so on.
    rows: Vec<Row>,
    /// Where the cost of each entry stands.
    slots: Vec<usize>,
    /// How many costs there are.
    costs: usize,
}

/// Entries of different koma. The costs of those that follow each other closely stand as far apart as their koma, so
/// that they lie beside their losses.
#[derive(Debug, Clone)]
struct Row {
    /// By frame.
    entries: Vec<usize>,
    /// Of each the first behind it that does not follow closely.
    ends: Vec<usize>,
}

/// The cheapest ways to the entries found so far. What stands before an entry is not kept, but looked up on the way
/// back: few entries are on it.
#[derive(Debug)]
struct Ways {
    /// What the way to an entry costs without the entry itself, by its slot; infinite where none is known.
    costs: Vec<f64>,
    /// Of each row the first behind the entry at hand, and the first behind the next that stays.
    next: Vec<usize>,
    stops: Vec<usize>,
    /// Entries that no known chord leads to, and what stands before each.
    far: BTreeMap<usize, usize>,
}

impl Ways {
    /// Takes the way that costs so much up to its last chord to some others, of which these are the losses, where it is
    /// the cheaper one.
    #[inline(always)]
    fn pass_on(&mut self, cost: f64, others: Range<usize>, losses: &[f32]) {
        for (least, loss) in self.costs[others].iter_mut().zip(losses) {
            // A plain minimum is stored whole: a masked store would be waited for by the next entry.
            *least = least.min(cost + f64::from(*loss));
        }
    }
}

impl Row {
    /// A row of some entries whose costs stand from a slot on; writes where.
    fn of(own: Vec<usize>, slot: usize, entries: &[Entry], slots: &mut [usize]) -> Self {
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

    /// The first of it that is none of those up to an entry, from one on that is known to be.
    fn behind(&self, entry: usize, mut from: usize) -> usize {
        while self.entries.get(from).is_some_and(|own| *own <= entry) {
            from += 1;
        }
        from
    }
}

/// A set of entries by their place in the list.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Set {
    pub(super) kept: Vec<usize>,
    /// How many fewer are in it than are worth their price; 0 where there is none.
    pub(super) over_limit: usize,
}

impl<'a> Cheapest<'a> {
    /// Among entries in the order of their frames, so many frames apart at least.
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
            let row = Row::of(row, slot, entries, &mut slots);
            slot = slots[last] + 1;
            row
        };
        let rows = ranks.into_iter().map(row).collect();
        Self { chords, entries, apart: apart.ceil() as usize, rows, slots, costs: slot }
    }

    /// The cheapest set in which no more than `most` entries are there of their own, at the least price
    /// from `price` on at which there are so few; and then as many of the next best as there is room
    /// for and `price` lets in. At a price of 0 nothing has to be saved, and all are taken that fit.
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
            // So many fit only where they stand closer than the best of them do.
            kept = free;
            self.thin(&mut kept, most);
        }
        let over_limit = if price > 0.0 { wanted - self.found(&kept) } else { 0 };
        Set { kept, over_limit }
    }

    /// What is lost besides if one of a set is left out; infinite for those that stay.
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

    /// How many of a set are there because they are worth it.
    fn found(&self, kept: &[usize]) -> usize {
        kept.iter().filter(|entry| !self.entries[**entry].stays).count()
    }

    /// Whether both are drawn: the second is no pose that the first holds, but for the clip's end.
    fn are_apart(&self, from: usize, to: usize) -> bool {
        let is_end = to + 1 == self.entries.len();
        let [from, to] = [from, to].map(|entry| &self.entries[entry]);
        let is_new = to.koma > from.holds || is_end;
        (from.stays && to.stays) || (is_new && to.frame.0 - from.frame.0 >= self.apart)
    }

    /// As many as fit, from the first on.
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

    /// The cheapest set at a price.
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

    /// The cheapest way to every entry at a price, from the first on.
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

    /// What a way costs with the entry on which it ends.
    #[inline(always)]
    fn cost(&self, at: usize, price: f64, ways: &Ways) -> f64 {
        let Entry { stays, cost, .. } = self.entries[at];
        ways.costs[self.slots[at]] + if stays { 0.0 } else { price * cost }
    }

    /// What stands before an entry on the cheapest way to it, of equals the nearest.
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

    /// Takes out what is there only because no known chord is as long as the way past it: in a rest, or
    /// where the body hardly moves.
    fn join(&self, kept: &mut Vec<usize>, price: f64) {
        let mut saves = self.saves(kept);
        while let Some(at) =
            least(&saves).filter(|at| saves[*at] < price * self.entries[kept[*at]].cost)
        {
            self.leave_out(kept, &mut saves, at);
        }
    }

    /// Takes an entry for the one before each of those within reach where that is the cheapest way to them yet. The next
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

    /// The way to an entry with nothing within reach that may be a key: from the last that may, or, if it stays,
    /// from the last that stays, which is further off.
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

    /// Takes the cheapest away until there are few enough: no chord is long enough for so few.
    fn thin(&self, kept: &mut Vec<usize>, most: usize) {
        let mut saves = self.saves(kept);
        for _ in most..self.found(kept) {
            let Some(at) = least(&saves) else { return };
            self.leave_out(kept, &mut saves, at);
        }
    }

    /// Takes one that does not stay out of a set; what stood before it and after it are neighbours now.
    fn leave_out(&self, kept: &mut Vec<usize>, saves: &mut Vec<f64>, at: usize) {
        kept.remove(at);
        saves.remove(at);
        saves[at - 1] = self.saves_at(kept, at - 1);
        saves[at] = self.saves_at(kept, at);
    }

    /// Puts the best of those left out back while there is room and they save what they cost.
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

    /// The entry between two of a set that saves most beyond what it costs, and how much that is.
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

/// Where least is saved, of equals the first; none in a set of which all stay.
fn least(saves: &[f64]) -> Option<usize> {
    let at = (0..saves.len()).min_by(|a, b| saves[*a].total_cmp(&saves[*b]))?;
    saves[at].is_finite().then_some(at)
}

#[cfg(test)]
mod tests;
