//! Puts the columns of a sheet into somebody else's timesheet (XDTS or TDTS). The text is spliced, not written anew, so
//! that everything else in it stays as it is, byte for byte.

use std::ops::Range;

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use super::file::{Field, Names, Track};
use super::read::{Mark, read_field, signed};
use super::write::{Column, checked, entries, name};
use super::{BLANK, CELS, CONTINUED, TDTS_CELL, TDTS_SIGNATURE};
use crate::json_words;
use genga::error::Error;
use genga::sheet::{Sheet, column_name};

/// The numbers of fields of a timesheet, with what is written into the columns of each.
type Fields = Vec<(u32, Column)>;

/// How the columns go in.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct IntoTimesheet {
    /// Names of the columns in the timesheet, one per layer; empty for those of the sheet.
    pub names: Vec<String>,
    /// Whether a column of the same name that has drawings is replaced.
    pub replaces: bool,
    /// What an XDTS file gets: ACTION or CELL. `None` guesses. A TDTS file has both columns and gets both.
    pub column: Option<PaperColumn>,
}

/// A column of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PaperColumn {
    /// ACTION (原画): keys are numbered, inbetweens are marks.
    Action,
    /// CELL (動画): every drawing is numbered.
    Cell,
}

/// A timesheet with the columns of a sheet in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PutInto {
    /// The bytes of the timesheet.
    pub bytes: Vec<u8>,
    /// What became of each column, and of the timesheet's length, for the user.
    pub notes: Vec<String>,
}

impl IntoTimesheet {
    /// Puts the columns of a sheet into a timesheet. A column that is not there comes after the last one; one without a
    /// drawing is filled. Other columns, spoken lines, camera and header stay, and so does everything that the format
    /// does not describe. The timesheet becomes longer only if the cut of the sheet is.
    ///
    /// # Errors
    /// [`Error::Sheet`] with line and column if the file is no timesheet; for a column with drawings that is not to be
    /// replaced, or a name that two columns have; as [`Sheet::check`], and for a sheet without koma.
    pub fn put(&self, timesheet: &[u8], sheet: &Sheet) -> Result<PutInto, Error> {
        checked(sheet)?;
        let (signature, text) = signed(timesheet)?;
        let names = self.names(sheet)?;
        let (columns, guess) = self.columns(signature, timesheet)?;
        let table = table(text)?;
        let mut splice = Splice { text, edits: Vec::new() };
        let mut notes = guess;
        let (length, duration) = (sheet.cut_length(), table.duration()?);
        if length as u64 > duration {
            splice.replace(table.duration, length.to_string());
            notes.push(format!(
                "the timesheet had {duration} koma and has {length} now; its other columns stay as they are"
            ));
        }
        let mut fresh = Fresh::default();
        for (field, column) in columns {
            let own = Columns { table: &table, field, sheet, column, replaces: self.replaces };
            own.put(&names, &mut splice, &mut fresh, &mut notes)?;
        }
        fresh.put(&table, &mut splice)?;
        if !sheet.lines.is_empty() {
            notes.push(
                "the sheet's spoken lines are not put in; those of the timesheet stay".into(),
            );
        }
        if !sheet.camera.is_empty() {
            notes.push("the sheet's camera work is not put in; that of the timesheet stays".into());
        }
        let offset = timesheet.len() - text.len();
        let bytes = [&timesheet[..offset], splice.finish().as_bytes()].concat();
        Ok(PutInto { bytes, notes })
    }

    /// The names of the columns, one per layer.
    fn names(&self, sheet: &Sheet) -> Result<Vec<String>, Error> {
        let count = sheet.layers.len();
        let names: Vec<String> = match self.names.as_slice() {
            [] => {
                let layers = sheet.layers.iter().enumerate();
                layers.map(|(track, layer)| name(track, &layer.name)).collect()
            }
            names if names.len() == count => {
                names.iter().enumerate().map(|(track, own)| name(track, own)).collect()
            }
            names => {
                return Err(Error::sheet(format!(
                    "the sheet has {count} layers, and there are names for {}; give one for each",
                    names.len()
                )));
            }
        };
        let again = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name));
        match again {
            None => Ok(names),
            Some((_, name)) => Err(Error::sheet(format!(
                "two layers of the sheet would be column {name}; give each a name of its own"
            ))),
        }
    }

    /// The fields of the timesheet that get columns, and what was guessed.
    fn columns(&self, signature: &str, timesheet: &[u8]) -> Result<(Fields, Vec<String>), Error> {
        let action = (CELS, Column::Genga { has_marks: true });
        let cell = Column::Douga { has_circles: false };
        if signature == TDTS_SIGNATURE {
            return Ok((vec![action, (TDTS_CELL, cell)], vec![]));
        }
        let (column, guess) = match self.column {
            Some(column) => (column, vec![]),
            None => {
                let there = read_field(timesheet, |_| CELS)?;
                let mut changes = there.columns.iter().flat_map(|column| &column.changes);
                let (column, why) = match changes.any(|change| change.mark == Mark::Inbetween) {
                    true => {
                        (PaperColumn::Action, "has inbetween marks: keys are numbered (ACTION)")
                    }
                    false => (
                        PaperColumn::Cell,
                        "has no inbetween marks: all drawings are numbered (CELL)",
                    ),
                };
                (column, vec![format!("the timesheet {why}")])
            }
        };
        let column = match column {
            PaperColumn::Action => action.1,
            PaperColumn::Cell => cell,
        };
        Ok((vec![(CELS, column)], guess))
    }
}

