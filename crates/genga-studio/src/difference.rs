//! The difference (違い) that the last change made: which genga went and which came, and the counts before it.

use super::column::Column;
use super::counts::Counts;
use genga::pipeline::Breakdown;

/// A drawing on a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Drawn {
    koma: usize,
    held: usize,
    /// Its place in the source.
    place: f64,
    is_kept: bool,
}

/// The sheet before a change, column by column.
#[derive(Debug, Clone)]
pub(super) struct Before {
    counts: Counts,
    columns: Vec<Vec<Drawn>>,
}

/// A genga that is no longer there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gone {
    pub(super) koma: usize,
    /// Its place in the source.
    pub(super) place: f64,
}

/// What changed in a column.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Changed {
    pub(super) gone: Vec<Gone>,
    /// The koma on which genga begin that were not there, in order.
    pub(super) came: Vec<usize>,
}

/// What a change made of the sheet.
#[derive(Debug, Clone)]
pub(super) struct Difference {
    pub(super) before: Counts,
    pub(super) columns: Vec<Changed>,
    /// Every koma at which the sheet became another: where genga went or came, else where drawings stay otherwise.
    pub(super) places: Vec<usize>,
}

impl Before {
    /// Notes a sheet and its counts.
    pub(super) fn new(breakdown: &Breakdown<'_>, counts: Counts) -> Self {
        Self { counts, columns: Column::all(breakdown).iter().map(drawn).collect() }
    }

    /// Compares the sheet with what it has become.
    pub(super) fn until(&self, breakdown: &Breakdown<'_>) -> Difference {
        let none = Vec::new();
        let (mut columns, mut places) = (Vec::new(), Vec::new());
        let mut timed = Vec::new();
        for (at, column) in Column::all(breakdown).iter().enumerate() {
            let (before, now) = (self.columns.get(at).unwrap_or(&none), drawn(column));
            let changed = changed(before, &now);
            places.extend(changed.gone.iter().map(|gone| gone.koma));
            places.extend(&changed.came);
            let differs = before.iter().zip(&now).find(|(old, new)| old != new);
            timed.extend(differs.map(|(old, new)| old.koma.min(new.koma)));
            columns.push(changed);
        }
        if places.is_empty() {
            places = timed;
        }
        places.sort_unstable();
        Difference { before: self.counts, columns, places }
    }
}

/// The drawings of a column in order.
fn drawn(column: &Column<'_>) -> Vec<Drawn> {
    let drawing = |cell: &super::column::KeyedCell<'_>| Drawn {
        koma: cell.koma,
        held: cell.held,
        place: cell.drawing.source.place(),
        is_kept: cell.genga.is_some(),
    };
    column.cells.iter().map(drawing).collect()
}

/// The genga of which only one of two sheets has the place.
fn changed(before: &[Drawn], now: &[Drawn]) -> Changed {
    let only = |one: &[Drawn], other: &[Drawn]| -> Vec<Drawn> {
        let mut places: Vec<f64> =
            other.iter().filter(|own| own.is_kept).map(|own| own.place).collect();
        places.sort_unstable_by(f64::total_cmp);
        let is_new = |own: &&Drawn| {
            own.is_kept && places.binary_search_by(|place| place.total_cmp(&own.place)).is_err()
        };
        one.iter().filter(is_new).copied().collect()
    };
    let gone = only(before, now).into_iter().map(|own| Gone { koma: own.koma, place: own.place });
    Changed { gone: gone.collect(), came: only(now, before).iter().map(|own| own.koma).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(genga: &[(usize, f64)]) -> Vec<Drawn> {
        let drawn = |(koma, place): &(usize, f64)| Drawn {
            koma: *koma,
            held: 2,
            place: *place,
            is_kept: true,
        };
        genga.iter().map(drawn).collect()
    }

    #[test]
    fn what_went_and_what_came_is_told_by_its_pose_and_not_by_its_koma() {
        let before = sheet(&[(0, 0.0), (4, 4.0), (8, 9.0), (12, 12.0)]);
        let now = sheet(&[(0, 0.0), (5, 4.0), (9, 10.0), (12, 12.0)]);
        let changed = changed(&before, &now);
        assert_eq!(changed.gone, [Gone { koma: 8, place: 9.0 }]);
        assert_eq!(changed.came, [9]);
        assert_eq!(super::changed(&before, &before), Changed::default());
    }

    #[test]
    fn an_inbetween_neither_goes_nor_comes() {
        let mut before = sheet(&[(0, 0.0), (4, 4.0)]);
        let now = sheet(&[(0, 0.0), (4, 4.0)]);
        before[1].is_kept = false;
        assert_eq!(changed(&before, &now), Changed { gone: vec![], came: vec![4] });
    }
}
