//! The take as it is (区間の外): outside of passages every koma shows the source.

use std::mem::take;

use super::row::Row;
use super::station::Station;
use super::timed::Timed;
use crate::sheet::{Drawing, Role, Source, Why};

impl Timed<'_> {
    /// Returns the koma between timed ones and the source. Both sides share the drawing of such a koma, so that the
    /// body does not jump there.
    pub(super) fn borders<'b>(self) -> impl Iterator<Item = Station<'b>> {
        let borders = self.koma.changes().filter(move |koma| *koma < self.length);
        borders.map(move |koma| Station {
            koma,
            place: self.clock.place_from_koma(koma),
            role: Role::End,
            key: None,
            is_border: true,
        })
    }

    /// Replaces the drawings on all koma that are not timed. A border and a drawing that a person set keep their names.
    pub(super) fn beside_source(self, mut row: Row) -> Row {
        if self.koma.values().all(|is_timed| *is_timed) {
            return row;
        }
        let (begins, drawings) = (take(&mut row.begins), take(&mut row.drawings));
        let mut own = begins.into_iter().zip(drawings).peekable();
        for koma in 0..self.length {
            let drawn = own.next_if(|(begin, _)| *begin == koma).map(|(_, drawing)| drawing);
            let shown = match drawn {
                Some(drawing) if self.has(koma) || is_named(&drawing) => Some(drawing),
                _ => (!self.has(koma)).then(|| self.source(koma)),
            };
            shown.into_iter().for_each(|drawing| row.put(koma, koma, drawing));
        }
        row
    }

    fn source(self, koma: usize) -> Drawing {
        let is_end = koma == 0 || koma + 1 == self.length;
        let role = if is_end { Role::End } else { Role::Inbetween };
        Drawing::new(Source::At(self.clock.place_from_koma(koma)), role, Why::default())
    }
}

fn is_named(drawing: &Drawing) -> bool {
    drawing.role == Role::End || drawing.why.pinned.is_some()
}
