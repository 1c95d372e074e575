//! Builds the list of clips from files, folders, patterns, lists and tables, in the order in which they are named.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use clap::{Arg, Args, Command, CommandFactory};
use walkdir::WalkDir;

use super::super::commands;
use super::super::failure::Failure;
use super::super::files;
use super::super::paths::{self, is_motion};
use super::super::plan::PlanArgs;
use super::super::shell::quoted;
use super::own_results::{is_in_batch, is_result, is_results};
use genga::error::did_you_mean;
use genga::recipe::{Knob, unknown_beside};
use genga::sanitize::is_hidden;
use genga_files::delimiter;
use genga_read::Format;

/// A clip of a batch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Item {
    /// Path of the file.
    pub(crate) path: PathBuf,
    /// Name, unique in the list: the path without the folders common to all, separated by `/`.
    pub(crate) name: String,
    pub(crate) own: Own,
    /// Bytes of the file, 0 if it does not exist.
    pub(crate) size: u64,
}

/// The options of a clip alone.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Own {
    /// The options as on the command line.
    pub(crate) words: Vec<String>,
    /// The table and the line that they are from: `table.csv:3`.
    pub(crate) row: String,
}

impl Own {
    /// Whether an option is among them.
    pub(crate) fn has(&self, option: &str) -> bool {
        let is_it = |word: &String| {
            word.strip_prefix("--").and_then(|word| word.split('=').next()) == Some(option)
        };
        self.words.iter().any(is_it)
    }
}

/// A clip's path and its own options.
type Named = (PathBuf, Own);

/// All clips of a batch.
pub(crate) struct Clips {
    pub(crate) items: Vec<Item>,
    /// Results of genga among them, folders or files, which were left out.
    pub(crate) skipped: Vec<String>,
}

/// Returns all named clips. Folders are walked in order of name; `out` and the results of genga are left out.
pub(crate) fn clips(words: &[String], out: &Path) -> Result<Clips, Failure> {
    let mut walk = Walk { out: fs::canonicalize(out).ok(), skipped: Vec::new() };
    let mut named = Vec::new();
    for word in words {
        named.extend(of_word(word, &mut walk)?);
    }
    let skipped: Vec<String> = walk.skipped.iter().map(|path| path.display().to_string()).collect();
    if named.is_empty() {
        let (words, but) = (words.join(" "), if skipped.is_empty() { "" } else { BUT_RESULTS });
        return Err(Failure::AskedWrongly(format!(
            "there is no clip in {words}{but}: name motion files or folders of them"
        )));
    }
    Ok(Clips { items: called(named), skipped })
}

/// Name of the list on stdin in messages.
const STDIN: &str = "stdin";

/// Part of the message if all that was found are results.
const BUT_RESULTS: &str = ", only results of genga";

/// Finds clips in folders.
struct Walk {
    /// The real path of the output folder, if it exists.
    out: Option<PathBuf>,
    skipped: Vec<PathBuf>,
}

fn of_word(word: &str, walk: &mut Walk) -> Result<Vec<Named>, Failure> {
    if word == "-" {
        let mut bytes = Vec::new();
        let read = io::stdin().lock().read_to_end(&mut bytes);
        read.map_err(|error| Failure::io(Path::new(STDIN), error))?;
        return lined(&bytes, Path::new(STDIN));
    }
    if let Some(list) = word.strip_prefix('@') {
        return of_list(Path::new(list));
    }
    let path = Path::new(word);
    if path.is_dir() {
        return match walk.is_out(path) {
            true => Err(is_out(path)),
            false => walk.folder(path),
        };
    }
    if path.is_file() && is_table(path) {
        return Err(Failure::AskedWrongly(format!(
            "{word}: is a list of clips and no motion; @{word} takes what it names"
        )));
    }
    if !path.exists() && word.contains(['*', '?', '[']) {
        return walk.pattern(word);
    }
    match path.exists() {
        true => Ok(vec![(path.into(), Own::default())]),
        false => Err(Failure::io(path, io::ErrorKind::NotFound.into())),
    }
}

/// Whether a file is a list or a table by its name.
fn is_table(path: &Path) -> bool {
    let ending = paths::ending(path);
    matches!(ending.as_deref(), Some("csv" | "tsv" | "txt" | "jsonl" | "ndjson"))
}

/// The failure of an output folder that is named as one of clips.
fn is_out(path: &Path) -> Failure {
    Failure::AskedWrongly(format!(
        "{}: is the folder of --out, whose files are left out; name another folder with --out, as one in it",
        path.display()
    ))
}

