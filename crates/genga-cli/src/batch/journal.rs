//! The journal of finished clips (作業記録): one line per clip, written when its folder is in place. The next batch reads
//! it and continues from there.

use std::collections::{BTreeMap, HashMap};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::super::console::counted;
use super::super::failure::Failure;
use super::super::files;
use super::row::Line;
use super::shard::Shard;
use genga_files::Manifest;

/// Version of the format, as written in the file.
const SCHEMA: &str = "genga-batch-2";

/// The first line: identifies the list and the part.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Header {
    schema: String,
    /// The version of genga.
    genga: String,
    /// Digest of the names of all clips.
    pub(crate) list: String,
    /// Digest of the options for all clips.
    #[serde(default)]
    asked: String,
    /// Number of clips in all parts together.
    pub(crate) clips: usize,
    pub(crate) part: usize,
    pub(crate) parts: usize,
    /// Formats of every clip. The next batch writes them again if it names none.
    #[serde(flatten)]
    pub(crate) written: Written,
}

/// Formats as they were asked for; of an older journal, none.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Written {
    /// Names of formats, `all` among them.
    #[serde(default)]
    pub(crate) deliver: Vec<String>,
    /// Settings of formats that differ from the defaults.
    #[serde(default)]
    pub(crate) with: BTreeMap<String, String>,
}

impl Header {
    pub(crate) fn new(
        list: String,
        asked: String,
        clips: usize,
        shard: Shard,
        written: Written,
    ) -> Self {
        let genga = env!("CARGO_PKG_VERSION").into();
        Self {
            schema: SCHEMA.into(),
            genga,
            list,
            asked,
            clips,
            part: shard.index,
            parts: shard.count,
            written,
        }
    }

    /// Formats that the last batch of this part wrote into a folder.
    pub(crate) fn written_in(folder: &Path, shard: Shard) -> Written {
        let path = file(folder, shard.index, shard.count);
        let mut line = String::new();
        let read = File::open(path).and_then(|file| BufReader::new(file).read_line(&mut line));
        let header = read.ok().and_then(|_| Self::parse(&line));
        header.map(|header| header.written).unwrap_or_default()
    }

    /// Parses the header of a journal; `None` for any other line.
    fn parse(line: &str) -> Option<Self> {
        let header: Self = serde_json::from_str(line).ok()?;
        (header.schema == SCHEMA).then_some(header)
    }

    /// Whether a line is the header of a journal.
    pub(crate) fn is_header(line: &str) -> bool {
        Self::parse(line).is_some()
    }

    /// Path of this part's journal in a folder.
    pub(crate) fn file(&self, folder: &Path) -> PathBuf {
        file(folder, self.part, self.parts)
    }
}

fn file(folder: &Path, part: usize, parts: usize) -> PathBuf {
    match parts {
        1 => folder.join("batch.jsonl"),
        _ => folder.join(format!("batch-{part}-of-{parts}.jsonl")),
    }
}

/// Whether a file name is that of a journal.
pub(crate) fn is_journal(name: &str) -> bool {
    name.starts_with("batch") && name.ends_with(".jsonl")
}

/// Position of a line in the file.
#[derive(Debug, Clone, Copy)]
struct Span {
    begin: u64,
    length: usize,
}

/// The part of a clip's journal line that is kept in memory.
#[derive(Debug, Clone)]
struct Known {
    at: usize,
    span: Span,
    file: String,
    asked: String,
    /// Whether it is done, with all formats that were asked for.
    is_whole: bool,
}

/// A journal that is read and appended to.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
    end: u64,
    pub(crate) header: Header,
    known: HashMap<String, Known>,
    /// Number of lines that are not as a batch wrote them.
    changed: usize,
}

