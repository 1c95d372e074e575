//! The tables of all clips: `summary.csv` and `keys.csv`, and apart from them `times.csv`, which differs on every run.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter};
use std::path::Path;

use super::super::console::counted;
use super::super::failure::Failure;
use super::super::staging::Staging;
use super::super::stop;
use super::journal::Journal;
use super::place::foreign;
use super::row::{Line, Row};
use genga::sanitize::cell;

/// The tables, in the order in which they are moved into place.
const FILES: [&str; 3] = ["keys.csv", "times.csv", "summary.csv"];

/// The number of finished clips, and those that failed or lack a format.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Count {
    pub(crate) done: usize,
    /// Clips that were done before the batch began.
    pub(crate) resumed: usize,
    /// The first failures with their reasons, one a line.
    pub(crate) failed: Vec<String>,
    pub(crate) failures: usize,
    /// The first clips of which a format is not made, with the reasons, one a line.
    pub(crate) lacking: Vec<String>,
    pub(crate) lacks: usize,
    /// The first clips with files that a person changed, one a line.
    pub(crate) kept: Vec<String>,
    pub(crate) keeps: usize,
    /// The first clips with notes, one a line.
    pub(crate) noted: Vec<String>,
    pub(crate) notes: usize,
    /// The first finished clips with a warning and how many they are, by its code.
    pub(crate) warned: BTreeMap<String, (Vec<String>, usize)>,
    /// Names of folders that are of no clip.
    pub(crate) left: Vec<String>,
    /// The folder or the archive of an earlier batch, whose clips this one wrote into the other.
    pub(crate) other: Option<&'static str>,
    /// Clips with another motion than that whose files this batch replaced.
    pub(crate) replaced: Vec<String>,
}

/// Most failures listed in full.
pub(crate) const NAMED: usize = 3;

/// Columns of the table of times.
const TIMES: [&str; 4] = ["clip", "read_ms", "draw_ms", "write_ms"];

/// Refuses to write over a table that has not the columns of a batch's, as that of a run or of a person.
pub(crate) fn check(out: &Path) -> Result<(), Failure> {
    let columns = ["clip,cut,".to_owned(), TIMES.join(","), Row::HEADER.join(",")];
    for (path, columns) in FILES.iter().map(|name| out.join(name)).zip(columns) {
        let mut line = String::new();
        let is_read =
            File::open(&path).is_ok_and(|file| BufReader::new(file).read_line(&mut line).is_ok());
        // Without a single key the table of keys is empty.
        let is_ours = match columns.strip_suffix(',') {
            Some(_) => line.is_empty() || line.starts_with(&columns),
            None => line.trim_end() == columns,
        };
        if path.exists() && !(is_read && is_ours) {
            return Err(foreign(&path, "table"));
        }
    }
    Ok(())
}

/// Writes the tables of the named clips, in that order, as far as the journals know them. No table is ever wholly in
/// memory.
pub(crate) fn write<'a>(
    out: &Path,
    journals: &[Journal],
    names: impl Iterator<Item = &'a str>,
) -> Result<Count, Failure> {
    let io = |error: io::Error| Failure::io(out, error);
    let staging = Staging::within(out).map_err(io)?;
    let open = |name: &str| {
        File::create(staging.place(name)).map(BufWriter::new).map(csv::Writer::from_writer)
    };
    let [mut keys, mut times, mut summary] =
        [open(FILES[0]).map_err(io)?, open(FILES[1]).map_err(io)?, open(FILES[2]).map_err(io)?];
    let csv = |error: csv::Error| Failure::io(out, error.into());
    summary.write_record(Row::HEADER).map_err(csv)?;
    times.write_record(TIMES).map_err(csv)?;
    let (mut count, mut has_header) = (Count::default(), false);
    for name in names {
        let Some(line) = line(journals, name)? else { continue };
        count.add(&line);
        write_row(&mut summary, &line.clip, line.row.cells()).map_err(csv)?;
        let ms = line.ms.map(|ms| format!("{ms:.1}"));
        write_row(&mut times, &line.clip, ms).map_err(csv)?;
        copy_keys(&line, &mut keys, &mut has_header).map_err(csv)?;
    }
    for table in [&mut keys, &mut times, &mut summary] {
        table.flush().map_err(io)?;
    }
    drop((keys, times, summary));
    let put =
        || FILES.iter().try_for_each(|name| std::fs::rename(staging.place(name), out.join(name)));
    stop::undisturbed(put).map_err(io)?;
    Ok(count)
}

