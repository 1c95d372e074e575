//! Keys marked on a digital timesheet.

use std::path::Path;

use super::super::asked::Asked;
use super::super::failure::Failure;
use super::super::io;
use super::Marked;
use crate::deliver::xdts::{self, Column, Exchange, Mark, Numbered};
use crate::deliver::{Cut, Format};
use crate::edits::Edits;
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// The keys of a timesheet, on the frames that the clip's sheet has there.
pub(super) fn marked(
    bytes: &[u8],
    name: &Path,
    column: Option<&str>,
    engine: &mut Engine,
    (recipe, edits): (&Recipe, &Edits),
) -> Result<Marked, Failure> {
    let file = xdts::read(bytes).map_err(|error| Failure::of_file(name, error))?;
    let column = self::column(&file, column, name)?;
    let numbered = numbered(name);
    if xdts::marked_keys(column, numbered).is_empty() {
        return Err(nothing_marked(name, column, numbered));
    }
    let frames = (engine.clip().first(), engine.clip().last());
    // The sheet as it is without them: they may be the only keys.
    let before = Edits { only_pins: false, ..edits.clone() };
    let sheet = engine.run(recipe, &before)?.sheet;
    if file.length != sheet.length() {
        return Err(Failure::AskedWrongly(format!(
            "{}: it has {} koma and the sheet of this clip {}, so its keys may stand on other koma here; was \
             the timing edited, or is another part (--trim) meant?",
            name.display(),
            file.length,
            sheet.length()
        )));
    }
    let pins = xdts::pins(column, numbered, sheet, frames)
        .map_err(|error| Failure::AskedWrongly(format!("{}: {error}", name.display())))?;
    let has_marks = column.cells.iter().any(|cell| cell.circled || cell.mark == Mark::Inbetween);
    let mut notes = Vec::new();
    if numbered == Numbered::Keys && !has_marks {
        notes.push("it has no inbetween marks, so every number on it is a key".into());
    }
    Ok(Marked { pins, column: column.name.clone(), notes })
}

/// Refuses to write over the marked sheet: a person's work is in it.
pub(super) fn spare(marked: &Path, asked: &Asked, folder: &Path, cut: &str) -> Result<(), Failure> {
    if !asked.writes("xdts") {
        return Ok(());
    }
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
