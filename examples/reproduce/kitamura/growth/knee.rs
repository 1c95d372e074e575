//! Finds where a curve bends.

/// Index of the value furthest from the straight line between the first and the last; the first one on a tie.
pub(super) fn knee(values: &[f64]) -> usize {
    let last = values.len().saturating_sub(1);
    let rise = (values[last] - values[0]) / last.max(1) as f64;
    let away = |at: usize| (values[at] - values[0] - rise * at as f64).abs();
    (0..=last).rev().max_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(0)
}

/// Last index up to which no value is larger than the first.
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
    fn a_bound_ends_before_the_first_that_breaks_it() {
        assert_eq!(last_within(&[1.0, 1.0, 0.9, 1.2, 1.0]), 2);
        assert_eq!(last_within(&[1.0, 1.0]), 1);
    }
}