/// The first time table of a file. All parts are slices of its text.
struct Table<'a> {
    whole: &'a RawValue,
    duration: &'a RawValue,
    fields: Option<&'a RawValue>,
    headers: Option<&'a RawValue>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AnyRoot<'a> {
    #[serde(borrow, default)]
    time_tables: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    time_sheets: Vec<&'a RawValue>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AnyTable<'a> {
    #[serde(borrow)]
    duration: &'a RawValue,
    #[serde(borrow)]
    fields: Option<&'a RawValue>,
    #[serde(borrow)]
    time_table_headers: Option<&'a RawValue>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AnyNames<'a> {
    field_id: u32,
    #[serde(borrow)]
    names: &'a RawValue,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AnyField<'a> {
    field_id: u32,
    #[serde(borrow)]
    tracks: &'a RawValue,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AnyTrack<'a> {
    track_no: usize,
    #[serde(borrow)]
    frames: &'a RawValue,
}

fn table(text: &str) -> Result<Table<'_>, Error> {
    let root: AnyRoot<'_> = parsed(text)?;
    let whole = match (root.time_tables.as_slice(), root.time_sheets.as_slice()) {
        ([table, ..], _) => *table,
        ([], [sheet, ..]) => {
            let sheet: AnyRoot<'_> = parsed(sheet.get())?;
            *sheet.time_tables.first().ok_or_else(no_table)?
        }
        ([], []) => return Err(no_table()),
    };
    let AnyTable { duration, fields, time_table_headers } = parsed(whole.get())?;
    Ok(Table { whole, duration, fields, headers: time_table_headers })
}

fn no_table() -> Error {
    Error::sheet("expected a time table (timeTables), found none; save a timesheet with one")
}

impl<'a> Table<'a> {
    fn duration(&self) -> Result<u64, Error> {
        parsed(self.duration.get())
    }

    /// The names of the columns of a field, as a slice of the text.
    fn names(&self, field: u32) -> Result<Option<&'a RawValue>, Error> {
        let Some(headers) = self.headers else { return Ok(None) };
        let headers: Vec<AnyNames<'_>> = parsed(headers.get())?;
        Ok(headers.into_iter().find(|header| header.field_id == field).map(|header| header.names))
    }

    /// The tracks of a field, as a slice of the text.
    fn tracks(&self, field: u32) -> Result<Option<&'a RawValue>, Error> {
        let Some(fields) = self.fields else { return Ok(None) };
        let fields: Vec<AnyField<'_>> = parsed(fields.get())?;
        Ok(fields.into_iter().find(|own| own.field_id == field).map(|own| own.tracks))
    }
}

/// Columns and fields that the timesheet does not have at all.
#[derive(Default)]
struct Fresh {
    headers: Vec<Names>,
    fields: Vec<Field>,
}

impl Fresh {
    /// Adds them to the lists of the time table, or the lists to the time table.
    fn put(self, table: &Table<'_>, splice: &mut Splice<'_>) -> Result<(), Error> {
        let headers = self.headers.iter().map(json).collect::<Result<Vec<_>, _>>()?;
        let fields = self.fields.iter().map(json).collect::<Result<Vec<_>, _>>()?;
        let lists =
            [("timeTableHeaders", table.headers, headers), ("fields", table.fields, fields)];
        for (name, list, items) in lists.into_iter().filter(|(.., items)| !items.is_empty()) {
            match list {
                Some(list) => splice.append(list, &items),
                None => splice.begin(table.whole, format!("\"{name}\":[{}],", items.join(","))),
            }
        }
        Ok(())
    }
}

/// The columns of a field of the timesheet, into which those of a sheet go.
struct Columns<'a> {
    table: &'a Table<'a>,
    field: u32,
    sheet: &'a Sheet,
    column: Column,
    replaces: bool,
}

