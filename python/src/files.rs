//! Writes sheets in every format.

use genga::edits::Edits;
use genga::error::Warning;
use genga::pipeline::Breakdown;
use genga::recipe::Recipe;
use genga_files::sheet_json::MadeWith;
use genga_files::{Cut, FORMATS, Format, Settings};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Named files in order; `/` in a name makes a folder.
pub type Files = Vec<(String, Vec<u8>)>;

/// The data around a sheet that its files need.
pub struct Handed<'a> {
    pub cut: &'a str,
    pub file: &'a str,
    pub recipe: &'a Recipe,
    pub edits: &'a Edits,
}

impl Handed<'_> {
    /// Returns the files of some formats, identical to the program's, and warnings about them. `go_on` is called
    /// between files; its error ends the writing.
    pub fn files(
        &self,
        breakdown: &Breakdown<'_>,
        (formats, settings): (&[&Format], &Settings),
        mut go_on: impl FnMut() -> Result<(), genga::Error>,
    ) -> Result<(Files, Vec<Warning>), genga::Error> {
        let exaggerate = &self.recipe.exaggerate;
        let cut = Cut {
            name: self.cut,
            clip_file: self.file,
            clip: breakdown.clip,
            exaggerated: (!exaggerate.is_off()).then_some((breakdown.source, exaggerate)),
            sheet: breakdown.sheet,
            spaced: Some(breakdown.spaced),
            splits: &breakdown.actions.koma(breakdown.clock),
            made_with: Some(&MadeWith::new(self.recipe, self.edits, breakdown.sheet)),
        };
        let (mut files, mut notes) = (Files::new(), Vec::new());
        for format in formats {
            notes.extend(format.notes(&cut, settings)?);
            format.write(&cut, settings, &mut |name, bytes| {
                files.push((name.to_owned(), bytes.to_vec()));
                go_on()
            })?;
        }
        Ok((files, notes))
    }
}

/// Lists all formats: dicts with `name`, `help`, `japanese` and `files`.
#[pyfunction]
pub fn formats<'py>(py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let of_one = |format: &Format| {
        let about = PyDict::new(py);
        about.set_item("name", format.name)?;
        about.set_item("help", format.help)?;
        about.set_item("japanese", format.japanese)?;
        about.set_item("files", format.files)?;
        Ok(about)
    };
    FORMATS.iter().map(of_one).collect()
}
