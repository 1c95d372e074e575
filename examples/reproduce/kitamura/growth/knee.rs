//! Where a curve bends.

/// The place furthest from the straight line between the first and the last value; of several the
/// first.
pub(super) fn knee(values: &[f64]) -> usize {
    let last = values.len().saturating_sub(1);
    let rise = (values[last] - values[0]) / last.max(1) as f64;
    let away = |at: usize| (values[at] - values[0] - rise * at as f64).abs();
    (0..=last).rev().max_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(0)
}

/// The place of the first value that the next does not exceed; none when all rise.
pub(super) fn last_of_rise(values: &[f64]) -> Option<usize> {
    values.windows(2).position(|pair| pair[1] <= pair[0])
}

/// The last place up to which no value is larger than the first.
pub(super) fn last_within(values: &[f64]) -> usize {
    let over = |value: &f64| *value > values[0] * (1.0 + 1e-9);
    values.iter().position(over).unwrap_or(values.len()) - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bend_is_where_it_is_drawn() {
        assert_eq!(knee(&[0.0, 1.0, 2.0, 3.0, 3.1, 3.2, 3.3]), 3);
        assert_eq!(knee(&[0.0, 0.1, 0.2, 1.2, 2.2]), 2, "below the line as well");
        assert_eq!(knee(&[0.0, 1.0, 2.0, 3.0]), 0, "a straight line has none");
    }

    #[test]
    fn a_rise_and_a_bound_end_before_the_first_that_breaks_them() {
        assert_eq!(last_of_rise(&[1.0, 2.0, 3.0, 3.0, 5.0]), Some(2));
        assert_eq!(last_of_rise(&[1.0, 2.0]), None);
        assert_eq!(last_within(&[1.0, 1.0, 0.9, 1.2, 1.0]), 2);
        assert_eq!(last_within(&[1.0, 1.0]), 1);
    }
}