/// Parses a list with one file per line; empty lines and lines that begin with # are skipped. Paths are the system's
/// raw bytes.
fn lined(bytes: &[u8], list: &Path) -> Result<Vec<Named>, Failure> {
    let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
    let lines = bytes.split(|byte| *byte == b'\n');
    let lines = lines.map(|line| line.strip_suffix(b"\r").unwrap_or(line));
    let lines = lines.filter(|line| !line.trim_ascii().is_empty() && !line.starts_with(b"#"));
    let path = |line| path_of(line).ok_or_else(|| not_utf8(list));
    if let Some(format) = Format::of_motion(bytes) {
        let first = lines.clone().next().map(path).transpose()?;
        if first.is_none_or(|first| !first.exists()) {
            return Err(no_list(list, format));
        }
    }
    lines.map(|line| Ok((path(line)?, Own::default()))).collect()
}

/// The failure of a motion in the place of a list.
fn no_list(list: &Path, format: &Format) -> Failure {
    let run = if list == Path::new(STDIN) { Path::new("-") } else { list };
    Failure::AskedWrongly(format!(
        "{}: begins as a motion ({}) and is no list of files; genga run {} takes it",
        list.display(),
        format.name,
        quoted(&run.display().to_string())
    ))
}

#[cfg(unix)]
fn path_of(bytes: &[u8]) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStrExt;
    Some(std::ffi::OsStr::from_bytes(bytes).into())
}

#[cfg(not(unix))]
fn path_of(bytes: &[u8]) -> Option<PathBuf> {
    std::str::from_utf8(bytes).ok().map(PathBuf::from)
}

fn not_utf8(list: &Path) -> Failure {
    Failure::CouldNot(format!("{}: is not UTF-8; save the list as UTF-8", list.display()))
}

/// Writes the list as text that [`lined`] can read.
pub(crate) fn written(items: &[Item]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for item in items {
        bytes.extend_from_slice(item.path.as_os_str().as_encoded_bytes());
        bytes.push(b'\n');
    }
    bytes
}

fn of_list(list: &Path) -> Result<Vec<Named>, Failure> {
    let bytes = files::read(list)?;
    let ending = list.extension().map(|ending| ending.to_ascii_lowercase());
    let ending = ending.as_ref().and_then(|ending| ending.to_str());
    if !matches!(ending, Some("csv" | "jsonl" | "ndjson")) {
        return lined(&bytes, list);
    }
    let text = String::from_utf8(bytes).map_err(|_| not_utf8(list))?;
    let text = text.trim_start_matches('\u{feff}');
    let table = if ending == Some("csv") { of_table(text) } else { of_objects(text) };
    let row = |line: usize| format!("{}:{line}", list.display());
    let rows = table
        .map_err(|(line, reason)| Failure::AskedWrongly(format!("{}: {reason}", row(line))))?;
    let named = |(line, path, words)| (path, Own { words, row: row(line) });
    Ok(rows.into_iter().map(named).collect())
}

/// The line of a clip in a table, its path and its options.
type Row = (usize, PathBuf, Vec<String>);

/// Parses a CSV table with a column `clip` and columns named like options. Fields are separated by commas, semicolons or
/// tabs.
fn of_table(text: &str) -> Result<Vec<Row>, (usize, String)> {
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.delimiter(delimiter(text)).trim(csv::Trim::All);
    let mut reader = reader.from_reader(text.as_bytes());
    let options = Options::new();
    let fault = |error: csv::Error| {
        let reason = match error.kind() {
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } => format!(
                "{len} cells, and the table has {expected_len} columns; a cell with a comma needs quotes"
            ),
            _ => error.to_string(),
        };
        (error.position().map_or(1, |place| place.line() as usize), reason)
    };
    let header = reader.headers().map_err(fault)?.clone();
    if !header.iter().any(|name| name == CLIP) {
        return Err((1, NO_CLIP.into()));
    }
    header.iter().try_for_each(|name| options.check(name)).map_err(|reason| (1, reason))?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(fault)?;
        let line = record.position().map_or(1, |place| place.line() as usize);
        let cells = header.iter().zip(&record);
        let cells = cells.map(|(name, cell)| (name.to_owned(), cell.to_owned())).collect();
        let (path, words) = options.row(cells).map_err(|reason| (line, reason))?;
        rows.push((line, path, words));
    }
    Ok(rows)
}

