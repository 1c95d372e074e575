//! Local maxima of a curve, and the strongest of them at a distance from each other.

/// The middles of the local maxima of `values`: runs that are entered by a rise (or the start) and
/// left by a fall (or the end). A change of at most `dust` counts as none; a constant curve has no
/// maximum.
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

/// Which of `found` (place, strength) stay when the strongest are taken first and whatever lies
/// nearer than `distance` to one already taken is dropped; among equals the earlier. By place.
pub(super) fn strongest_apart(mut found: Vec<(usize, f64)>, distance: f64) -> Vec<(usize, f64)> {
    found.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut taken: Vec<(usize, f64)> = Vec::with_capacity(found.len());
    for (place, strength) in found {
        let after = taken.partition_point(|other| other.0 < place);
        let near = |other: Option<&(usize, f64)>| {
            other.is_some_and(|other| (other.0.abs_diff(place) as f64) < distance)
        };
        if !near(taken.get(after)) && !near(after.checked_sub(1).map(|before| &taken[before])) {
            taken.insert(after, (place, strength));
        }
    }
    taken
}

#[cfg(test)]
mod tests {
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
}
