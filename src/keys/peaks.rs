//! Finds local maxima of a curve, and the strongest of them at a distance from each other.

/// Returns the middles of the local maxima of `values`: runs that are entered by a rise (or the start) and left by a
/// fall (or the end). A change of at most `dust` counts as none; a constant curve has no maximum.
pub(super) fn peaks(values: &[f64], dust: f64) -> Vec<usize> {
    let mut peaks = Vec::new();
    let (mut top, mut rising) = (0, true);
    for at in 1..values.len() {
        let change = values[at] - values[at - 1];
        if change > dust {
            (top, rising) = (at, true);
        } else if change < -dust {
            if rising {
                peaks.push((top + at - 1) / 2);
            }
            rising = false;
        }
    }
    // A run that reaches the end counts unless it is the whole curve.
    if rising && top > 0 {
        peaks.push((top + values.len() - 1) / 2);
    }
    peaks
}

/// Returns which of `found` (place, strength) stay if the strongest are taken first and every place nearer than
/// `distance` to one already taken is dropped; of equals the earlier stays. Sorted by place.
pub(super) fn strongest_apart(mut found: Vec<(usize, f64)>, distance: f64) -> Vec<(usize, f64)> {
    let Some(last) = found.iter().map(|(place, _)| *place).max() else { return found };
    found.sort_unstable_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    // A cell is as wide as the distance, so it holds at most one place, and only neighbouring cells are near.
    let width = distance.max(1.0);
    let cell = |place: usize| (place as f64 / width) as usize + 1;
    let mut cells = vec![None; cell(last) + 2];
    found.retain(|&(place, _)| {
        let at = cell(place);
        let near = |other: &Option<usize>| {
            other.is_some_and(|other: usize| (other.abs_diff(place) as f64) < distance)
        };
        let apart = !cells[at - 1..=at + 1].iter().any(near);
        if apart {
            cells[at] = Some(place);
        }
        apart
    });
    found.sort_unstable_by_key(|(place, _)| *place);
    found
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_plateau_gives_its_middle() {
        assert_eq!(peaks(&[0.0, 1.0, 1.0, 1.0, 0.0], 0.0), [2]);
        assert_eq!(peaks(&[0.0, 1.0, 0.5, 2.0, 0.0], 0.0), [1, 3]);
        let dusty = [0.0, 1.0, 1.0, 1.0 + 1e-14, 1.0, 1.0, 0.0];
        assert_eq!(peaks(&dusty, 1e-12), [3], "dust makes no peak");
    }

    #[test]
    fn maxima_may_touch_the_ends_but_a_constant_has_none() {
        assert_eq!(peaks(&[2.0, 1.0, 3.0], 0.0), [0, 2]);
        assert_eq!(peaks(&[2.0, 2.0, 1.0], 0.0), [0]);
        assert!(peaks(&[1.0, 1.0, 1.0], 0.0).is_empty());
        assert!(peaks(&[], 0.0).is_empty() && peaks(&[1.0], 0.0).is_empty());
    }

    #[test]
    fn the_strongest_push_out_their_neighbours() {
        let found = vec![(10, 1.0), (13, 2.0), (16, 1.5), (30, 0.5), (34, 0.5)];
        assert_eq!(strongest_apart(found, 5.0), [(13, 2.0), (30, 0.5)]);
    }

    #[test]
    fn exactly_the_distance_apart_is_far_enough() {
        assert_eq!(strongest_apart(vec![(0, 1.0), (5, 1.0)], 5.0).len(), 2);
    }

    /// The slow way: compares each with all that are taken.
    fn slowly(mut found: Vec<(usize, f64)>, distance: f64) -> Vec<(usize, f64)> {
        found.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let mut taken: Vec<(usize, f64)> = Vec::new();
        for (place, strength) in found {
            if taken.iter().all(|other| other.0.abs_diff(place) as f64 >= distance) {
                taken.push((place, strength));
            }
        }
        taken.sort_by_key(|(place, _)| *place);
        taken
    }

    proptest! {
        #[test]
        fn cells_choose_what_comparing_all_chooses(
            found in prop::collection::btree_map(0usize..200, 0u8..9, 0..60),
            distance in prop_oneof![0.0..0.9, 0.9..8.0, 8.0..500.0, (0u32..9).prop_map(f64::from)],
        ) {
            let found: Vec<_> = found.into_iter().map(|(at, high)| (at, f64::from(high))).collect();
            prop_assert_eq!(strongest_apart(found.clone(), distance), slowly(found, distance));
        }
    }
}
