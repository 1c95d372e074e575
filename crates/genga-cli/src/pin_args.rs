//! `--pin-from`: keys that a person marked in a file, a table, a sheet or a digital timesheet.

use std::path::{Path, PathBuf};

use super::corrections::Corrections;
use super::failure::Failure;
use super::format_args::Formats;
use super::marked_keys::MarkedKeys;
use super::{files, into_args, paths, sheets};
use genga::edits::Pin;
use genga::error::Error;
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Sheet;
use genga::time::Frame;
use genga_files::sheet_json::SheetFile;
use genga_files::xdts::{self, Column, Exchange, Mark, Numbered};
use genga_files::{Cut, Format, pins_from_sheet, pins_from_table, sheet_json};

/// Reads the keys marked in a file, of a column. `sheet` is that of the run without these keys.
pub(super) fn read(
    (path, column): (&Path, Option<&str>),
    engine: &Engine,
    sheet: &Sheet,
) -> Result<MarkedKeys, Failure> {
    let name = paths::named(path);
    let bytes = files::read(path)?;
    let of_file = files::fault_of(path);
    Ok(match Kind::detect(&name, &bytes) {
        Kind::Timesheet => of_timesheet(&bytes, &name, column, engine.clip(), sheet)?,
        Kind::Table => of_table(name, &bytes, pins_from_table(&bytes, column).map_err(&of_file)?),
        Kind::Sheet => {
            let file = sheet_json::read(&bytes).map_err(&of_file)?;
            check_rate(&file, engine, &name)?;
            MarkedKeys::of_table(name, pins_from_sheet(&file, column).map_err(&of_file)?)
        }
    })
}

/// Rows of a table of keys that are no keys: its head, and the ends of the clip.
const HEAD_AND_ENDS: usize = 3;

/// Notes that a table with more than keys gives keys alone.
fn of_table(path: PathBuf, bytes: &[u8], keys: (Vec<Pin>, String)) -> MarkedKeys {
    let rows = bytes.split(|byte| *byte == b'\n').filter(|row| !row.trim_ascii().is_empty());
    let has_others = rows.count() > keys.0.len() + HEAD_AND_ENDS;
    let note = "from a table only keys are taken, not the timing: genga deliver takes that of a sheet.json";
    let notes = has_others.then(|| note.to_owned()).into_iter().collect();
    MarkedKeys::of_table(path, keys).with_notes(notes)
}

/// Returns the layer that a column's keys belong to: the layer of that name if there are several layers, else all.
pub(super) fn layer<'a>(
    column: &'a str,
    engine: &Engine,
    recipe: &Recipe,
) -> Result<Option<&'a str>, Error> {
    let parts = recipe.layers.split(engine.clip())?;
    let is_one = parts.len() > 1 && parts.iter().any(|part| part.name == column);
    Ok(is_one.then_some(column))
}

/// Refuses to overwrite the marked timesheet, which holds a person's work, and says how to keep it.
pub(super) fn spare(
    args: &Corrections,
    formats: &Formats,
    folder: &Path,
    cut: &str,
) -> Result<(), Failure> {
    let Some(marked) = args.pin_from.as_deref() else { return Ok(()) };
    if formats.writes("xdts") {
        let mut files = Format::find("xdts")?.files.iter();
        if files.any(|file| paths::is_same(marked, &folder.join(Cut::file_of(cut, file)))) {
            return Err(Failure::AskedWrongly(format!(
                "{}: --deliver xdts would write over the sheet you marked; save it under another name, or \
                 write elsewhere with --out",
                marked.display()
            )));
        }
    }
    Ok(())
}

/// The kind of file that keys are marked in.
enum Kind {
    /// XDTS or TDTS.
    Timesheet,
    /// CSV.
    Table,
    /// `sheet.json`.
    Sheet,
}

impl Kind {
    /// Tells the kind by the file's extension, or by its first bytes if the extension is unknown.
    fn detect(name: &Path, bytes: &[u8]) -> Self {
        match paths::ending(name).as_deref() {
            Some("xdts" | "tdts") => Self::Timesheet,
            Some("csv" | "tsv" | "txt") => Self::Table,
            Some("json") => Self::Sheet,
            _ if bytes.trim_ascii_start().starts_with(b"{") => Self::Sheet,
            _ if first_line(bytes).ends_with(b"DigitalTimeSheet Save Data") => Self::Timesheet,
            _ => Self::Table,
        }
    }
}

fn first_line(bytes: &[u8]) -> &[u8] {
    let line = bytes.split(|byte| matches!(byte, b'\r' | b'\n')).next();
    line.unwrap_or_default().trim_ascii()
}

/// Refuses a sheet whose frame rate differs from the clip's: its frame numbers are other moments.
pub(super) fn check_rate(
    file: &sheet_json::SheetFile,
    engine: &Engine,
    name: &Path,
) -> Result<(), Failure> {
    let (sheet, clip) = (file.clip.frame_rate, engine.clip().rate().fps());
    if sheet == clip {
        return Ok(());
    }
    let message = format!(
        "the sheet is for {sheet} frames a second, the clip has {clip}: its frames are other moments here; \
         --fps {sheet} reads the clip so"
    );
    Err(Failure::of_file(name, Error::sheet(message)))
}

