//! Keys that a person marked on a sheet, as pins.

use super::read::{Change, Column, Mark};
use crate::edits::Pin;
use crate::error::Error;
use crate::sheet::Sheet;
use crate::time::Frame;

/// What a number without a circle is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numbered {
    /// A key: the sheet is one of genga (ACTION).
    Keys,
    /// Any drawing: the sheet is one of douga (CELL), and only circled numbers are keys.
    Drawings,
}

/// What on a column is a key. Where any number is circled only those are, whatever the sheet.
pub fn marked_keys(column: &Column, numbered: Numbered) -> Vec<&Change> {
    let drawings = column.changes.iter().filter(|change| matches!(change.mark, Mark::Drawing(_)));
    let circled =
        numbered == Numbered::Drawings || column.changes.iter().any(|change| change.circled);
    drawings.filter(|change| change.circled || !circled).collect()
}

/// The marked keys of a column as pins, named by column and number, such as `A3`.
///
/// `sheet` is the sheet as it is without them: it has the clock, and where one of its own kept
/// drawings begins on a marked koma the pin is that drawing's source frame. Elsewhere it is the source
/// frame nearest to the koma, between `first` and `last`.
///
/// # Errors
/// [`Error::Edits`] for a key beyond the sheet's last koma: the file is of another clip, or of
/// another part of it.
pub fn pins(
    column: &Column,
    numbered: Numbered,
    sheet: &Sheet,
    (first, last): (Frame, Frame),
) -> Result<Vec<Pin>, Error> {
    let pin = |change: &Change| {
        let koma = change.koma;
        if koma >= sheet.length() {
            let message = format!(
                "column {} has a key on koma {}, and the sheet of this clip has {}; is the file of \
                 the same clip, and the same --trim?",
                column.name,
                koma + 1,
                sheet.length()
            );
            return Err(Error::Edits { message });
        }
        let place =
            kept_on(sheet, &column.name, koma).unwrap_or_else(|| sheet.clock.place_from_koma(koma));
        let frame = Frame((place.round().max(0.0) as usize).clamp(first.0, last.0));
        let Mark::Drawing(number) = &change.mark else { unreachable!("only drawings are keys") };
        // A pin is written FRAME:NAME,… on the command line.
        let name = format!("{}{number}", column.name).replace([',', ':'], "_");
        Ok(Pin { frame, name: Some(name), weight: None })
    };
    marked_keys(column, numbered).into_iter().map(pin).collect()
}

/// The place of the kept drawing that begins on a koma in the layer of that name, or in the first, if one
/// does.
fn kept_on(sheet: &Sheet, column: &str, koma: usize) -> Option<f64> {
    let named = sheet.layers.iter().find(|layer| layer.name == column);
    let layer = named.or(sheet.layers.first())?;
    let (_, shown) = layer.timed().find(|(begin, _)| *begin == koma)?;
    let drawing = &layer.drawings[shown.drawing];
    drawing.role.is_kept().then(|| drawing.source.place())
}