/// Parses JSON Lines: one object per clip.
fn of_objects(text: &str) -> Result<Vec<Row>, (usize, String)> {
    let options = Options::new();
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let object = |(at, line): (usize, &str)| {
        let read: Result<serde_json::Map<String, serde_json::Value>, _> =
            serde_json::from_str(line);
        let object = read.map_err(|error| (at + 1, error.to_string()))?;
        let cells = object.iter().flat_map(|(name, value)| cells_of(name, value)).collect();
        let row = options.row(cells).map(|(path, words)| (at + 1, path, words));
        row.map_err(|reason| (at + 1, reason))
    };
    lines.map(object).collect()
}

/// The cells of a member of an object. One that is an object has a cell for each of its own: `{"set": {"spacing.on": 3}}`
/// is `set.spacing.on`.
fn cells_of(name: &str, value: &serde_json::Value) -> Vec<(String, String)> {
    match value {
        serde_json::Value::Object(members) => {
            let inside = members.iter();
            inside.flat_map(|(own, value)| cells_of(&format!("{name}.{own}"), value)).collect()
        }
        plain => vec![(name.to_owned(), word_of(plain))],
    }
}

/// Formats a JSON value as on the command line.
fn word_of(value: &serde_json::Value) -> String {
    match value {
        serde_json::Value::Null => String::new(),
        serde_json::Value::String(text) => text.clone(),
        serde_json::Value::Array(values) => {
            values.iter().map(word_of).collect::<Vec<_>>().join(",")
        }
        other => other.to_string(),
    }
}

/// The column of the paths.
const CLIP: &str = "clip";
/// The message if it is missing.
const NO_CLIP: &str = "the clip is missing: a column clip has its path";
/// Beginning of the columns that are settings.
const SET: &str = "set.";

/// The options that a clip may have of its own.
struct Options(Command);

impl Options {
    fn new() -> Self {
        Self(PlanArgs::augment_args(Command::new("genga")))
    }

    fn find(&self, name: &str) -> Option<&Arg> {
        self.0.get_arguments().find(|option| option.get_long() == Some(name))
    }

    /// Refuses a column that is neither an option nor a setting.
    fn check(&self, name: &str) -> Result<(), String> {
        if let Some(setting) = name.strip_prefix(SET) {
            return check_setting(setting);
        }
        if name == CLIP || self.find(name).is_some() {
            return Ok(());
        }
        if is_of_batch(name) {
            return Err(format!(
                "{name}: is an option of the whole batch, not of a clip: --{name}"
            ));
        }
        let hint = match Knob::find(name) {
            Ok(_) => format!("; did you mean {SET}{name}?"),
            Err(_) => {
                let names = self.0.get_arguments().filter_map(Arg::get_long);
                did_you_mean(name, names.chain([CLIP]))
            }
        };
        let way_out = if hint.is_empty() { "; genga run --help lists them" } else { &hint };
        Err(format!("{name}: there is no such option of a clip{way_out}"))
    }

    /// Returns the path of a row and its options, as on the command line.
    fn row(&self, cells: Vec<(String, String)>) -> Result<(PathBuf, Vec<String>), String> {
        cells.iter().try_for_each(|(name, _)| self.check(name))?;
        let (path, cells): (Vec<_>, Vec<_>) = cells
            .into_iter()
            .filter(|(_, cell)| !cell.is_empty())
            .partition(|(name, _)| name == CLIP);
        let path = path.into_iter().next_back().map(|(_, path)| path).ok_or(NO_CLIP)?;
        let words = cells.iter().map(|(name, cell)| self.word(name, cell));
        let words: Result<Vec<Option<String>>, String> = words.collect();
        let words = words.map_err(|reason| format!("{path}: {reason}"))?;
        Ok((path.into(), words.into_iter().flatten().collect()))
    }

    /// Returns a cell as on the command line; `None` for a switch that is off.
    fn word(&self, name: &str, cell: &str) -> Result<Option<String>, String> {
        if let Some(setting) = name.strip_prefix(SET) {
            return Ok(Some(format!("--set={setting}={cell}")));
        }
        let option = self.find(name);
        let is_switch = option.is_some_and(|option| !option.get_action().takes_values());
        let may_be_bare = |option: &Arg| option.get_num_args().is_some_and(|n| n.min_values() == 0);
        if !is_switch && !option.is_some_and(may_be_bare) {
            return Ok(Some(format!("--{name}={cell}")));
        }
        match is_yes(cell) {
            Some(true) => Ok(Some(format!("--{name}"))),
            Some(false) => Ok((!is_switch).then(|| format!("--{name}=false"))),
            None => Err(format!("{name}: expected yes or no, found \"{cell}\"")),
        }
    }
}

