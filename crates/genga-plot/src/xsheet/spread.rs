//! Moves labels apart that would overlap.

/// Labels along a line.
pub(super) struct Spread {
    /// Middles of the labels, in px.
    pub(super) middles: Vec<f64>,
    /// Size of the labels as a share of the one asked for, at most 1: smaller if they have no room.
    pub(super) scale: f64,
}

impl Spread {
    /// Places labels of the given lengths as near to their `wanted` middles, which never fall, as their neighbours and
    /// the ends of the line allow. All are in px.
    pub(super) fn new(wanted: &[f64], lengths: &[f64], (from, to): (f64, f64)) -> Self {
        let room = to - from;
        let scale = room / lengths.iter().sum::<f64>().max(room);
        let halves: Vec<f64> = lengths.iter().map(|length| 0.5 * scale * length).collect();
        let mut middles = wanted.to_vec();
        let mut free = from;
        for (middle, half) in middles.iter_mut().zip(&halves) {
            *middle = middle.max(free + half);
            free = *middle + half;
        }
        let mut free = to;
        for (middle, half) in middles.iter_mut().zip(&halves).rev() {
            *middle = middle.min(free - half);
            free = *middle - half;
        }
        Self { middles, scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_move_apart_only_where_they_would_overlap() {
        let spread = |wanted: &[f64], room| {
            let Spread { middles, scale } = Spread::new(wanted, &vec![10.0; wanted.len()], room);
            (middles, scale)
        };
        assert_eq!(spread(&[20.0, 50.0], (0.0, 100.0)), (vec![20.0, 50.0], 1.0));
        assert_eq!(spread(&[1.0, 2.0, 50.0], (0.0, 100.0)), (vec![5.0, 15.0, 50.0], 1.0));
        assert_eq!(spread(&[50.0, 98.0, 99.0], (0.0, 100.0)), (vec![50.0, 85.0, 95.0], 1.0));
        assert_eq!(spread(&[3.0, 3.0], (0.0, 10.0)), (vec![2.5, 7.5], 0.5), "half as large");
        assert_eq!(spread(&[], (0.0, 10.0)), (vec![], 1.0));
    }
}