impl Journal {
    /// Opens the journal of a part of a list. From the journal of another list, clips of the same name are kept.
    pub(crate) fn open(folder: &Path, header: Header, names: &[&str]) -> Result<Self, Failure> {
        let path = header.file(folder);
        if !path.exists() {
            return Self::begin(&path, header, &[]);
        }
        let before = Self::held(&path)?;
        if before.header == header {
            return Ok(before);
        }
        // Keeps only clips of the new list, at their new places.
        let places: HashMap<&str, usize> =
            names.iter().enumerate().map(|(at, name)| (*name, at)).collect();
        let mut lines = Vec::new();
        for (name, known) in &before.known {
            if let Some(at) = places.get(name.as_str()) {
                lines.push(Line { at: *at, ..before.line_at(known.span)? });
            }
        }
        lines.sort_by_key(|line| line.at);
        Self::begin(&path, header, &lines)
    }

    fn begin(path: &Path, header: Header, lines: &[Line]) -> Result<Self, Failure> {
        let mut text = encoded(&header);
        lines.iter().for_each(|line| text.push_str(&sealed(line)));
        files::write(path, text.as_bytes())?;
        Self::held(path)
    }

    /// Opens and locks a journal for writing. An incomplete last line is cut off.
    fn held(path: &Path) -> Result<Self, Failure> {
        let file = OpenOptions::new().read(true).append(true).open(path);
        let file = file.map_err(|error| Failure::io(path, error))?;
        // On a file system without locks, a second batch goes unnoticed.
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            return Err(Failure::at(
                path,
                "another batch is at work on this; wait for it, or name another folder with --out",
            ));
        }
        let journal = Self::new(path, file)?;
        journal.file.set_len(journal.end).map_err(|error| Failure::io(path, error))?;
        Ok(journal)
    }

    /// Reads a journal. An incomplete last line is ignored.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let file = File::open(path).map_err(|error| Failure::io(path, error))?;
        Self::new(path, file)
    }

    fn new(path: &Path, file: File) -> Result<Self, Failure> {
        let io = |error: io::Error| Failure::io(path, error);
        let mut lines = BufReader::new(&file);
        let mut text = String::new();
        let mut end = lines.read_line(&mut text).map_err(io)? as u64;
        let is_ours = |header: &Header| header.schema == SCHEMA;
        let header = serde_json::from_str(&text).ok().filter(is_ours);
        let header: Header = header.ok_or_else(|| {
            Failure::at(path, "is no journal of a batch that this version can read")
        })?;
        let (mut known, mut changed) = (HashMap::new(), 0);
        loop {
            text.clear();
            let length = lines.read_line(&mut text).map_err(io)?;
            if !text.ends_with('\n') {
                break;
            }
            match unsealed(&text) {
                Some(Line { at, clip, file, asked, row, .. }) => {
                    let span = Span { begin: end, length };
                    known.insert(clip, Known { at, span, file, asked, is_whole: row.is_whole() });
                }
                None => changed += 1,
            }
            end += length as u64;
        }
        drop(lines);
        Ok(Self { path: path.into(), file, end, header, known, changed })
    }

    /// Whether this clip was done with the same file and options, and lacks no format; its line is then not needed.
    pub(crate) fn has(&self, name: &str, file: &str, asked: &str) -> bool {
        self.known
            .get(name)
            .is_some_and(|known| known.is_whole && known.file == file && known.asked == asked)
    }

    /// Returns the last line of a clip.
    pub(crate) fn line(&self, name: &str) -> Result<Option<Line>, Failure> {
        self.known.get(name).map(|known| self.line_at(known.span)).transpose()
    }

    fn line_at(&self, span: Span) -> Result<Line, Failure> {
        let mut text = vec![0; span.length];
        let mut file = &self.file;
        let read = file.seek(SeekFrom::Start(span.begin)).and_then(|_| file.read_exact(&mut text));
        let line = read.and_then(|()| {
            let line = str::from_utf8(&text).ok().and_then(unsealed);
            line.ok_or_else(|| io::Error::other("a line has changed while it was read"))
        });
        line.map_err(|error| Failure::io(&self.path, error))
    }

    /// A note on lines that do not count because somebody changed them; `None` if there are none.
    pub(crate) fn note(&self) -> Option<String> {
        let (path, lines) = (self.path.display(), counted(self.changed, "line"));
        (self.changed > 0).then(|| {
            format!("{path}: {lines} not as a batch wrote it; such clips count as not done")
        })
    }

    /// Appends the line of a clip.
    pub(crate) fn add(&mut self, line: Line) -> Result<(), Failure> {
        let text = sealed(&line);
        let span = Span { begin: self.end, length: text.len() };
        let written = self.file.write_all(text.as_bytes());
        written.map_err(|error| Failure::io(&self.path, error))?;
        self.end += text.len() as u64;
        let Line { at, clip, file, asked, row, .. } = line;
        self.known.insert(clip, Known { at, span, file, asked, is_whole: row.is_whole() });
        Ok(())
    }

    /// The known clips and their places in the list, in no particular order.
    pub(crate) fn places(&self) -> impl Iterator<Item = (usize, &str)> {
        self.known.iter().map(|(name, known)| (known.at, name.as_str()))
    }
}

