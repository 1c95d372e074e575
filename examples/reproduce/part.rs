//! The results of one part of the program for a page: tables, pictures, and numbers for the prose.

use std::fmt::Display;

use crate::table::Table;

/// Tables, pictures and numbers by name.
#[derive(Default)]
pub(crate) struct Part {
    /// Tables: Markdown between `<!-- made: NAME -->` and `<!-- end -->`.
    pub(crate) tables: Vec<(String, String)>,
    /// Tables with times, which differ on each machine and each run.
    pub(crate) measured: Vec<(String, String)>,
    /// Pictures by file name, in the page's folder.
    pub(crate) pictures: Vec<(String, String)>,
    /// Numbers of the prose, which stand before `<!--=NAME-->`.
    pub(crate) numbers: Vec<(String, String)>,
}

impl Part {
    /// Adds a table.
    pub(crate) fn table(&mut self, name: &str, table: Table) {
        self.text(name, table.text());
    }

    /// Adds Markdown that is not a single table.
    pub(crate) fn text(&mut self, name: &str, text: String) {
        self.tables.push((name.into(), text));
    }

    /// Adds a table with times. A check compares only its first column.
    pub(crate) fn measured(&mut self, name: &str, table: Table) {
        self.measured.push((name.into(), table.text()));
    }

    /// Adds an SVG picture, `NAME.svg`.
    pub(crate) fn picture(&mut self, name: &str, svg: String) {
        self.pictures.push((format!("{name}.svg"), svg));
    }

    /// Adds a number for the prose.
    pub(crate) fn number(&mut self, name: &str, value: impl Display) {
        self.numbers.push((name.into(), value.to_string()));
    }

    /// Adds all results of another part.
    pub(crate) fn join(&mut self, other: Self) {
        self.tables.extend(other.tables);
        self.measured.extend(other.measured);
        self.pictures.extend(other.pictures);
        self.numbers.extend(other.numbers);
    }
}
