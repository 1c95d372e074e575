//! XDTS as a sheet of columns, tolerant of what programs in use write.

use super::file::{Entry, Header, Root, TimeTable};
use super::{
    BLANK, CELS, CIRCLED, CONTINUED, INBETWEEN, REVERSE, SIGNATURE, TDTS_CELL, TDTS_SIGNATURE,
    speech,
};
use crate::deliver::json_words;
use crate::error::Error;
use crate::sheet::{SpokenLine, column_name};

/// An XDTS or TDTS file: the cels of its first time table, and what is spoken there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exchange {
    /// The name of the time table: often the whole name of the cut.
    pub name: String,
    /// The number of the cut, as text.
    pub cut: Option<String>,
    /// The number of the scene, as text.
    pub scene: Option<String>,
    /// Koma.
    pub length: usize,
    /// The columns by track, back to front.
    pub columns: Vec<Column>,
    /// What is spoken (S), in the order in which it begins.
    pub lines: Vec<SpokenLine>,
}

/// A column of cels. Two may have one name: they differ by track.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// The number of the track, from 0.
    pub track: usize,
    /// The column's name; by its track (A, B, C …) where the file gives none.
    pub name: String,
    /// What changes, by koma: the first on koma 0, all within the length, no drawing after itself.
    pub changes: Vec<Change>,
}

/// What stands on a column from a koma on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// Koma, from 0.
    pub koma: usize,
    /// What stands there.
    pub mark: Mark,
    /// Whether it is circled as a key: an extension, `OPTION_KEYFRAME`.
    pub circled: bool,
}

/// What a sheet can say on a koma.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Mark {
    /// A drawing by its number or name.
    Drawing(String),
    /// An inbetween goes here; the drawing before it stays.
    Inbetween,
    /// Inbetweens go here backwards; the drawing before them stays.
    Reverse,
    /// Nothing is shown (カラ).
    Blank,
}

/// Reads an XDTS or TDTS file: with or without BOM, any line ends, entries in any order, unknown
/// members passed over.
///
/// # Errors
/// [`Error::Sheet`] with line and column for what is neither, or not JSON of that shape.
pub fn read(bytes: &[u8]) -> Result<Exchange, Error> {
    read_field(bytes, |_| CELS)
}

/// The same, of a TDTS file its CELL column, on which every drawing has its number.
///
/// # Errors
/// Those of [`read`].
pub fn read_cells(bytes: &[u8]) -> Result<Exchange, Error> {
    read_field(bytes, |signature| if signature == TDTS_SIGNATURE { TDTS_CELL } else { CELS })
}

/// Reads the field that belongs to a signature.
fn read_field(bytes: &[u8], field: impl Fn(&str) -> u32) -> Result<Exchange, Error> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let message = "expected UTF-8, which XDTS is written in; save the sheet again as XDTS";
        let before = &bytes[..error.valid_up_to()];
        let line = before.iter().filter(|byte| **byte == b'\n').count();
        let column = before.iter().rev().take_while(|byte| **byte != b'\n').count();
        wrong((line + 1, column + 1), message)
    })?;
    let signature = [SIGNATURE, TDTS_SIGNATURE].into_iter().find(|line| text.starts_with(line));
    let signature = signature.ok_or_else(|| unsigned(text))?;
    let json = &text[signature.len()..];
    let root: Root = serde_json::from_str(json).map_err(|error| {
        let on_first = if error.line() == 1 { signature.len() } else { 0 };
        let (line, column) = (error.line().max(1), (error.column() + on_first).max(1));
        let words = json_words(&error);
        Error::Sheet {
            place: Some((line, column)),
            message: format!(
                "{words}; if you did not write this by hand, save the sheet again as XDTS"
            ),
            source: Some(error.into()),
        }
    })?;
    let (header, table) = first_table(root).ok_or_else(|| {
        wrong((1, 1), "expected a time table (timeTables), found none; save a sheet with one")
    })?;
    Ok(exchange(header, table, field(signature)))
}

