//! Writes a sheet as XDTS.

use std::io;

use serde::{Deserialize, Serialize};
use serde_json::ser::{CompactFormatter, Formatter, Serializer};

use super::file::{Datum, Entry, Field, Header, Names, Root, TimeTable, Track};
use super::{BLANK, CELS, CIRCLED, EXTENDED, INBETWEEN, SIGNATURE, speech};
use genga::error::{Error, Warning};
use genga::knob::{knob, knobs};
use genga::sheet::{Layer, Sheet, column_name};
use genga::slate::Slate;

/// Settings of a sheet as XDTS version 5.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Xdts {
    /// Whether the douga file marks which numbers are keys; default no. It is an extension of OpenToonz,
    /// which other programs may be unable to read.
    pub circled: bool,
}

knobs!(xdts::Xdts {
    circled: knob(
        "丸囲みの原画",
        "Whether the douga file marks the numbers of keys. This is an OpenToonz extension; other \
         programs may not read the file.",
        "動画のファイルに原画の番号の印を付けるか。OpenToonzの拡張で、読めないソフトもある。",
    ),
});

/// The two XDTS files of a sheet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct XdtsPair {
    /// The file for the ACTION column: keys and ends numbered as in `keys.csv`, and a mark per inbetween.
    pub genga: String,
    /// The file for the CELL column: every drawing numbered as in `drawings.csv`.
    pub douga: String,
}

/// A column of the paper, as a field of a time table.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Column {
    /// ACTION: keys are numbered; an inbetween is a mark, or is left out.
    Genga { has_marks: bool },
    /// CELL: every drawing is numbered, and keys may be circled.
    Douga { has_circles: bool },
}

impl Xdts {
    /// Writes the sheet as two files, with one track per layer in the sheet's order, from back to front. The header
    /// has the numbers of cut and scene if both are known, from the sheet's slate or else from the name `cut`; the time
    /// table has the whole name. Blank koma are null cells.
    ///
    /// # Errors
    /// [`Error::Sheet`] for a sheet without koma, and as [`Sheet::check`].
    pub fn write(&self, sheet: &Sheet, cut: &str) -> Result<XdtsPair, Error> {
        checked(sheet)?;
        Ok(XdtsPair {
            genga: text(SIGNATURE, &self.file(sheet, cut, Column::Genga { has_marks: true }))?,
            douga: text(
                SIGNATURE,
                &self.file(sheet, cut, Column::Douga { has_circles: self.circled }),
            )?,
        })
    }

    fn file(&self, sheet: &Sheet, cut: &str, column: Column) -> Root {
        let extended = column == Column::Douga { has_circles: true };
        Root {
            header: header(&slate(sheet, cut)),
            subversion: extended.then(|| EXTENDED.into()),
            time_tables: vec![time_table(sheet, cut, &[(CELS, column)])],
            time_sheets: vec![],
            version: 5,
        }
    }
}

/// What a person should know of a sheet's files.
pub(crate) fn notes(sheet: &Sheet) -> Vec<Warning> {
    let unsaid = unsaid_rate("xdts", sheet).into_iter();
    unsaid.chain(long_numbers(sheet)).collect()
}

/// Says if there are numbers that OpenToonz reads only on request.
fn long_numbers(sheet: &Sheet) -> Option<Warning> {
    let numbers = sheet.layers.iter().flat_map(Layer::numbers);
    let long = numbers.filter(|number| number.letters().len() > 1).map(|number| number.to_string());
    let long: Vec<String> = long.collect();
    let message = format!(
        "OpenToonz reads {} only if the project's settings of file paths allow more than one letter",
        long.join(" ")
    );
    (!long.is_empty()).then(|| Warning::new("W_LONG_NUMBERS", message))
}

/// Says that a timesheet does not hold the rate of a sheet that is not on 24 koma a second, for which people take it.
pub fn unsaid_rate(format: &str, sheet: &Sheet) -> Option<Warning> {
    let rate = sheet.clock.koma_rate;
    let message = format!(
        "{format}: the file does not hold the rate of {rate} koma a second, and 24 are usual: set it in the program"
    );
    (rate != 24.0).then(|| Warning::new("W_RATE_UNSAID", message))
}

