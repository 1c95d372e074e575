//! Somebody else's timesheet that the columns of a sheet go into (相手のシート).

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::failure::Failure;
use super::headings::INTO;
use super::{files, paths};
use genga::sheet::Sheet;
use genga_files::xdts::{self, IntoTimesheet, PaperColumn, PutInto};

/// The timesheet, and how the columns go in.
#[derive(Debug, Clone, Args)]
pub(super) struct IntoArgs {
    /// Put the columns into somebody's timesheet: --into c012.xdts (or .tdts)
    ///
    /// A copy with the columns is written to the output folder. Its other columns, lines and camera stay as they are.
    #[arg(long, value_name = "FILE", help_heading = INTO)]
    into: Option<PathBuf>,
    /// Names of the columns there [default: those of the sheet].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', requires = "into", help_heading = INTO)]
    columns: Vec<String>,
    /// Replace columns of these names, drawings and all.
    #[arg(long, requires = "into", help_heading = INTO)]
    replace: bool,
    /// Column for an XDTS: action (numbered keys, marks) or cell (all drawings).
    ///
    /// By default action if it has inbetween marks. A TDTS gets both.
    #[arg(long = "as", value_name = "COLUMN", requires = "into", help_heading = INTO)]
    column: Option<AsColumn>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum AsColumn {
    Action,
    Cell,
}

/// The changed timesheet.
pub(super) struct Filled {
    /// Its file name.
    pub(super) name: String,
    pub(super) bytes: Vec<u8>,
    /// Sentences for the user.
    pub(super) notes: Vec<String>,
}

impl IntoArgs {
    /// The timesheet that the columns go into.
    pub(super) fn file(&self) -> Option<&Path> {
        self.into.as_deref()
    }

    /// Puts the columns of a sheet into the timesheet; `None` if there is none.
    pub(super) fn fill(&self, sheet: &Sheet) -> Result<Option<Filled>, Failure> {
        let Some(path) = self.file() else { return Ok(None) };
        let column = self.column.map(|column| match column {
            AsColumn::Action => PaperColumn::Action,
            AsColumn::Cell => PaperColumn::Cell,
        });
        let into = IntoTimesheet { names: self.columns.clone(), replaces: self.replace, column };
        let PutInto { bytes, mut notes } =
            into.put(&files::read(path)?, sheet).map_err(files::fault_of(path))?;
        notes.extend(xdts::unsaid_rate("into", sheet).map(|note| note.to_string()));
        Ok(Some(Filled { name: paths::file_name(path), bytes, notes }))
    }
}

/// Says what a timesheet holds that is not understood; `None` if nothing.
pub(super) fn unread(bytes: &[u8], path: &Path) -> Result<Option<String>, Failure> {
    let found = xdts::unread(bytes).map_err(files::fault_of(path))?;
    let said =
        format!("of {}, not understood and passed over: {}", path.display(), found.join("; "));
    Ok((!found.is_empty()).then_some(said))
}