/// Refuses parts that do not all belong to one list.
pub(crate) fn check_parts(journals: &[Journal]) -> Result<(), Failure> {
    let wrongly = |message: String| Err(Failure::AskedWrongly(format!("--join: {message}")));
    let Some(first) = journals.first() else {
        return wrongly("there is no batch in these folders; name those that --out named".into());
    };
    let (list, parts) = (&first.header.list, first.header.parts);
    if journals.iter().any(|journal| &journal.header.list != list || journal.header.parts != parts)
    {
        return wrongly(
            "these folders are of different lists, or of lists that were dealt differently".into(),
        );
    }
    let mut there: HashMap<usize, &Path> = HashMap::new();
    for journal in journals {
        if let Some(other) = there.insert(journal.header.part, &journal.path) {
            let (part, path) = (journal.header.part, journal.path.display());
            let both = if other == journal.path {
                format!("{path} twice")
            } else {
                format!("{} and {path}", other.display())
            };
            return wrongly(format!("part {part} of {parts} is there twice: {both}; name it once"));
        }
    }
    if let Some(part) = (1..=parts).find(|part| !there.contains_key(part)) {
        return wrongly(format!(
            "part {part} of {parts} is missing: genga batch … --shard {part}/{parts}"
        ));
    }
    let first = &first.header;
    match journals.iter().find(|journal| journal.header.asked != first.asked) {
        Some(Journal { header, .. }) => wrongly(format!(
            "part {} of {parts} was done with other settings than part {}, or by another version of genga; do one of them \
             again",
            header.part, first.part
        )),
        None => Ok(()),
    }
}

/// Separates a line from its digest, which is its last field.
const SEAL: &str = ",\"digest\":\"";

/// Encodes the line of a clip with a digest of it, so that a line that was changed by hand is not believed.
fn sealed(line: &Line) -> String {
    let text = encoded(line);
    let body = text.trim_end().strip_suffix('}').unwrap_or_default();
    format!("{body}{SEAL}{}\"}}\n", Manifest::digest(body.as_bytes()))
}

/// Decodes a clip's line. Returns `None` unless [`sealed`] wrote exactly this text, and for files outside of the clip's
/// folder.
fn unsealed(text: &str) -> Option<Line> {
    let (body, digest) = text.trim_end().rsplit_once(SEAL)?;
    let is_ours = digest.strip_suffix("\"}") == Some(&*Manifest::digest(body.as_bytes()));
    let line: Line = is_ours.then(|| serde_json::from_str(&format!("{body}}}")).ok()).flatten()?;
    line.files.keys().all(|name| Manifest::is_inside(name)).then_some(line)
}

fn encoded(data: &impl Serialize) -> String {
    serde_json::to_string(data).expect("plain data") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_with_files_outside_of_the_clips_folder_is_not_believed() {
        for (file, is_believed) in
            [("images/A_0001.png", true), ("../../mine", false), ("/mine", false)]
        {
            let line = serde_json::json!({
                "at": 0, "clip": "kick.bvh", "file": "", "asked": "", "keys": "", "ms": [0.0, 0.0, 0.0],
                "row": {"status": "done", "message": "", "warnings": []}, "files": {file: "0"},
            });
            let line: Line = serde_json::from_value(line).unwrap();
            assert_eq!(unsealed(&sealed(&line)).is_some(), is_believed, "{file}");
        }
    }
}