/// Reads the keys of a timesheet as the frames that are shown on those koma: by the sheet that lies beside it, else by
/// the sheet that this run makes without them.
fn of_timesheet(
    bytes: &[u8],
    name: &Path,
    column: Option<&str>,
    clip: &Clip,
    sheet: &Sheet,
) -> Result<MarkedKeys, Failure> {
    let file = xdts::read(bytes).map_err(files::fault_of(name))?;
    let column = sheet_column(&file, column, name)?;
    let numbered = numbered(name);
    if xdts::marked_keys(column, numbered).is_empty() {
        return Err(nothing_marked(name, column, numbered));
    }
    let beside = sheet_beside(name, clip, file.length);
    let sheet = beside.as_ref().map_or(sheet, |(_, sheet)| sheet);
    if file.length != sheet.cut_length() {
        return Err(Failure::AskedWrongly(format!(
            "{}: it has {} koma and the sheet of this clip {}, so its keys may stand on other koma here; was \
             the timing edited, or is another part (--trim), place or length (--at, --length) meant?",
            name.display(),
            file.length,
            sheet.cut_length()
        )));
    }
    let keys = xdts::pins(column, numbered, sheet, (clip.first(), clip.last()))
        .map_err(|error| Failure::AskedWrongly(format!("{}: {error}", name.display())))?;
    let has_marks =
        column.changes.iter().any(|change| change.circled || change.mark == Mark::Inbetween);
    let mut notes: Vec<String> = into_args::unread(bytes, name)?.into_iter().collect();
    notes.extend(beside.map(|(path, _)| {
        format!("its marks are read as koma of {}, the sheet beside it", path.display())
    }));
    if numbered == Numbered::Keys && !has_marks {
        notes.push("it has no inbetween marks, so every number on it is a key".into());
    }
    Ok(MarkedKeys::of_timesheet(name.into(), column.name.clone(), keys).with_notes(notes))
}

/// Finds the sheet of the clip that a timesheet of `length` koma was made from, with its path.
fn sheet_beside(timesheet: &Path, clip: &Clip, length: usize) -> Option<(PathBuf, Sheet)> {
    let path = sheets::own_sheet(timesheet)?;
    let file = sheet_json::read(&files::read(&path).ok()?).ok()?;
    let SheetFile { sheet, clip: own, .. } = file;
    let ends = [own.first_frame, own.last_frame()].map(Frame);
    let is_of_clip =
        own.frame_rate == clip.rate().fps() && ends.iter().all(|frame| clip.contains(*frame));
    (is_of_clip && sheet.cut_length() == length).then_some((path, sheet))
}

/// Returns the column asked for, else the only one with a drawing, else column A, as genga names its own.
fn sheet_column<'a>(
    file: &'a Exchange,
    asked: Option<&str>,
    path: &Path,
) -> Result<&'a Column, Failure> {
    let drawn = |column: &&Column| {
        column.changes.iter().any(|change| matches!(change.mark, Mark::Drawing(_)))
    };
    let columns: Vec<&Column> = file.columns.iter().filter(drawn).collect();
    let called = |name: &str| columns.iter().copied().find(|column| column.name == name);
    let found = match (asked, columns.as_slice()) {
        (Some(name), _) => called(name),
        (None, [only]) => Some(*only),
        (None, _) => called("A"),
    };
    found.ok_or_else(|| {
        let names: Vec<_> = columns.iter().map(|column| column.name.as_str()).collect();
        let path = path.display();
        Failure::AskedWrongly(match (names.as_slice(), asked) {
            ([], _) => format!("{path}: no column of it has a drawing"),
            (_, Some(name)) => {
                format!("{path}: there is no column {name}; there are {}", names.join(", "))
            }
            (_, None) => {
                format!("{path}: which column? --pin-column takes one of {}", names.join(", "))
            }
        })
    })
}

/// Tells the numbering by the file name: genga's douga sheets (`_douga`) number every drawing.
fn numbered(path: &Path) -> Numbered {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let is_douga = |stem: String| stem.trim_end_matches("_ts").ends_with("_douga");
    if stem.is_some_and(is_douga) { Numbered::Drawings } else { Numbered::Keys }
}

fn nothing_marked(path: &Path, column: &Column, numbered: Numbered) -> Failure {
    let (path, column) = (path.display(), &column.name);
    Failure::AskedWrongly(match numbered {
        Numbered::Keys => {
            format!("{path}: column {column} has no number, so there is no key to pin")
        }
        Numbered::Drawings => format!(
            "{path}: a douga sheet numbers every drawing, and none in column {column} is circled as a \
             key (OPTION_KEYFRAME); give the _genga_ts.xdts, or mark keys in one written by \
             --with xdts.circled=true"
        ),
    })
}