/// The time table of a sheet: a field per column of the paper, with a track per layer, and a field of dialogue if any.
pub(super) fn time_table(sheet: &Sheet, cut: &str, columns: &[(u32, Column)]) -> TimeTable {
    let names = sheet.layers.iter().enumerate().map(|(track, layer)| name(track, &layer.name));
    let names: Vec<String> = names.collect();
    let field = |&(field_id, column): &(u32, Column)| {
        let tracks = sheet.layers.iter().enumerate();
        let tracks = tracks
            .map(|(track_no, layer)| Track { frames: entries(sheet, layer, column), track_no });
        Field { field_id, tracks: tracks.collect() }
    };
    let named = |&(field_id, _): &(u32, Column)| Names { field_id, names: names.clone() };
    let (spoken, spoken_names) = speech::field(&sheet.lines).unzip();
    let (camera, camera_names) = speech::camera_field(&sheet.camera).unzip();
    TimeTable {
        duration: sheet.cut_length() as u64,
        fields: columns.iter().map(field).chain(spoken).chain(camera).collect(),
        name: cut.into(),
        time_table_headers: columns
            .iter()
            .map(named)
            .chain(spoken_names)
            .chain(camera_names)
            .collect(),
    }
}

/// The changes of a layer as entries: a blank before its first koma, if it enters late, and one after its last.
pub(super) fn entries(sheet: &Sheet, layer: &Layer, column: Column) -> Vec<Entry> {
    let (numbers, genga) = (layer.numbers(), layer.genga_numbers());
    let before = sheet.blank.before;
    let mut entries = Vec::new();
    if before > 0 {
        entries.push(entry(0, BLANK.into(), false));
    }
    for (koma, drawing) in layer.changes() {
        let (koma, key) = (before + koma, &genga[drawing]);
        match (column, key) {
            (Column::Genga { .. }, Some(number)) => {
                entries.push(entry(koma, number.to_string(), false));
            }
            (Column::Genga { has_marks: true }, None) => {
                entries.push(entry(koma, INBETWEEN.into(), false));
            }
            (Column::Genga { has_marks: false }, None) => {}
            (Column::Douga { has_circles }, _) => {
                let number = numbers[drawing].to_string();
                entries.push(entry(koma, number, has_circles && key.is_some()));
            }
        }
    }
    entries.push(entry(before + layer.length(), BLANK.into(), false));
    entries
}

/// Rejects sheets from which no time table can be made.
pub(super) fn checked(sheet: &Sheet) -> Result<(), Error> {
    if sheet.length() == 0 {
        return Err(Error::sheet("the sheet has no koma, and a time table needs one"));
    }
    sheet.check()
}

fn entry(koma: usize, value: String, circled: bool) -> Entry {
    let options = if circled { vec![CIRCLED.into()] } else { vec![] };
    Entry { data: vec![Datum { id: 0, options, values: vec![value] }], frame: koma as i64 }
}

/// A column name that programs accept: never empty, and never `S0` to `S9`, which Clip Studio takes for
/// sound.
pub(crate) fn name(track: usize, name: &str) -> String {
    let is_sound = |name: &str| {
        name.strip_prefix(['S', 's'])
            .is_some_and(|rest| matches!(rest.as_bytes(), [digit] if digit.is_ascii_digit()))
    };
    match name.trim() {
        "" => column_name(track),
        name if is_sound(name) => format!("cel_{name}"),
        name => name.into(),
    }
}

/// The slate of a sheet, completed from the name of its cut.
pub(super) fn slate(sheet: &Sheet, cut: &str) -> Slate {
    sheet.slate.clone().over(Slate::from_name(cut))
}

/// The numbers of cut and scene, with 1 to 4 digits as the format requires. `None` unless both are known: no number is
/// better than a wrong one.
pub(super) fn header(slate: &Slate) -> Option<Header> {
    slate.numbers().map(|(cut, scene)| Header { cut, scene, episode: String::new() })
}

pub(super) fn text(signature: &str, file: &Root) -> Result<String, Error> {
    let mut bytes = format!("{signature}\n").into_bytes();
    // Number of lists around an entry: time tables, fields, tracks and frames, plus the time sheets if used.
    let entries = if file.time_sheets.is_empty() { 4 } else { 5 };
    let mut writer = Serializer::with_formatter(&mut bytes, LineAnEntry { lists: 0, entries });
    file.serialize(&mut writer)
        .map_err(|error| Error::Encoding { what: "the time table", source: error.into() })?;
    bytes.push(b'\n');
    Ok(String::from_utf8(bytes).expect("JSON is text"))
}

/// Compact JSON with a line per track entry, so that a person can read and compare it.
struct LineAnEntry {
    /// Number of open lists.
    lists: usize,
    /// Number of open lists around an entry.
    entries: usize,
}

impl Formatter for LineAnEntry {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.lists += 1;
        CompactFormatter.begin_array(writer)
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.lists -= 1;
        CompactFormatter.end_array(writer)
    }

    fn begin_array_value<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        CompactFormatter.begin_array_value(writer, first)?;
        if self.lists == self.entries { writer.write_all(b"\n") } else { Ok(()) }
    }
}