/// Whether `genga batch` has an option of this name.
fn is_of_batch(name: &str) -> bool {
    let program = commands::Args::command();
    let batch = program.find_subcommand("batch");
    batch.is_some_and(|batch| batch.get_arguments().any(|option| option.get_long() == Some(name)))
}

/// Refuses a setting that does not exist. Names of layers and joints are for the clip to know.
fn check_setting(name: &str) -> Result<(), String> {
    let knob = name.rsplit_once('/').map_or(name, |(_, knob)| knob);
    let is_known = knob.starts_with("keys.weights.")
        || ["passages", "outside"].contains(&knob)
        || Knob::find(knob).is_ok();
    if is_known { Ok(()) } else { Err(format!("{SET}{}", unknown_beside(knob, &[]))) }
}

/// What the cell of a switch says.
fn is_yes(cell: &str) -> Option<bool> {
    match cell.to_ascii_lowercase().as_str() {
        "yes" | "true" | "on" | "1" => Some(true),
        "no" | "false" | "off" | "0" => Some(false),
        _ => None,
    }
}

impl Walk {
    /// Finds the clips of a folder that was named. Of its own results only the files are left out, for it may be where
    /// the clips are.
    fn folder(&mut self, folder: &Path) -> Result<Vec<Named>, Failure> {
        let walk = WalkDir::new(folder).follow_links(true).sort_by_file_name();
        let mut found = Vec::new();
        let mut entries = walk.into_iter();
        while let Some(entry) = entries.next() {
            // A link loop is skipped, a dangling link becomes a clip that fails, and an unreadable folder is an error.
            match entry {
                Ok(entry) if entry.file_type().is_dir() => {
                    let is_named = entry.depth() == 0;
                    if self.is_out(entry.path()) || !is_named && self.skips_folder(entry.path()) {
                        entries.skip_current_dir();
                    }
                }
                Ok(entry) if entry.file_type().is_file() && is_motion(entry.path()) => {
                    if !self.skips_file(entry.path()) {
                        found.push((entry.into_path(), Own::default()));
                    }
                }
                Ok(_) => {}
                Err(error) if error.loop_ancestor().is_some() => {}
                Err(error) if error.path().is_some_and(Path::is_symlink) => {
                    found.extend(
                        error
                            .path()
                            .filter(|path| is_motion(path))
                            .map(|path| (path.into(), Own::default())),
                    );
                }
                Err(error) => return Err(Failure::CouldNot(error.to_string())),
            }
        }
        Ok(found)
    }

    fn pattern(&mut self, pattern: &str) -> Result<Vec<Named>, Failure> {
        let paths = glob::glob(pattern)
            .map_err(|error| Failure::AskedWrongly(format!("{pattern}: {error}")))?;
        let mut found = Vec::new();
        for path in paths {
            let path = path.map_err(|error| Failure::CouldNot(error.to_string()))?;
            if is_in_batch(&path) {
                self.skipped.push(path);
            } else if path.is_dir() {
                if !self.skips_folder(&path) {
                    found.extend(self.folder(&path)?);
                }
            } else if is_motion(&path) && !self.is_in_out(&path) && !self.skips_file(&path) {
                found.push((path, Own::default()));
            }
        }
        match found.is_empty() && self.skipped.is_empty() {
            true => Err(Failure::CouldNot(format!("{pattern}: no motion file matches"))),
            false => Ok(found),
        }
    }

    fn is_out(&self, folder: &Path) -> bool {
        self.out.is_some() && fs::canonicalize(folder).ok() == self.out
    }

    fn is_in_out(&self, path: &Path) -> bool {
        let real = fs::canonicalize(path).ok();
        real.zip(self.out.as_ref()).is_some_and(|(real, out)| real.starts_with(out))
    }

    fn skips_folder(&mut self, folder: &Path) -> bool {
        let skips = is_results(folder);
        self.skipped.extend(skips.then(|| folder.to_owned()));
        skips
    }

    fn skips_file(&mut self, file: &Path) -> bool {
        let skips = is_result(file);
        self.skipped.extend(skips.then(|| file.to_owned()));
        skips
    }
}