/// Returns the last line of a clip, from the journal that has it.
pub(crate) fn line(journals: &[Journal], name: &str) -> Result<Option<Line>, Failure> {
    journals.iter().find_map(|journal| journal.line(name).transpose()).transpose()
}

/// Writes a row that begins with the clip's name, with every cell escaped against formula injection.
fn write_row(
    table: &mut csv::Writer<BufWriter<File>>,
    clip: &str,
    cells: impl IntoIterator<Item = String>,
) -> Result<(), csv::Error> {
    table.write_field(&*cell(clip))?;
    cells.into_iter().try_for_each(|text| table.write_field(&*cell(&text)))?;
    table.write_record(None::<&[u8]>)
}

/// Copies the rows of a clip's key table, each after the clip's name. Their cells cannot be formulas.
fn copy_keys(
    line: &Line,
    keys: &mut csv::Writer<BufWriter<File>>,
    has_header: &mut bool,
) -> Result<(), csv::Error> {
    let mut table = csv::ReaderBuilder::new().has_headers(false).from_reader(line.keys.as_bytes());
    for (at, record) in table.records().enumerate() {
        let record = record?;
        match at {
            0 if *has_header => continue,
            0 => keys.write_field("clip")?,
            _ => keys.write_field(&*cell(&line.clip))?,
        }
        *has_header = true;
        keys.write_record(&record)?;
    }
    Ok(())
}

impl Count {
    /// Counts the named clips as far as the journals know them.
    pub(crate) fn of<'a>(
        journals: &[Journal],
        names: impl Iterator<Item = &'a str>,
    ) -> Result<Self, Failure> {
        let mut count = Self::default();
        for name in names {
            line(journals, name)?.iter().for_each(|line| count.add(line));
        }
        Ok(count)
    }

    /// Says what earlier batches left in the folder, and which of their files are of another motion.
    pub(crate) fn of_before(&self, out: &Path) -> Vec<String> {
        let out = out.display();
        let first = |names: &[String]| {
            let more = if names.len() > NAMED { " …" } else { "" };
            let names: Vec<&str> = names.iter().take(NAMED).map(String::as_str).collect();
            format!("{}{more}", names.join(" "))
        };
        let folders = |left: &[String]| {
            let folders = counted(left.len(), "folder");
            format!(
                "{folders} in {out}/clips of no clip of this batch, which stay: {}",
                first(left)
            )
        };
        let replaced = |names: &[String]| {
            let clips = counted(names.len(), "clip");
            format!(
                "{clips} with another motion than before, whose files are replaced: {}",
                first(names)
            )
        };
        let other = |name| format!("{out}/{name} is of an earlier batch, and stays as it was");
        let left = (!self.left.is_empty()).then(|| folders(&self.left));
        let replaced = (!self.replaced.is_empty()).then(|| replaced(&self.replaced));
        left.into_iter().chain(self.other.map(other)).chain(replaced).collect()
    }

    fn add(&mut self, line: &Line) {
        let message = &line.row.message;
        if let Some(files) = line.row.kept() {
            name(&mut self.kept, &mut self.keeps, format!("{}: {files}", line.clip));
        }
        if !line.row.notes.is_empty() {
            let notes = format!("{}: {}", line.clip, line.row.notes.join("; "));
            name(&mut self.noted, &mut self.notes, notes);
        }
        if line.row.is_done() {
            self.done += 1;
            for code in &line.row.warnings {
                let (clips, count) = self.warned.entry(code.clone()).or_default();
                name(clips, count, line.clip.clone());
            }
            if line.row.lacks_formats() {
                name(&mut self.lacking, &mut self.lacks, format!("{}: {message}", line.clip));
            }
        } else {
            name(&mut self.failed, &mut self.failures, message.clone());
        }
    }
}

/// Counts a clip, and lists it if it is among the first.
fn name(first: &mut Vec<String>, count: &mut usize, clip: String) {
    *count += 1;
    if first.len() < NAMED {
        first.push(clip);
    }
}
