//! Pins from keys that a person marked in one of genga's own files: the genga of an edited table or sheet.

use csv::StringRecord;

use crate::sheet_json::SheetFile;
use crate::table::table_reader;
use genga::edits::Pin;
use genga::error::{Cause, Error};
use genga::sanitize::text_of;
use genga::sheet::{Drawing, Layer, Role};
use genga::time::Frame;

/// Reads the genga of a `keys.csv`, `drawings.csv` or `sheet.csv` as pins, with the column they belong to.
///
/// A pin's frame is `source_frame`, rounded to a whole frame. A row without a role is a genga, as is one
/// whose role a person changed to genga. The pin's name comes from a column `name`, or else from the `note`
/// or `why`; its weight from a column `weight`. Fields may be separated by commas, semicolons or tabs,
/// depending on the program that saved the table.
///
/// # Errors
/// [`Error::Table`] with the place of the mistake: no `source_frame` column, or a frame that is not a number.
/// [`Error::Sheet`] if the table has no such column, or no genga in it.
pub fn pins_from_table(bytes: &[u8], column: Option<&str>) -> Result<(Vec<Pin>, String), Error> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        no_table("this is not text in UTF-8; save the table as CSV in UTF-8".into(), error)
    })?;
    let mut reader = table_reader(text);
    let failed = |error: csv::Error| no_table(format!("is no table: {error}"), error);
    let table = Table::from_header(reader.headers().map_err(failed)?)?;
    let mut keys = Vec::new();
    for record in reader.records() {
        let record = record.map_err(failed)?;
        let line = record.position().map_or(0, |place| place.line() as usize);
        let wrong = |(field, message): Wrong| wrong_at((line, field + 1), message);
        keys.extend(table.key(&record).map_err(wrong)?);
    }
    let columns = keys.iter().map(|(column, _)| column.as_str()).collect();
    let column = one_of(columns, column)?;
    let mut pins: Vec<Pin> =
        keys.into_iter().filter(|(own, _)| *own == column).map(|(_, pin)| pin).collect();
    // A sheet.csv has a row per koma, so a held genga is repeated.
    pins.dedup_by_key(|pin| pin.frame);
    Ok((pins, column))
}

/// Index of an invalid field in its row, and the error message.
type Wrong = (usize, String);

fn wrong_at(place: (usize, usize), message: impl Into<String>) -> Error {
    Error::Table { place: Some(place), message: message.into(), source: None }
}

fn no_table(message: String, source: impl Into<Cause>) -> Error {
    Error::Table { place: None, message, source: Some(source.into()) }
}

/// Positions of the known columns in a table.
struct Table {
    column: Option<usize>,
    role: Option<usize>,
    frame: usize,
    name: Option<usize>,
    weight: Option<usize>,
    note: Option<usize>,
}

impl Table {
    fn from_header(header: &StringRecord) -> Result<Self, Error> {
        let at = |name: &str| header.iter().position(|field| field.trim() == name);
        let frame = at("source_frame").ok_or_else(|| {
            wrong_at(
                (1, 1),
                "there is no column source_frame; of a list of frames that word is the first line. Keys are read from a \
                 keys.csv, drawings.csv or sheet.csv as genga writes it too, from a sheet.json and from an XDTS timesheet",
            )
        })?;
        Ok(Self {
            column: at("column").or_else(|| at("layer")),
            role: at("role"),
            frame,
            name: at("name"),
            weight: at("weight"),
            note: at("note").or_else(|| at("why")),
        })
    }