impl Columns<'_> {
    fn put(
        &self,
        names: &[String],
        splice: &mut Splice<'_>,
        fresh: &mut Fresh,
        notes: &mut Vec<String>,
    ) -> Result<(), Error> {
        let header = self.table.names(self.field)?;
        let raw = self.table.tracks(self.field)?;
        let mut there: Vec<String> =
            header.map(|names| parsed(names.get())).transpose()?.unwrap_or_default();
        let tracks: Vec<AnyTrack<'_>> =
            raw.map(|tracks| parsed(tracks.get())).transpose()?.unwrap_or_default();
        let named = there.len();
        // A track without a name still has its place.
        let count = tracks.iter().map(|track| track.track_no + 1).max().unwrap_or(0);
        (named..count).for_each(|track| there.push(column_name(track)));
        let mut new = Vec::new();
        for (layer, name) in self.sheet.layers.iter().zip(names) {
            let track_no = self.place(name, &mut there)?;
            let track = Track { frames: entries(self.sheet, layer, self.column), track_no };
            let of = self.said();
            match tracks.iter().find(|track| track.track_no == track_no) {
                None => {
                    notes.push(format!("column {name}{of} is new"));
                    new.push(json(&track)?);
                }
                Some(old) if !has_drawings(old)? => {
                    notes.push(format!("column {name}{of} was empty and is filled"));
                    splice.replace(old.frames, json(&track.frames)?);
                }
                Some(old) if self.replaces => {
                    notes.push(format!("column {name}{of} is replaced"));
                    splice.replace(old.frames, json(&track.frames)?);
                }
                Some(_) => {
                    return Err(Error::sheet(format!(
                        "the timesheet has a column {name} with drawings: replace it with --replace, or name another \
                         column with --columns"
                    )));
                }
            }
        }
        match header {
            Some(header) => splice
                .append(header, &there[named..].iter().map(json).collect::<Result<Vec<_>, _>>()?),
            None => fresh.headers.push(Names { field_id: self.field, names: there }),
        }
        match raw {
            Some(tracks) => splice.append(tracks, &new),
            None => fresh.fields.push(Field {
                field_id: self.field,
                tracks: new.iter().map(|track| parsed(track)).collect::<Result<_, _>>()?,
            }),
        }
        Ok(())
    }

    /// The track of the column of a name. A new name is added to those that are `there`.
    fn place(&self, name: &str, there: &mut Vec<String>) -> Result<usize, Error> {
        let mut same = (0..there.len()).filter(|track| there[*track].trim() == name);
        match (same.next(), same.next()) {
            (Some(track), None) => Ok(track),
            (None, _) => {
                there.push(name.into());
                Ok(there.len() - 1)
            }
            (Some(_), Some(_)) => Err(Error::sheet(format!(
                "the timesheet has two columns {name}; name another column with --columns"
            ))),
        }
    }

    fn said(&self) -> &'static str {
        match self.column {
            Column::Genga { .. } => " in ACTION",
            Column::Douga { .. } => " in CELL",
        }
    }
}

/// Whether a track shows any drawing or mark.
fn has_drawings(track: &AnyTrack<'_>) -> Result<bool, Error> {
    let track: Track = parsed(&format!("{{\"trackNo\":0,\"frames\":{}}}", track.frames.get()))?;
    let mut values = track.frames.iter().flat_map(|entry| &entry.data[0].values);
    Ok(values.any(|value| ![BLANK, CONTINUED, ""].contains(&value.as_str())))
}

fn parsed<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, Error> {
    serde_json::from_str(text).map_err(|error| Error::Sheet {
        place: None,
        message: json_words(&error),
        source: Some(error.into()),
    })
}

fn json(value: &(impl Serialize + ?Sized)) -> Result<String, Error> {
    serde_json::to_string(value)
        .map_err(|error| Error::Encoding { what: "the time table", source: error.into() })
}

/// Changes of a text, each of a part of it.
struct Splice<'a> {
    text: &'a str,
    edits: Vec<(Range<usize>, String)>,
}

impl Splice<'_> {
    /// Replaces a value of the text.
    fn replace(&mut self, value: &RawValue, by: String) {
        let range = self.range(value);
        self.edits.push((range, by));
    }

    /// Adds items behind the last one of a list in the text.
    fn append(&mut self, list: &RawValue, items: &[String]) {
        if items.is_empty() {
            return;
        }
        let (range, written) = (self.range(list), list.get());
        let inside = written[1..written.len() - 1].trim_end();
        let comma = if inside.trim().is_empty() { "" } else { "," };
        let end = range.start + 1 + inside.len();
        self.edits.push((end..end, format!("{comma}{}", items.join(","))));
    }

    /// Adds members in front of the first one of an object in the text.
    fn begin(&mut self, object: &RawValue, members: String) {
        let at = self.range(object).start + 1;
        self.edits.push((at..at, members));
    }

    /// Where a part of the text stands in it.
    fn range(&self, part: &RawValue) -> Range<usize> {
        let begin = part.get().as_ptr() as usize - self.text.as_ptr() as usize;
        begin..begin + part.get().len()
    }

    /// Returns the changed text.
    fn finish(mut self) -> String {
        self.edits.sort_by_key(|(range, _)| range.start);
        let (mut text, mut at) = (String::with_capacity(2 * self.text.len()), 0);
        for (range, by) in &self.edits {
            text.push_str(&self.text[at..range.start]);
            text.push_str(by);
            at = range.end;
        }
        text.push_str(&self.text[at..]);
        text
    }
}

#[cfg(test)]
mod tests;
