//! Reads a clip (クリップ) from the bytes of a file, in any format that the reader knows.

use std::fmt::Display;

use genga::motion::Clip;
use genga::motion::clean::Cleaning;
use genga_files::ClipMark;
use genga_read as file;

/// A clip with its mark and notes, as in the program.
pub(crate) struct Read {
    pub(crate) clip: Clip,
    pub(crate) mark: ClipMark,
    pub(crate) notes: Vec<String>,
}

impl Read {
    /// Reads a file's bytes, uncleaned. Errors begin with the file's name.
    pub(crate) fn new(name: &str, bytes: &[u8]) -> Result<Self, String> {
        let read = file::Options::default().read(bytes).map_err(of_file(name))?;
        let mark = ClipMark::new(name, &read.clip);
        let notes = read.warnings.iter().map(ToString::to_string).collect();
        Ok(Self { clip: read.clip, mark, notes })
    }
}

/// Removes lead-ins and glitches from a clip, and appends notes about it.
pub(crate) fn cleaned(
    name: &str,
    clip: Clip,
    mut notes: Vec<String>,
) -> Result<(Clip, Vec<String>), String> {
    let (clip, cleaned) = Cleaning::default().apply(clip).map_err(of_file(name))?;
    clip.check_size().map_err(of_file(name))?;
    notes.extend(cleaned.iter().map(ToString::to_string));
    Ok((clip, notes))
}

fn of_file<E: Display>(name: &str) -> impl Fn(E) -> String {
    move |error| format!("{name}: {error}")
}
