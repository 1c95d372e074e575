//! Numbers that stay from run to run (番号): those of the drawings that the sheet in the results folder has too.

use std::path::Path;

use super::files;
use super::folder::Folder;
use super::sheets::SHEET;
use genga::sheet::{Layer, Renumbered, Sheet};
use genga_files::{ClipMark, Run, sheet_json};

/// The sheet of a run with its numbers, and what became of those of the sheet before.
pub(super) struct Numbering {
    pub(super) sheet: Sheet,
    /// The drawings of both sheets; empty if there is nothing to say.
    pub(super) drawings: Vec<Renumbered>,
    /// Why numbers are not kept.
    pub(super) note: Option<String>,
    /// Whether a drawing of the sheet before that is here too has its number, in every layer.
    pub(super) is_kept: bool,
    /// Whether they begin at 1 again.
    is_anew: bool,
}

impl Numbering {
    /// Numbers a sheet from 1, whatever is in the folder.
    pub(super) fn fresh(sheet: &Sheet) -> Self {
        Self { sheet: sheet.clone(), drawings: vec![], note: None, is_kept: false, is_anew: true }
    }

    /// Numbers a sheet of a clip like the one in the folder, or `anew` from 1.
    pub(super) fn new(sheet: &Sheet, folder: &Folder<'_>, clip: &ClipMark, is_anew: bool) -> Self {
        Self::after(sheet, before(folder, clip), is_anew)
    }

    /// Numbers a sheet like the one before, if there is one that can be read, or `anew` from 1.
    pub(super) fn after(
        sheet: &Sheet,
        before: Result<Option<Sheet>, String>,
        is_anew: bool,
    ) -> Self {
        let own = Self::fresh(sheet);
        let before = match before {
            Ok(Some(before)) => before,
            Ok(None) => return own,
            Err(note) => return Self { note: (!is_anew).then_some(note), ..own },
        };
        let Self { mut sheet, .. } = own;
        if !is_anew {
            sheet.keep_numbers(&before);
        }
        let drawings = sheet.compare_numbers(&before);
        let is_plain = is_plain(&sheet);
        let is_same = drawings.iter().all(|drawing| drawing.old == drawing.new);
        let drawings = if is_plain && is_same { vec![] } else { drawings };
        let note = other_joints(&sheet, &before).filter(|_| !is_anew);
        let is_kept = !is_anew && note.is_none();
        Self { sheet, drawings, note, is_kept, is_anew }
    }

    /// Whether the drawings are not 1, 2, 3 …, to keep the numbers of an earlier sheet.
    pub(super) fn has_old_ones(&self) -> bool {
        !is_plain(&self.sheet)
    }

    /// Says how many drawings kept their numbers; `None` if there is nothing to say.
    pub(super) fn counts(&self) -> Option<String> {
        let count = |word: &str| self.drawings.iter().filter(|own| fate(own) == word).count();
        let counts = ["kept", "changed", "gone", "new"].map(|word| (count(word), word));
        let counts = counts.iter().filter(|(count, _)| *count > 0);
        let counts: Vec<String> = counts.map(|(count, word)| format!("{count} {word}")).collect();
        (!counts.is_empty()).then(|| counts.join(", "))
    }

    /// Says the same as a line of the summary, with the table and the way out.
    pub(super) fn line(&self) -> Option<String> {
        let way_out = if self.is_anew { "" } else { "; --renumber begins at 1" };
        let counts = self.counts()?;
        let table = Run::NUMBERS;
        Some(format!("numbers     番号       {counts} ({table} has old and new{way_out})"))
    }
}

/// Reads the sheet in a folder, if there is one, or says why its numbers are no use.
pub(super) fn before(folder: &Folder<'_>, clip: &ClipMark) -> Result<Option<Sheet>, String> {
    let path = folder.path().join(SHEET);
    if path.is_file() && !folder.is_of(clip) {
        return Err(unkept(&path, "is not known to be of this clip"));
    }
    read(&path)
}

/// Reads a sheet of the same clip, if there is one, or says why its numbers are no use.
pub(super) fn read(path: &Path) -> Result<Option<Sheet>, String> {
    if !path.is_file() {
        return Ok(None);
    }
    let unkept = |why: &str| unkept(path, why);
    let file =
        files::read(path).map_err(|failure| unkept(&format!("cannot be read: {failure}")))?;
    let file = sheet_json::read(&file).map_err(|error| unkept(&format!("is no sheet: {error}")))?;
    Ok(Some(file.sheet))
}

fn unkept(sheet: &Path, why: &str) -> String {
    format!("drawings are numbered from 1: {} {why}", sheet.display())
}

fn is_plain(sheet: &Sheet) -> bool {
    sheet.layers.iter().all(Layer::is_plainly_numbered)
}

/// Names the layers that are called as before and have other joints.
fn other_joints(sheet: &Sheet, before: &Sheet) -> Option<String> {
    let is_other = |layer: &&Layer| {
        before.layer_like(layer).is_none()
            && before.layers.iter().any(|other| other.name == layer.name)
    };
    let names: Vec<&str> = sheet.layers.iter().filter(is_other).map(|layer| &*layer.name).collect();
    let names = names.join(", ");
    (!names.is_empty()).then(|| {
        format!("drawings of {names} are numbered from 1: the sheet before had other joints there")
    })
}

/// What became of a drawing and its number.
fn fate(drawing: &Renumbered) -> &'static str {
    match (&drawing.old.drawing, &drawing.new.drawing) {
        (Some(old), Some(new)) if old == new => "kept",
        (Some(_), Some(_)) => "changed",
        (Some(_), None) => "gone",
        (None, _) => "new",
    }
}
