//! Lulls (緩み): moments at which the whole body is slower than before and after.

use std::ops::{Range, RangeInclusive};

use crate::keys::Chords;
use crate::keys::stillness::smoothed;
use crate::maths;

/// Seconds over which the speed is averaged, so that a step or a tremble does not count as a lull.
const SMOOTH: f64 = 0.25;

/// Speed that is added to each, in % of body height a second: the tremble of somebody who stands still. It keeps the
/// depth of a perfect stand finite.
const TREMBLE: f64 = 2.0;

/// A moment of little movement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lull {
    pub(super) instant: usize,
    /// ln of the factor by which the body gets faster, both before and after it, until it is slower still.
    pub(super) depth: f64,
    /// Whether it is the middle of a rest.
    pub(super) is_rest: bool,
}

/// Finds every lull, by time, including the rests.
pub(super) fn lulls(chords: &Chords, rests: &[RangeInclusive<usize>]) -> Vec<Lull> {
    let per_second = chords.clock().koma_rate;
    let over = (SMOOTH * per_second).round() as usize;
    let speeds = smoothed(&chords.postures().speeds(per_second), over);
    let logs: Vec<f64> = speeds.iter().map(|speed| maths::ln(speed + TREMBLE)).collect();
    let mut lulls: Vec<Lull> = valleys(&logs)
        .into_iter()
        .filter(|(instant, _)| !rests.iter().any(|rest| rest.contains(instant)))
        .map(|(instant, depth)| Lull { instant, depth, is_rest: false })
        .collect();
    lulls.extend(rests.iter().filter_map(|rest| {
        // A rest has one step fewer than instants.
        let (begin, end) = (*rest.start(), *rest.end());
        let depth = depth_of(&logs, begin..end)?;
        Some(Lull { instant: usize::midpoint(begin, end), depth, is_rest: true })
    }));
    lulls.sort_by_key(|lull| lull.instant);
    lulls
}

/// Returns how deep a stretch lies below the lower of the highest values before and after it; `None` at the ends.
fn depth_of(values: &[f64], stretch: Range<usize>) -> Option<f64> {
    let highest = |values: &[f64]| values.iter().copied().reduce(f64::max);
    let (before, after) = (highest(&values[..stretch.start])?, highest(&values[stretch.end..])?);
    let floor = values[stretch].iter().copied().fold(f64::INFINITY, f64::min);
    Some(before.min(after) - floor)
}

/// Finds the middle and the depth of each valley: the climb on the easier side to lower ground. The lowest valley is as
/// deep as the lower of the heights beside it. Values that rise or fall to an end are no valley.
fn valleys(values: &[f64]) -> Vec<(usize, f64)> {
    let before = climbs(values.iter().copied());
    let mut after = climbs(values.iter().rev().copied());
    after.reverse();
    let mut valleys = Vec::new();
    let mut begin = 0;
    for level in values.chunk_by(|a, b| a == b) {
        let end = begin + level.len();
        let depth = before[begin].min(after[end - 1]);
        if depth > 0.0 {
            valleys.push((usize::midpoint(begin, end - 1), depth));
        }
        begin = end;
    }
    valleys
}

/// Returns how far each value lies below the highest since the last lower value; 0 right after a lower value.
fn climbs(values: impl Iterator<Item = f64>) -> Vec<f64> {
    // Rising values, each with the highest value between it and the one below it on the stack.
    let mut stack: Vec<(f64, f64)> = Vec::new();
    let climb = |value: f64| {
        let mut highest = value;
        while let Some((_, between)) = stack.pop_if(|(other, _)| *other >= value) {
            highest = highest.max(between);
        }
        stack.push((value, highest));
        highest - value
    };
    values.map(climb).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Computes a depth directly, value by value.
    fn slowly(values: &[f64], at: usize) -> f64 {
        let climb = |others: &mut dyn Iterator<Item = &f64>| {
            others.take_while(|other| **other >= values[at]).fold(values[at], |a, b| a.max(*b))
        };
        let before = climb(&mut values[..at].iter().rev());
        let after = climb(&mut values[at..].iter());
        before.min(after) - values[at]
    }

    proptest! {
        #[test]
        fn valleys_are_as_deep_as_their_words_say(
            values in prop::collection::vec((0..6i32).prop_map(f64::from), 0..40),
        ) {
            let found = valleys(&values);
            for (at, depth) in &found {
                prop_assert_eq!(*depth, slowly(&values, *at));
            }
            let any = |at: &usize| slowly(&values, *at) > 0.0;
            let mut slow: Vec<usize> = (0..values.len()).filter(any).collect();
            slow.dedup_by(|b, a| *b == *a + 1 && values[*a] == values[*b] && { *a = *b; true });
            prop_assert_eq!(found.len(), slow.len());
        }
    }

    #[test]
    fn a_fall_and_a_rise_have_no_valley_and_one_between_hills_has_the_lower_as_its_depth() {
        assert_eq!(valleys(&[3.0, 2.0, 1.0]), []);
        assert_eq!(valleys(&[1.0, 2.0, 2.0]), []);
        assert_eq!(valleys(&[]), []);
        assert_eq!(valleys(&[5.0, 1.0, 1.0, 1.0, 4.0]), [(2, 3.0)]);
        assert_eq!(valleys(&[5.0, 2.0, 3.0, 1.0, 4.0]), [(1, 1.0), (3, 3.0)]);
    }
}
