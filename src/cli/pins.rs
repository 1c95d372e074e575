//! `--pin-from`: keys that a person marked on a timesheet.

use std::path::Path;

use super::args::Corrections;
use super::asked::Asked;
use super::failure::Failure;
use super::io;
use super::words::counted;
use crate::deliver::xdts::{self, Column, Exchange, Mark, Numbered};
use crate::deliver::{Cut, Format};
use crate::edits::Edits;
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// Adds the keys marked in the file of `--pin-from` to the corrections, and says so in sentences. Pins
/// given otherwise go first: of two on one koma theirs stays.
pub(super) fn marked(
    args: &Corrections,
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &mut Edits,
) -> Result<Vec<String>, Failure> {
    let Some(path) = &args.pin_from else { return Ok(vec![]) };
    let name = io::named(path);
    let file = xdts::read(&io::read(path)?).map_err(|error| Failure::of_file(&name, error))?;
    let column = column(&file, args.pin_column.as_deref(), &name)?;
    let numbered = numbered(&name);
    let count = xdts::marked_keys(column, numbered).len();
    if count == 0 {
        return Err(nothing_marked(&name, column, numbered));
    }
    let frames = (engine.clip().first(), engine.clip().last());
    let sheet = engine.run(recipe, edits)?.sheet;
    if file.length != sheet.length() {
        return Err(Failure::AskedWrongly(format!(
            "{}: it has {} koma and the sheet of this clip {}, so its keys may stand on other koma here; was \
             the timing edited, or is another part (--trim) meant?",
            name.display(),
            file.length,
            sheet.length()
        )));
    }
    let clock = sheet.clock;
    let pins = xdts::pins(column, numbered, sheet, frames)
        .map_err(|error| Failure::AskedWrongly(format!("{}: {error}", name.display())))?;
    let mut pinned = 0;
    for pin in pins {
        let koma = |frame: usize| clock.koma_from_place(frame as f64);
        let taken = |other: &crate::edits::Pin| koma(other.frame.0) == koma(pin.frame.0);
        if !edits.pins.iter().any(taken) {
            edits.pins.push(pin);
            pinned += 1;
        }
    }
    let mut notes = vec![format!(
        "pinned from {}: {} of column {}",
        name.display(),
        counted(pinned, "key"),
        column.name
    )];
    if pinned < count {
        let others = counted(count - pinned, "other");
        notes.push(format!("{others} marked there gave way to pins on the same koma"));
    }
    let has_marks = column.cells.iter().any(|cell| cell.circled || cell.mark == Mark::Inbetween);
    if numbered == Numbered::Keys && !has_marks {
        notes.push("it has no inbetween marks, so every number on it is a key".into());
    }
    Ok(notes)
}

/// Refuses to write over the marked sheet: a person's work is in it.
pub(super) fn spare(
    args: &Corrections,
    asked: &Asked,
    folder: &Path,
    cut: &str,
) -> Result<(), Failure> {
    let Some(marked) = args.pin_from.as_ref().filter(|_| asked.writes("xdts")) else {
        return Ok(());
    };
    let files = Format::find("xdts")?.files;
    if files.iter().any(|file| io::is_same(marked, &folder.join(Cut::file_of(cut, file)))) {
        return Err(Failure::AskedWrongly(format!(
            "{}: --deliver xdts would write over the sheet you marked; save it under another name, or \
             write elsewhere with --out",
            marked.display()
        )));
    }
    Ok(())
}

/// The column that is asked for, else the only one that has a drawing, else the one called A as ours.
fn column<'a>(file: &'a Exchange, asked: Option<&str>, path: &Path) -> Result<&'a Column, Failure> {
    let drawn =
        |column: &&Column| column.cells.iter().any(|cell| matches!(cell.mark, Mark::Drawing(_)));
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

/// A file by the name that genga gives to douga sheets has a number on every drawing.
fn numbered(path: &Path) -> Numbered {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    if stem.is_some_and(|stem| stem.ends_with("_douga")) {
        Numbered::Drawings
    } else {
        Numbered::Keys
    }
}

fn nothing_marked(path: &Path, column: &Column, numbered: Numbered) -> Failure {
    let (path, column) = (path.display(), &column.name);
    Failure::AskedWrongly(match numbered {
        Numbered::Keys => {
            format!("{path}: column {column} has no number, so there is no key to pin")
        }
        Numbered::Drawings => format!(
            "{path}: a douga sheet numbers every drawing, and none in column {column} is circled as a \
             key (OPTION_KEYFRAME); give the _genga.xdts, or mark keys in one written by \
             --with xdts.circled=true"
        ),
    })
}
