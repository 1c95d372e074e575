//! Which genga have figures if there is no room for all: those that a person set, then those that are worth most.

use super::layout::Layout;
use crate::column::KeyedCell;
use crate::difference::Changed;
use crate::view_state::Shown;

/// Worth of what the last change made or moved, of what a person set, and of what has no price: ends of the clip, of
/// rests and of contacts.
const CHANGED: f64 = 1e12;
const SET: f64 = 1e9;
const STAYS: f64 = 1e6;

/// Chooses the genga in view that have figures: indices among the cells of the column, in order. The one under the
/// pointer is among them, unless it plays that at the play head, and those that the last change made or moved.
pub(super) fn choose(
    layout: &Layout,
    shown: &Shown<'_>,
    is_playing: bool,
    (hovered, changed): (Option<usize>, Option<&Changed>),
) -> Vec<usize> {
    let seen = layout.seen(shown);
    let cells = &shown.column().cells;
    let genga = seen.filter(|at| cells[*at].genga.is_some());
    let current = (!is_playing).then(|| shown.column().at(shown.at));
    let worth = |at: usize| match Some(at) {
        own if own == hovered => f64::INFINITY,
        own if own == current => f64::MAX,
        _ if changed.is_some_and(|changed| is_in(changed, cells[at].koma)) => CHANGED,
        _ => worth(&cells[at]),
    };
    let marks: Vec<(usize, f32, f64)> =
        genga.map(|at| (at, layout.x(cells[at].koma), worth(at))).collect();
    fitting(&marks, layout.wide)
}

/// Whether the last change made or moved the genga on a koma.
fn is_in(changed: &Changed, koma: usize) -> bool {
    changed.has_new(koma) || changed.shift_to(koma).is_some()
}

/// How much a genga is worth to be seen.
fn worth(cell: &KeyedCell<'_>) -> f64 {
    match cell.key {
        Some(key) if key.origin.is_set() || key.name.is_some() => SET,
        Some(key) if key.price.is_finite() => key.price,
        _ => STAYS,
    }
}

/// The marks that stand at least `apart` from one another, those of most worth first. Marks are given in order of their
/// positions, as index, position and worth.
fn fitting(marks: &[(usize, f32, f64)], apart: f32) -> Vec<usize> {
    let mut by_worth: Vec<usize> = (0..marks.len()).collect();
    // Of equal worth the earlier one goes first.
    by_worth.sort_by(|a, b| marks[*b].2.total_cmp(&marks[*a].2));
    let mut taken: Vec<usize> = Vec::new();
    for mark in by_worth {
        let x = marks[mark].1;
        let after = taken.partition_point(|other| *other < mark);
        let is_free =
            |at: usize| taken.get(at).is_none_or(|own| (marks[*own].1 - x).abs() >= apart);
        if is_free(after) && after.checked_sub(1).is_none_or(is_free) {
            taken.insert(after, mark);
        }
    }
    taken.into_iter().map(|mark| marks[mark].0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_there_if_they_fit_and_else_those_that_are_worth_most() {
        let marks = [(0, 0.0, 5.0), (3, 20.0, 9.0), (7, 30.0, 12.0), (9, 60.0, 1.0)];
        assert_eq!(fitting(&marks, 10.0), [0, 3, 7, 9]);
        assert_eq!(fitting(&marks, 20.0), [0, 7, 9], "3 is too near to 7, which is worth more");
        assert_eq!(fitting(&marks, 1000.0), [7]);
        assert!(fitting(&[], 10.0).is_empty());
    }

    #[test]
    fn those_that_are_there_never_overlap_and_none_more_would_fit() {
        let marks: Vec<(usize, f32, f64)> =
            (0..500).map(|at| (at, 3.7 * at as f32, f64::from((at as u32 * 7919) % 101))).collect();
        let taken = fitting(&marks, 40.0);
        let x = |at: usize| marks[at].1;
        assert!(taken.windows(2).all(|pair| x(pair[1]) - x(pair[0]) >= 40.0), "{taken:?}");
        for at in 0..marks.len() {
            assert!(taken.iter().any(|own| (x(*own) - x(at)).abs() < 40.0), "{at} would fit");
        }
    }
}
