//! The table of drawings whose numbers are to be told from those of the sheet before.

use crate::{csv_table, number};
use genga::error::Error;
use genga::sheet::{Number, Renumbered};

/// Writes `column,old,new,genga_old,genga_new,source_frame`, one row per drawing of the sheet before or of the new one, in
/// their order. A drawing that is new has no old number, one that went no new number. Genga have a second number in each.
///
/// # Errors
/// Fails only if memory runs out.
pub fn numbers_csv(drawings: &[Renumbered]) -> Result<String, Error> {
    let written =
        |number: &Option<Number>| number.as_ref().map(Number::to_string).unwrap_or_default();
    let rows = drawings.iter().map(|Renumbered { layer, place, old, new }| {
        [
            layer.clone(),
            written(&old.drawing),
            written(&new.drawing),
            written(&old.genga),
            written(&new.genga),
            number(*place),
        ]
    });
    csv_table(&["column", "old", "new", "genga_old", "genga_new", "source_frame"], rows)
}
