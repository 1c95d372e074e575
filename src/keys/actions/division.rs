//! Finds the cheapest way to divide a take.

use crate::maths;

/// Weight of an action's length against the clarity of its begin. Found on real clips: with less, a deep pause inside a
/// movement is worth a split; with more, kicks that follow each other are not.
const OF_LENGTH: f64 = 1.5;

/// A possible division of a take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Seconds from the take's begin.
    pub(super) at: f64,
    /// Cost of a division there; below 0 it pays.
    pub(super) price: f64,
}

/// The wanted lengths of the parts, in seconds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lengths {
    pub(super) usual: f64,
    pub(super) shortest: f64,
}

impl Lengths {
    /// Returns the cost of a part of a length: half the usual length costs as much as twice.
    fn price(self, seconds: f64) -> f64 {
        OF_LENGTH * maths::ln(seconds / self.usual).powi(2)
    }
}

/// Finds which of the places, sorted by time, divide a take so that places and parts together cost least; of equals,
/// those with the earlier begin of the last part. No part is shorter than the shortest, unless nothing is divided.
pub(super) fn cheapest(places: &[Place], seconds: f64, lengths: Lengths) -> Vec<usize> {
    let (begin, end) = (Place { at: 0.0, price: 0.0 }, Place { at: seconds, price: 0.0 });
    let all: Vec<Place> = [begin].into_iter().chain(places.iter().copied()).chain([end]).collect();
    // Least cost of a take that ends at each place, with the begin of its last part; then the least of these costs so
    // far.
    let mut best: Vec<(f64, usize)> = vec![(0.0, 0)];
    let mut cheapest = vec![0.0f64];
    for (at, place) in all.iter().enumerate().skip(1) {
        let mut least = (f64::INFINITY, 0);
        // Least cost of a part that is longer than the last one priced.
        let mut longer = 0.0;
        for (from, other) in all[..at].iter().enumerate().rev() {
            let long = place.at - other.at;
            if long < lengths.shortest || long <= 0.0 {
                continue;
            }
            if best[from].0 + longer + place.price > least.0 {
                continue;
            }
            let price = lengths.price(long);
            if long > lengths.usual {
                longer = price;
                // A longer part costs more, and no take before it costs less.
                if cheapest[from] + price + place.price > least.0 {
                    break;
                }
            }
            let cost = best[from].0 + price + place.price;
            if cost <= least.0 {
                least = (cost, from);
            }
        }
        cheapest.push(cheapest[at - 1].min(least.0));
        best.push(least);
    }
    let mut divisions = Vec::new();
    let mut at = best.last().map_or(0, |(_, from)| *from);
    while at > 0 {
        divisions.push(at - 1);
        at = best[at].1;
    }
    divisions.reverse();
    divisions
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Returns the cost of a division; `None` if a part is too short.
    fn cost(chosen: &[usize], places: &[Place], seconds: f64, lengths: Lengths) -> Option<f64> {
        let mut bounds: Vec<f64> = chosen.iter().map(|at| places[*at].at).collect();
        bounds.insert(0, 0.0);
        bounds.push(seconds);
        let parts = bounds.windows(2).map(|pair| pair[1] - pair[0]);
        let is_short = |long: &f64| *long < lengths.shortest || *long <= 0.0;
        if !chosen.is_empty() && parts.clone().any(|long| is_short(&long)) {
            return None;
        }
        let prices: f64 = chosen.iter().map(|at| places[*at].price).sum();
        Some(prices + parts.map(|long| lengths.price(long)).sum::<f64>())
    }

    proptest! {
        #[test]
        fn no_other_way_to_divide_costs_less(
            places in prop::collection::vec((0.0..12.0, -2.0..2.0), 0..9),
            shortest in 0.0..3.0,
        ) {
            let mut places: Vec<Place> =
                places.into_iter().map(|(at, price)| Place { at, price }).collect();
            places.sort_by(|a, b| a.at.total_cmp(&b.at));
            let lengths = Lengths { usual: 3.0, shortest };
            let found = cheapest(&places, 12.0, lengths);
            let least = cost(&found, &places, 12.0, lengths).unwrap();
            for set in 0..1usize << places.len() {
                let chosen: Vec<usize> = (0..places.len()).filter(|at| set >> at & 1 == 1).collect();
                if let Some(other) = cost(&chosen, &places, 12.0, lengths) {
                    prop_assert!(least <= other + 1e-9, "{chosen:?}: {other} < {least}");
                }
            }
        }
    }
}
