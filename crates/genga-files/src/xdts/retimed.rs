//! The return path: applies the timing of a timesheet that was edited in another program to the drawings of its sheet.

use super::column;
use super::read::{Change, Column, Exchange, Mark};
use genga::error::Error;
use genga::sheet::{Blank, Exposure, Layer, Number, Sheet};

/// Applies the timing of a timesheet whose drawings are all numbered (CELL) to a sheet. Drawings may be moved, held
/// longer or shorter, shown twice or left out, and the sheet may change its length. Blank koma before all drawings and
/// after the last of a column stay blank. Drawings keep their poses, roles
/// and reasons. The dialogue comes from the timesheet if it has any, else from the sheet. An unchanged timesheet
/// gives the same sheet.
///
/// Columns are matched to layers by name. If there is one layer and one column, their names may differ.
///
/// # Errors
/// [`Error::Sheet`] with column and koma for a number that the sheet does not have or a blank koma between drawings. Also
/// for a layer without a column, and for a timesheet of key drawings alone (ACTION).
///
/// ```
/// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
/// use genga_files::xdts::{Xdts, read_cells, retimed};
///
/// # let clip = genga::motion::bvh::open("../../data/kick.bvh".as_ref())?.clip;
/// let mut engine = Engine::new(clip)?;
/// let breakdown = engine.run(&Recipe::default(), &Edits::default())?;
/// let written = Xdts::default().write(breakdown.sheet, "kick")?.douga;
/// let back = retimed(&read_cells(written.as_bytes())?, breakdown.sheet)?;
/// assert_eq!(back.layers, breakdown.sheet.layers);
/// # Ok::<(), genga::Error>(())
/// ```
pub fn retimed(timesheet: &Exchange, sheet: &Sheet) -> Result<Sheet, Error> {
    if timesheet.length == 0 {
        return Err(Error::sheet("the timesheet has no koma"));
    }
    let is_mark = |change: &Change| change.mark == Mark::Inbetween;
    if timesheet.columns.iter().flat_map(|column| &column.changes).any(is_mark) {
        return Err(Error::sheet(
            "this is a timesheet of key drawings (ACTION), on which inbetweens have no numbers; give the one of all \
             drawings (CELL), as CUT_douga_ts.xdts or CUT.tdts",
        ));
    }
    let columns = (0..sheet.layers.len()).map(|track| column_of(timesheet, sheet, track));
    let columns = columns.collect::<Result<Vec<_>, Error>>()?;
    let before = columns.iter().filter_map(|column| enters(column)).min().unwrap_or(0);
    let layers = sheet.layers.iter().zip(columns).map(|(layer, column)| {
        let exposures = exposures(column, layer, (before, timesheet.length))?;
        Ok(Layer { exposures, ..layer.clone() })
    });
    let layers = layers.collect::<Result<Vec<_>, Error>>()?;
    let drawn = layers.iter().map(Layer::length).max().unwrap_or(0);
    if drawn == 0 {
        return Err(Error::sheet("the timesheet shows none of the sheet's drawings"));
    }
    let blank = Blank { before, after: timesheet.length - before - drawn };
    // A program without support for the S column drops it, so an empty one does not mean that the dialogue was deleted.
    let retimed = Sheet { layers, ..sheet.clone() }.with_blank(blank);
    Ok(match timesheet.lines.as_slice() {
        [] => retimed,
        lines => retimed.with_lines(lines),
    })
}

/// The koma on which the first drawing of a column enters.
fn enters(column: &Column) -> Option<usize> {
    column.changes.iter().find(|change| change.mark != Mark::Blank).map(|change| change.koma)
}

/// Finds the column of a layer.
fn column_of<'a>(
    timesheet: &'a Exchange,
    sheet: &Sheet,
    track: usize,
) -> Result<&'a Column, Error> {
    let name = column(track, &sheet.layers[track].name);
    let named = timesheet.columns.iter().find(|column| column.name == name);
    let only = match (&timesheet.columns[..], &sheet.layers[..]) {
        ([column], [_]) => Some(column),
        _ => None,
    };
    named.or(only).ok_or_else(|| {
        let names: Vec<&str> = timesheet.columns.iter().map(|column| &*column.name).collect();
        let there = if names.is_empty() { "none".into() } else { names.join(", ") };
        Error::sheet(format!("the timesheet has no column {name}; it has {there}"))
    })
}

/// The exposures of a column in order, from koma `before` of a timesheet of `length` koma on, to its last drawing.
fn exposures(
    column: &Column,
    layer: &Layer,
    (before, length): (usize, usize),
) -> Result<Vec<Exposure>, Error> {
    let mut exposures: Vec<Exposure> = Vec::with_capacity(column.changes.len());
    let numbers = layer.numbers();
    let ends = column.changes.iter().skip(1).map(|change| change.koma).chain([length]);
    let shown = column.changes.iter().rposition(|change| change.mark != Mark::Blank);
    let shown = column.changes.iter().zip(ends).take(shown.map_or(0, |last| last + 1));
    for (change, end) in shown.filter(|(_, end)| *end > before) {
        let koma = end.saturating_sub(change.koma);
        match drawing(column, change, &numbers)? {
            Some(drawing) if koma > 0 => exposures.push(Exposure { drawing, koma }),
            // An inbetween mark: the drawing before it stays.
            None => exposures.iter_mut().last().into_iter().for_each(|last| last.koma += koma),
            Some(_) => {}
        }
    }
    Ok(exposures)
}

/// The drawing that a change brings; `None` if the one before stays.
fn drawing(column: &Column, change: &Change, numbers: &[Number]) -> Result<Option<usize>, Error> {
    let place = || format!("column {}, koma {}", column.name, change.koma + 1);
    match &change.mark {
        Mark::Drawing(text) => {
            let number = text.parse().ok().and_then(|number| numbers.binary_search(&number).ok());
            let range = || match numbers {
                [] => "none".into(),
                [first, ..] => format!("{first} to {}", numbers[numbers.len() - 1]),
            };
            number.map(Some).ok_or_else(|| {
                Error::sheet(format!(
                    "{}: the sheet has no drawing {text}, it has {}; one that was added by hand has no pose in the \
                     capture: write the number of one that has, or pin a key there with --pin-from",
                    place(),
                    range()
                ))
            })
        }
        Mark::Blank => Err(Error::sheet(format!(
            "{}: nothing is shown there, between drawings of this column or before it enters with the others, and a motion \
             has a pose on every koma; hold a drawing over it",
            place()
        ))),
        Mark::Inbetween | Mark::Reverse => Ok(None),
    }
}

#[cfg(test)]
mod tests;
