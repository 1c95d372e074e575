//! The difference (違い) that the last change made: which genga went, came or moved, and the counts before it.

use super::column::{Column, KeyedCell};
use super::counts::Counts;
use genga::pipeline::Breakdown;
use genga::time::Frame;

/// A drawing on a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Drawn {
    koma: usize,
    held: usize,
    /// Its place in the source.
    place: f64,
    is_kept: bool,
    /// Whether a person pinned or moved it.
    is_set: bool,
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

/// A genga that stands on another koma than before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shifted {
    pub(super) from: usize,
    pub(super) to: usize,
}

/// A found genga in whose place a new pin stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Replaced {
    pub(super) gone: Gone,
    /// The koma of the pin.
    pub(super) by: usize,
}

/// What changed in a column.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Changed {
    pub(super) gone: Vec<Gone>,
    /// The koma on which genga begin that were not there, in order.
    pub(super) came: Vec<usize>,
    /// The genga with another koma, in order.
    pub(super) shifted: Vec<Shifted>,
    pub(super) replaced: Vec<Replaced>,
}

/// What a change made of the sheet.
#[derive(Debug, Clone)]
pub(super) struct Difference {
    pub(super) before: Counts,
    pub(super) columns: Vec<Changed>,
    /// Every koma at which the sheet became another: where genga went or came, else where drawings stay otherwise.
    pub(super) places: Vec<usize>,
}

impl Changed {
    /// Whether the genga on a koma came.
    pub(super) fn has_new(&self, koma: usize) -> bool {
        self.came.binary_search(&koma).is_ok()
    }

    /// How the genga on a koma moved. `None` if it did not.
    pub(super) fn shift_to(&self, koma: usize) -> Option<Shifted> {
        let at = self.shifted.binary_search_by_key(&koma, |own| own.to).ok()?;
        Some(self.shifted[at])
    }
}

impl Gone {
    /// Its source frame.
    pub(super) fn frame(&self) -> Frame {
        Frame(self.place.round().max(0.0) as usize)
    }
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
    let drawing = |cell: &KeyedCell<'_>| Drawn {
        koma: cell.koma,
        held: cell.held,
        place: cell.drawing.source.place(),
        is_kept: cell.genga.is_some(),
        is_set: cell.key.is_some_and(|key| key.origin.is_set()),
    };
    column.cells.iter().map(drawing).collect()
}

/// Compares two sheets. A genga is known by its place.
fn changed(before: &[Drawn], now: &[Drawn]) -> Changed {
    let (old, new) = (ByPlace::new(before), ByPlace::new(now));
    let only = |one: &[Drawn], other: &ByPlace<'_>| -> Vec<Drawn> {
        let own = one.iter().filter(|own| own.is_kept && other.at(own.place).is_empty());
        own.copied().collect()
    };
    let (gone, came) = (only(before, &new), only(now, &old));
    let told = |own: &Drawn| Gone { koma: own.koma, place: own.place };
    let replaced = gone.iter().filter(|own| !own.is_set).filter_map(|own| {
        let takes_its_place = |pin: &&Drawn| pin.is_set && new.are_neighbours(own, pin);
        let by = came.iter().find(takes_its_place)?;
        Some(Replaced { gone: told(own), by: by.koma })
    });
    Changed {
        replaced: replaced.collect(),
        shifted: old.shifted(&new),
        gone: gone.iter().map(told).collect(),
        came: came.iter().map(|own| own.koma).collect(),
    }
}

/// The genga of a sheet, ordered by their places and then by their koma.
struct ByPlace<'a>(Vec<&'a Drawn>);

impl<'a> ByPlace<'a> {
    fn new(sheet: &'a [Drawn]) -> Self {
        let mut genga: Vec<&Drawn> = sheet.iter().filter(|own| own.is_kept).collect();
        genga.sort_by(|a, b| a.place.total_cmp(&b.place));
        Self(genga)
    }

    /// The genga that show a place. In a loop every round has one.
    fn at(&self, place: f64) -> &[&'a Drawn] {
        let from = self.0.partition_point(|own| own.place < place);
        let past = self.0.partition_point(|own| own.place <= place);
        &self.0[from..past]
    }

    /// The genga that stand on another koma on a later sheet, in order.
    fn shifted(&self, later: &Self) -> Vec<Shifted> {
        let rounds = later.0.chunk_by(|a, b| a.place == b.place);
        let pairs = rounds.flat_map(|now| self.at(now[0].place).iter().zip(now));
        let shifted = pairs.map(|(own, now)| Shifted { from: own.koma, to: now.koma });
        let mut shifted: Vec<Shifted> = shifted.filter(|own| own.from != own.to).collect();
        shifted.sort_by_key(|own| own.to);
        shifted
    }

    /// Whether two drawings could both be seen and have no genga between them.
    fn are_neighbours(&self, a: &Drawn, b: &Drawn) -> bool {
        let (from, to) = (a.place.min(b.place), a.place.max(b.place));
        let after = self.0.partition_point(|own| own.place <= from);
        a.koma != b.koma && self.0.get(after).is_none_or(|next| next.place >= to)
    }
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
            is_set: false,
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
        assert_eq!(changed.shifted, [Shifted { from: 4, to: 5 }]);
        assert_eq!(changed.replaced, [], "nobody pinned anything");
        assert_eq!(super::changed(&before, &before), Changed::default());
    }

    #[test]
    fn an_inbetween_neither_goes_nor_comes() {
        let mut before = sheet(&[(0, 0.0), (4, 4.0)]);
        let now = sheet(&[(0, 0.0), (4, 4.0)]);
        before[1].is_kept = false;
        assert_eq!(changed(&before, &now), Changed { came: vec![4], ..Changed::default() });
    }

    #[test]
    fn every_round_of_a_loop_is_compared_with_itself() {
        let before = sheet(&[(0, 0.0), (4, 4.0), (8, 0.0), (12, 4.0)]);
        assert_eq!(changed(&before, &before), Changed::default());
        let now = sheet(&[(0, 0.0), (5, 4.0), (8, 0.0), (13, 4.0)]);
        let shifted = [Shifted { from: 4, to: 5 }, Shifted { from: 12, to: 13 }];
        assert_eq!(changed(&before, &now).shifted, shifted);
    }

    #[test]
    fn a_pin_replaces_the_found_genga_beside_it_and_no_other() {
        let before = sheet(&[(0, 0.0), (4, 4.0), (9, 9.0), (20, 20.0)]);
        let mut now = sheet(&[(0, 0.0), (4, 4.0), (11, 11.0), (18, 18.0)]);
        assert_eq!(changed(&before, &now).replaced, [], "they were found");
        now[2].is_set = true;
        let replaced = |before: &[Drawn], now: &[Drawn]| changed(before, now).replaced;
        let gone = Gone { koma: 9, place: 9.0 };
        assert_eq!(replaced(&before, &now), [Replaced { gone, by: 11 }], "20 went for 18");
        let mut moved = before.clone();
        moved[2].is_set = true;
        assert_eq!(replaced(&moved, &now), [], "a pin that a person moved replaces none");
        now[2].koma = 9;
        assert_eq!(replaced(&before, &now), [], "one of two on a koma cannot be seen");
    }
}
