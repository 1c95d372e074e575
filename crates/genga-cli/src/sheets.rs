//! Sheets that people name: a sheet.json, a results folder with one, or a timesheet of all drawings (XDTS, TDTS).

use std::path::{Path, PathBuf};

use super::console::Words;
use super::failure::Failure;
use super::{files, into_args, paths};
use genga::sheet::{Layer, Sheet};
use genga_files::sheet_json::{self, SheetFile};
use genga_files::xdts;

/// File name of the sheet in a results folder, which a person may have edited.
pub(super) const SHEET: &str = "sheet.json";

/// Message for a table, from which no timing is read.
const OF_TABLES: &str = "a table is no sheet: a sheet is a sheet.json, or a timesheet of all drawings (XDTS such as \
                         CUT_douga_ts.xdts, TDTS), and timing comes back by these; from a table come keys alone, by \
                         genga run --pin-from";

/// Whether a file is a table, by its name.
fn is_table(path: &Path) -> bool {
    matches!(paths::ending(path).as_deref(), Some("csv" | "tsv" | "txt"))
}

/// Returns the file of a sheet: that in a results folder, or the file itself.
pub(super) fn file_of(path: &Path) -> Result<PathBuf, Failure> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    let file = path.join(SHEET);
    if file.is_file() {
        return Ok(file);
    }
    let path = path.display();
    Err(Failure::AskedWrongly(format!(
        "{path}: there is no sheet.json in this folder; name a results folder of genga run, or a sheet"
    )))
}

/// Says that the sheet.json of a folder has another timing than a sheet that is delivered into it, and so has what the
/// run wrote there. `from` is the file of that sheet.
pub(super) fn of_another_timing(folder: &Path, from: &Path, sheet: &Sheet) -> Option<String> {
    let own = folder.join(SHEET);
    // A sheet has its own timing.
    if paths::is_same(from, &own) {
        return None;
    }
    let own = sheet_json::read(&files::read(&own).ok()?).ok()?.sheet;
    let timing = |sheet: &Sheet| -> Vec<Vec<_>> { sheet.layers.iter().map(shown).collect() };
    (timing(&own) != timing(sheet)).then(|| {
        "what is not written now keeps the timing of the sheet.json in this folder; --out DIR gives this timing a folder \
         of its own"
            .into()
    })
}

/// The place in the source and the koma of each exposure of a layer.
fn shown(layer: &Layer) -> Vec<(f64, usize)> {
    let place = |drawing: usize| layer.drawings[drawing].source.place();
    layer.exposures.iter().map(|shown| (place(shown.drawing), shown.koma)).collect()
}

/// Reads a sheet. The drawings of a timesheet are those of the sheet.json that is named, or that lies beside it or up
/// to two folders above; if there is none, the error ends with `way_out`.
pub(super) fn read(
    path: &Path,
    (drawings, way_out): (Option<&Path>, &str),
    words: &Words,
) -> Result<SheetFile, Failure> {
    let path = &*file_of(path)?;
    let (bytes, of_sheet) = (files::read(path)?, files::fault_of(path));
    if !xdts::is_timesheet(&bytes) {
        if drawings.is_some() {
            let message = "--drawings belongs to a timesheet, XDTS or TDTS, and this is none";
            return Err(Failure::AskedWrongly(message.into()));
        }
        return sheet_json::read(&bytes).map_err(|error| match is_table(path) {
            true => Failure::AskedWrongly(format!("{}: {OF_TABLES}", paths::named(path).display())),
            false => of_sheet(error),
        });
    }
    let timesheet = xdts::read_cells(&bytes).map_err(&of_sheet)?;
    let found =
        drawings.map(file_of).transpose()?.or_else(|| own_sheet(path)).ok_or_else(|| {
            Failure::AskedWrongly(format!(
                "{}: a timesheet has numbers alone, and no sheet.json is beside it: {way_out}",
                path.display()
            ))
        })?;
    let file = sheet_json::read(&files::read(&found)?).map_err(files::fault_of(&found))?;
    words.say(format_args!("drawings    動画       those of {}", found.display()));
    let unread = into_args::unread(&bytes, path)?;
    unread.iter().for_each(|said| words.say(format_args!("note        {said}")));
    let names: Vec<&str> = file.sheet.layers.iter().map(|layer| &*layer.name).collect();
    let columns = timesheet.columns.iter().map(|column| &*column.name);
    let others: Vec<&str> = columns.filter(|name| !names.contains(name)).collect();
    if timesheet.columns.len() > 1 && !others.is_empty() {
        words.say(format_args!(
            "note        columns of no layer of the sheet, passed over: {}",
            others.join(", ")
        ));
    }
    let sheet = xdts::retimed(&timesheet, &file.sheet).map_err(of_sheet)?;
    Ok(SheetFile { sheet, ..file })
}

/// Finds the sheet.json that a timesheet was made from: beside it, or up to two folders above, as in a cut folder.
pub(super) fn own_sheet(timesheet: &Path) -> Option<PathBuf> {
    near(timesheet).map(|folder| folder.join(SHEET)).find(|file| file.is_file())
}

/// The folders that a file belongs to: its own, and two above.
pub(super) fn near(file: &Path) -> impl Iterator<Item = &Path> {
    beside(file).ancestors().take(3)
}

/// The folder that contains a file.
pub(super) fn beside(file: &Path) -> &Path {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}