/// Gives each clip a unique name. Names that differ only in case get a number too, because many file systems treat them
/// as equal.
fn called(named: Vec<Named>) -> Vec<Item> {
    let parts: Vec<Vec<String>> = named.iter().map(|(path, _)| folders(path)).collect();
    let common = common(&parts);
    let mut seen: HashSet<String> = HashSet::new();
    let mut counts: HashMap<String, usize> = HashMap::new();
    let item = |((path, own), parts): (Named, Vec<String>)| {
        // The name becomes a folder name too.
        let plain = parts[common..].join("/").replace(is_hidden, "_");
        let count = counts.entry(plain.to_lowercase()).or_insert(1);
        let mut name = plain.clone();
        while !seen.insert(name.to_lowercase()) {
            *count += 1;
            name = format!("{plain}~{count}");
        }
        let size = fs::metadata(&path).map_or(0, |about| about.len());
        Item { path, name, own, size }
    };
    named.into_iter().zip(parts).map(item).collect()
}

/// Splits a path into its names, without roots and `..`.
fn folders(path: &Path) -> Vec<String> {
    let name = |part| match part {
        Component::Normal(name) => Some(name.to_string_lossy().into_owned()),
        _ => None,
    };
    path.components().filter_map(name).collect()
}

/// Number of leading folders common to all.
fn common(parts: &[Vec<String>]) -> usize {
    let Some((first, others)) = parts.split_first() else { return 0 };
    let shared = |other: &Vec<String>| {
        let most = first.len().min(other.len()).saturating_sub(1);
        first.iter().zip(other).take(most).take_while(|(a, b)| a == b).count()
    };
    others.iter().map(shared).min().unwrap_or(first.len().saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(paths: &[&str]) -> Vec<String> {
        let named = paths.iter().map(|path| (PathBuf::from(path), Own::default())).collect();
        called(named).into_iter().map(|item| item.name).collect()
    }

    #[test]
    fn a_clip_is_called_by_what_is_not_in_common() {
        assert_eq!(names(&["lib/a/walk.bvh", "lib/b/walk.bvh"]), ["a/walk.bvh", "b/walk.bvh"]);
        assert_eq!(names(&["lib/a/walk.bvh", "lib/run.bvh"]), ["a/walk.bvh", "run.bvh"]);
        assert_eq!(names(&["/x/y/walk.bvh"]), ["walk.bvh"]);
        assert_eq!(
            names(&["../walk.bvh", "./walk.bvh", "walk.bvh"]),
            ["walk.bvh", "walk.bvh~2", "walk.bvh~3"]
        );
        assert_eq!(names(&["a", "a/b.bvh"]), ["a", "a/b.bvh"]);
        assert_eq!(names(&["Walk.bvh", "walk.bvh"]), ["Walk.bvh", "walk.bvh~2"]);
        assert_eq!(
            names(&["walk.bvh~2", "walk.bvh", "walk.bvh"]),
            ["walk.bvh~2", "walk.bvh", "walk.bvh~3"]
        );
    }

    #[test]
    fn a_table_says_what_is_asked_of_each_clip() {
        let table = "clip,trim,set.spacing.on,repair\na.bvh,1..9,3,true\nb.bvh,,,false\n";
        let lines = "{\"clip\": \"a.bvh\", \"trim\": \"1..9\", \"set.spacing.on\": 3, \"repair\": true}\n\n{\"clip\": \"b.bvh\"}\n";
        let own = ["--trim=1..9", "--set=spacing.on=3", "--repair"].map(str::to_owned).to_vec();
        let row = |(line, path, words): (usize, &str, &[String])| {
            (line, PathBuf::from(path), words.to_vec())
        };
        let wanted = vec![row((2, "a.bvh", &own)), row((3, "b.bvh", &[]))];
        assert_eq!(of_table(table).unwrap(), wanted);
        let mut read = of_objects(lines).unwrap();
        read[0].2.sort_by_key(|word| own.iter().position(|other| other == word));
        // The table has a header in front, and the lines an empty one in between.
        read[0].0 += 1;
        assert_eq!(read, wanted);
        assert_eq!(of_table("trim\n1..9\n").unwrap_err().0, 1);
        assert_eq!(of_objects("{\"clip\": \"a\"}\n{").unwrap_err().0, 2);
    }

    #[test]
    fn a_list_has_a_clip_a_line() {
        let lines = "\u{feff}# a list\r\n\r\na b.bvh\r\n歩き.bvh".as_bytes();
        let read: Vec<_> = lined(lines, Path::new("list.txt")).unwrap().into_iter().collect();
        let paths: Vec<_> = read.into_iter().map(|(path, _)| path).collect();
        assert_eq!(paths, ["a b.bvh", "歩き.bvh"].map(PathBuf::from));
    }
}
