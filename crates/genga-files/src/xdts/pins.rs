//! Converts keys that a person marked on a timesheet to pins.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::read::{Change, Column, Mark};
use genga::edits::Pin;
use genga::error::Error;
use genga::sheet::{Repeat, Sheet};
use genga::time::Frame;

/// The meaning of a number without a circle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numbered {
    /// A key: the sheet lists genga (ACTION).
    Keys,
    /// Any drawing: the sheet lists douga (CELL), and only circled numbers are keys.
    Drawings,
}

/// Returns the keys of a column. If any number is circled, only circled ones are keys, whatever the sheet.
pub fn marked_keys(column: &Column, numbered: Numbered) -> Vec<&Change> {
    let drawings = column.changes.iter().filter(|change| matches!(change.mark, Mark::Drawing(_)));
    let circled =
        numbered == Numbered::Drawings || column.changes.iter().any(|change| change.circled);
    drawings.filter(|change| change.circled || !circled).collect()
}

/// A key that a person marked.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkedKey {
    /// The key as a pin.
    pub pin: Pin,
    /// The koma that it is marked on, counted from the first drawing; `None` if a kept drawing is there already.
    pub koma: Option<usize>,
}

/// Returns the marked keys of a column as pins, named by column and number, such as `A3`.
///
/// `sheet` is the sheet without these pins, and provides the clock. If one of its kept drawings begins on a
/// marked koma, the pin is that drawing's source frame. Otherwise it is the first source frame of the
/// koma, between `first` and `last`. Marks in any round of a loop are of its first.
///
/// # Errors
/// [`Error::Edits`] for a key on a blank koma, or beyond the sheet's last: the file belongs to another clip, or to another
/// part of it.
pub fn pins(
    column: &Column,
    numbered: Numbered,
    sheet: &Sheet,
    (first, last): (Frame, Frame),
) -> Result<Vec<MarkedKey>, Error> {
    // All rounds of a loop are the first.
    let round = sheet.first_round();
    let key = |change: &Change| {
        let before = sheet.blank.before;
        let Some(koma) = change.koma.checked_sub(before) else {
            let (name, koma) = (&column.name, change.koma + 1);
            return Err(Error::Edits {
                message: format!(
                    "column {name} has a key on koma {koma}, and the drawings enter on koma {}; is the file of the \
                     same --at?",
                    before + 1
                ),
            });
        };
        if koma >= sheet.length() {
            let message = format!(
                "column {} has a key on koma {}, and the sheet of this clip has {}; is the file of \
                 the same clip, and the same --trim?",
                column.name,
                change.koma + 1,
                before + sheet.length()
            );
            return Err(Error::Edits { message });
        }
        let koma = koma % round.length();
        let kept = kept_on(&round, &column.name, koma);
        let place = kept.unwrap_or_else(|| first_of_koma(&round, first, koma));
        let frame = Frame((place.round().max(0.0) as usize).clamp(first.0, last.0));
        let Mark::Drawing(number) = &change.mark else { unreachable!("only drawings are keys") };
        // Command-line syntax of pins is FRAME:NAME,… so names must not contain these characters.
        let name = format!("{}{number}", column.name).replace([',', ':'], "_");
        let pin = Pin { frame, name: Some(name), weight: None };
        Ok(MarkedKey { pin, koma: kept.is_none().then_some(koma) })
    };
    marked_keys(column, numbered).into_iter().map(key).collect()
}

/// The first source frame of a koma. A loop begins in the midst of its source, whose first frame follows on its last.
fn first_of_koma(round: &Sheet, first: Frame, koma: usize) -> f64 {
    let Some(Repeat { frames, koma: of_round }) = round.repeat else {
        return first_from(round.clock.place_from_koma(koma));
    };
    let in_koma = frames as f64 / of_round as f64;
    let begin = begin_of_loop(round, first, (frames as f64, in_koma));
    let later = first_from((begin + koma) as f64 * in_koma);
    first.0 as f64 + later.rem_euclid(frames as f64)
}

/// The first frame at a place or after it, but for rounding.
fn first_from(place: f64) -> f64 {
    (place - 1e-6).ceil()
}

/// The koma of the source with which a loop begins, by most of its kept drawings.
fn begin_of_loop(round: &Sheet, first: Frame, (frames, in_koma): (f64, f64)) -> usize {
    let Some(layer) = round.layers.first() else { return 0 };
    let start = layer.shown_at(0).map_or(0.0, |own| own.source.place());
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    for (koma, shown) in layer.timed() {
        let drawing = &layer.drawings[shown.drawing];
        let place = drawing.source.place();
        let place = if place < start { place + frames } else { place };
        let own = ((place - first.0 as f64) / in_koma + 1e-6).floor() as usize;
        if let Some(begin) = own.checked_sub(koma).filter(|_| drawing.role.is_kept()) {
            *counts.entry(begin).or_default() += 1;
        }
    }
    counts.into_iter().max_by_key(|(begin, count)| (*count, Reverse(*begin))).map_or(0, |own| own.0)
}

/// The source place of the kept drawing that begins on a koma, if there is one, in the layer of that name or else in
/// the first layer.
fn kept_on(sheet: &Sheet, column: &str, koma: usize) -> Option<f64> {
    let named = sheet.layers.iter().find(|layer| layer.name == column);
    let layer = named.or(sheet.layers.first())?;
    let (_, shown) = layer.timed().find(|(begin, _)| *begin == koma)?;
    let drawing = &layer.drawings[shown.drawing];
    drawing.role.is_kept().then(|| drawing.source.place())
}