fn unsigned(text: &str) -> Error {
    let found: String = text.lines().next().unwrap_or_default().chars().take(40).collect();
    let message = format!(
        "expected \"{SIGNATURE}\" (XDTS) or \"{TDTS_SIGNATURE}\" (TDTS), found \"{found}\"; \
         export the sheet as XDTS"
    );
    wrong((1, 1), message)
}

fn wrong(place: (usize, usize), message: impl Into<String>) -> Error {
    Error::sheet_at(place, message)
}

fn first_table(root: Root) -> Option<(Option<Header>, TimeTable)> {
    if let Some(table) = root.time_tables.into_iter().next() {
        return Some((root.header, table));
    }
    let sheet = root.time_sheets.into_iter().next()?;
    Some((root.header.or(sheet.header), sheet.time_tables.into_iter().next()?))
}

fn exchange(header: Option<Header>, table: TimeTable, field_id: u32) -> Exchange {
    let length = table.duration as usize;
    let headers = table.time_table_headers.into_iter();
    let names: Vec<String> = headers
        .filter(|header| header.field_id == field_id)
        .flat_map(|header| header.names)
        .collect();
    let name = |track: usize| match names.get(track).map(|name| name.trim()) {
        None | Some("") => column_name(track),
        Some(name) => name.into(),
    };
    let lines = speech::lines(&table.fields, length);
    let fields = table.fields.into_iter().filter(|field| field.field_id == field_id);
    let tracks = fields.flat_map(|field| field.tracks);
    let mut columns: Vec<_> = tracks
        .map(|track| Column {
            track: track.track_no,
            name: name(track.track_no),
            changes: changes(track.frames, length),
        })
        .collect();
    columns.sort_by_key(|column| column.track);
    let number = |number: fn(&Header) -> &String| {
        header.as_ref().map(|header| number(header).clone()).filter(|number| !number.is_empty())
    };
    Exchange {
        name: table.name,
        cut: number(|header| &header.cut),
        scene: number(|header| &header.scene),
        length,
        columns,
        lines,
    }
}

/// What entries change: by koma, those before the cut as what it begins with, of two on one koma the
/// later one, and only what changes.
fn changes(mut entries: Vec<Entry>, length: usize) -> Vec<Change> {
    entries.sort_by_key(|entry| entry.frame);
    let mut changes = vec![Change { koma: 0, mark: Mark::Blank, circled: false }];
    for entry in entries {
        let koma = usize::try_from(entry.frame).unwrap_or(0);
        let Some(mark) = mark(&entry.data[0].values[0]).filter(|_| koma < length) else { continue };
        let circled = entry.data[0].options.iter().any(|option| option == CIRCLED);
        changes.pop_if(|last| last.koma == koma);
        let goes_on = matches!(mark, Mark::Drawing(_) | Mark::Blank);
        match changes.last_mut() {
            Some(last) if goes_on && last.mark == mark => last.circled |= circled,
            _ => changes.push(Change { koma, mark, circled }),
        }
    }
    changes
}

/// None for a sign that what stood before goes on.
fn mark(value: &str) -> Option<Mark> {
    match value {
        CONTINUED => None,
        INBETWEEN => Some(Mark::Inbetween),
        REVERSE => Some(Mark::Reverse),
        BLANK | "" => Some(Mark::Blank),
        drawing => Some(Mark::Drawing(drawing.into())),
    }
}

impl Column {
    /// What stands on each koma of a length: the mark and the koma it was set on.
    pub fn on_koma(&self, length: usize) -> impl Iterator<Item = &Change> + '_ {
        let ends = self.changes.iter().skip(1).map(|change| change.koma).chain([length]);
        self.changes
            .iter()
            .zip(ends)
            .flat_map(|(change, end)| std::iter::repeat_n(change, end.saturating_sub(change.koma)))
    }
}
