//! The return path: applies the timing of a timesheet that was edited in another program to the drawings of its sheet.

use super::column;
use super::read::{Change, Column, Exchange, Mark};
use genga::error::Error;
use genga::sheet::{Exposure, Layer, Sheet};

/// Applies the timing of a timesheet whose drawings are all numbered (CELL) to a sheet. Drawings may be moved, held
/// longer or shorter, shown twice or left out, and the sheet may change its length. Drawings keep their poses, roles
/// and reasons. The dialogue comes from the timesheet if it has any, else from the sheet. An unchanged timesheet
/// gives the same sheet.
///
/// Columns are matched to layers by name. If there is one layer and one column, their names may differ.
///
/// # Errors
/// [`Error::Sheet`] with column and koma for a number that the sheet does not have or a koma without a drawing. Also
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
    let layers = sheet.layers.iter().enumerate();
    let layers = layers.map(|(track, layer)| {
        let column = column_of(timesheet, sheet, track)?;
        let exposures = exposures(column, layer, timesheet.length)?;
        Ok(Layer { exposures, ..layer.clone() })
    });
    let layers = layers.collect::<Result<_, Error>>()?;
    // A program without support for the S column drops it, so an empty one does not mean that the dialogue was deleted.
    let lines = if timesheet.lines.is_empty() { &sheet.lines } else { &timesheet.lines };
    Ok(Sheet { layers, lines: vec![], ..sheet.clone() }.with_lines(lines))
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

/// The exposures of a column, in order.
fn exposures(column: &Column, layer: &Layer, length: usize) -> Result<Vec<Exposure>, Error> {
    let mut exposures: Vec<Exposure> = Vec::with_capacity(column.changes.len());
    let ends = column.changes.iter().skip(1).map(|change| change.koma).chain([length]);
    for (change, end) in column.changes.iter().zip(ends) {
        let koma = end.saturating_sub(change.koma);
        match drawing(column, change, layer)? {
            Some(drawing) if koma > 0 => exposures.push(Exposure { drawing, koma }),
            // An inbetween mark: the drawing before it stays.
            None => exposures.iter_mut().last().into_iter().for_each(|last| last.koma += koma),
            Some(_) => {}
        }
    }
    Ok(exposures)
}

/// The drawing that a change brings; `None` if the one before stays.
fn drawing(column: &Column, change: &Change, layer: &Layer) -> Result<Option<usize>, Error> {
    let place = || format!("column {}, koma {}", column.name, change.koma + 1);
    let count = layer.drawings.len();
    match &change.mark {
        Mark::Drawing(number) => match number.trim().parse::<usize>() {
            Ok(number) if (1..=count).contains(&number) => Ok(Some(number - 1)),
            _ => Err(Error::sheet(format!(
                "{}: the sheet has no drawing {number}, it has 1 to {count}; one that was added by hand has no pose in \
                 the capture: write the number of one that has, or pin a key there with --pin-from",
                place()
            ))),
        },
        Mark::Blank => Err(Error::sheet(format!(
            "{}: nothing is shown there, and a motion has a pose on every koma; hold a drawing over it",
            place()
        ))),
        Mark::Inbetween | Mark::Reverse => Ok(None),
    }
}

#[cfg(test)]
mod tests;