    /// The key in a row with its column, if the row is a genga.
    fn key(&self, row: &StringRecord) -> Result<Option<(String, Pin)>, Wrong> {
        let field =
            |at: Option<usize>| text_of(at.and_then(|at| row.get(at)).unwrap_or_default().trim());
        let wrong = |at: Option<usize>, expected: &str| {
            (at.unwrap_or(0), format!("{expected}, found \"{}\"", field(at)))
        };
        match field(self.role) {
            "" | "genga" => {}
            "inbetween" | "end" => return Ok(None),
            _ => return Err(wrong(self.role, "role: expected genga, inbetween or end")),
        }
        let frame = match field(Some(self.frame)) {
            // A line of commas alone, as table programs leave at the end.
            "" if row.iter().all(|field| field.trim().is_empty()) => return Ok(None),
            text => text.parse().ok().and_then(whole_frame).ok_or_else(|| {
                wrong(Some(self.frame), "source_frame: expected a frame number of the clip")
            })?,
        };
        let name = Some(field(self.name)).filter(|name| !name.is_empty());
        let name = name.or_else(|| named_in(field(self.note))).map(String::from);
        let weight = match field(self.weight) {
            "" => None,
            text => Some(text.parse().map_err(|_| {
                wrong(self.weight, "weight: expected a spacing weight, 0 to below 1")
            })?),
        };
        let column = Some(field(self.column)).filter(|column| !column.is_empty());
        Ok(Some((column.unwrap_or("A").into(), Pin { frame, name, weight })))
    }
}

/// The name of a pinned key as its note gives it: see [`Why`](genga::sheet::Why).
fn named_in(note: &str) -> Option<&str> {
    note.split("; ").find_map(|reason| reason.strip_prefix("pinned: "))
}

/// Turns the genga that a sheet shows into pins, with the names and weights they were pinned with, and returns
/// the name of their layer too.
///
/// # Errors
/// [`Error::Sheet`] if the layer does not exist or contains no genga.
pub fn pins_from_sheet(file: &SheetFile, layer: Option<&str>) -> Result<(Vec<Pin>, String), Error> {
    let layers = &file.sheet.layers;
    let has_genga = |layer: &&Layer| layer.count(Role::Genga) > 0;
    let names = layers.iter().filter(has_genga).map(|layer| layer.name.as_str()).collect();
    let name = one_of(names, layer)?;
    let layer = layers.iter().filter(has_genga).find(|layer| layer.name == name);
    let edits = file.made_with.as_ref().map(|made| &made.edits);
    let weight = |frame| {
        let edits = edits?;
        let moved = edits.moves.iter().map(|moved| (moved.to, moved.weight));
        let mut pins = edits.pins.iter().map(|pin| (pin.frame, pin.weight)).chain(moved);
        pins.find(|(pinned, _)| *pinned == frame)?.1
    };
    let pin = |drawing: &Drawing| {
        let frame = whole_frame(drawing.source.place())?;
        let name = drawing.why.pinned.clone().filter(|name| !name.is_empty());
        Some(Pin { frame, name, weight: weight(frame) })
    };
    let genga = layer.into_iter().flat_map(Layer::shown);
    let pins = genga.filter(|drawing| drawing.role == Role::Genga).filter_map(pin).collect();
    Ok((pins, name))
}

/// Rounds a place to the nearest frame; `None` if it is not a plausible frame number.
fn whole_frame(place: f64) -> Option<Frame> {
    let is_frame = place.is_finite() && place > -0.5 && place < 1e15;
    is_frame.then(|| Frame(place.round().max(0.0) as usize))
}

/// The requested column; by default the only one, or else A.
fn one_of(mut columns: Vec<&str>, asked: Option<&str>) -> Result<String, Error> {
    columns.sort_unstable();
    columns.dedup();
    if columns.is_empty() {
        let message =
            "there is no genga in it, so there is no key to pin; the role of a key is genga";
        return Err(Error::sheet(message));
    }
    let found = match (asked, columns.as_slice()) {
        (None, [only]) => Some(*only),
        (name, _) => columns.iter().copied().find(|column| *column == name.unwrap_or("A")),
    };
    found.map(String::from).ok_or_else(|| {
        let there = columns.join(", ");
        Error::sheet(match asked {
            Some(name) => format!("there is no genga in a column {name}; there are {there}"),
            None => format!("which column? --pin-column takes one of {there}"),
        })
    })
}

#[cfg(test)]
mod tests;
