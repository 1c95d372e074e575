//! Reads XDTS into columns. Tolerates the deviations of programs in use.

use super::file::{Entry, Header, Root, TimeTable};
use super::{
    BLANK, CELS, CIRCLED, CONTINUED, INBETWEEN, REVERSE, SIGNATURE, TDTS_CELL, TDTS_SIGNATURE,
    speech,
};
use crate::json_words;
use genga::error::Error;
use genga::sheet::{SpokenLine, column_name};

/// An XDTS or TDTS file: the cels and the dialogue of its first time table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exchange {
    /// Name of the time table, often the full name of the cut.
    pub name: String,
    /// Number of the cut, as text.
    pub cut: Option<String>,
    /// Number of the scene, as text.
    pub scene: Option<String>,
    /// Number of koma.
    pub length: usize,
    /// The columns by track, from back to front.
    pub columns: Vec<Column>,
    /// The dialogue (S), ordered by first koma.
    pub lines: Vec<SpokenLine>,
}

/// A column of cels. Two columns may share a name: they differ by track.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Number of the track, from 0.
    pub track: usize,
    /// Name of the column; derived from its track (A, B, C …) if the file gives none.
    pub name: String,
    /// Its changes by koma. The first is on koma 0, all lie within the length, and no drawing follows itself.
    pub changes: Vec<Change>,
}

/// A mark on a column, which holds from its koma on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// Koma, from 0.
    pub koma: usize,
    /// The mark itself.
    pub mark: Mark,
    /// Whether it is circled as a key: an extension, `OPTION_KEYFRAME`.
    pub circled: bool,
}

/// A mark on a timesheet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Mark {
    /// A drawing, by its number or name.
    Drawing(String),
    /// An inbetween belongs here; the drawing before it stays.
    Inbetween,
    /// Inbetweens belong here in reverse order; the drawing before them stays.
    Reverse,
    /// Blank (カラ): no drawing is shown.
    Blank,
}

/// Reads an XDTS or TDTS file. Accepts a BOM, any line ends and entries in any order, and ignores unknown
/// members.
///
/// # Errors
/// [`Error::Sheet`] with line and column if the file is neither, or is not JSON of that structure.
pub fn read(bytes: &[u8]) -> Result<Exchange, Error> {
    read_field(bytes, |_| CELS)
}

/// Reads an XDTS or TDTS file like [`read`], but takes the CELL column of TDTS, in which every drawing is numbered.
///
/// # Errors
/// The errors of [`read`].
pub fn read_cells(bytes: &[u8]) -> Result<Exchange, Error> {
    read_field(bytes, |signature| if signature == TDTS_SIGNATURE { TDTS_CELL } else { CELS })
}

/// Reads the field that `field` selects for the file's signature.
pub(super) fn read_field(bytes: &[u8], field: impl Fn(&str) -> u32) -> Result<Exchange, Error> {
    let (signature, json) = signed(bytes)?;
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

/// Splits a file into its signature and the JSON after it, which is the end of the bytes.
pub(super) fn signed(bytes: &[u8]) -> Result<(&'static str, &str), Error> {
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
    Ok((signature, &text[signature.len()..]))
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

/// The changes in a track's entries, by koma. Entries before the cut count as koma 0, the later of two on one koma
/// wins, and repetitions of the same drawing are dropped.
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

/// Parses a value; `None` for the sign that continues the mark before.
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
    /// The change in effect on each koma of a length, with the koma it was set on.
    pub fn on_koma(&self, length: usize) -> impl Iterator<Item = &Change> + '_ {
        let ends = self.changes.iter().skip(1).map(|change| change.koma).chain([length]);
        self.changes
            .iter()
            .zip(ends)
            .flat_map(|(change, end)| std::iter::repeat_n(change, end.saturating_sub(change.koma)))
    }
}
