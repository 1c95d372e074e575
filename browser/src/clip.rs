//! A clip (クリップ), from the bytes of a file of any format that the reader knows.

use std::fmt::Display;

use genga::deliver::ClipMark;
use genga::motion::Clip;
use genga::motion::bvh::Cleaning;
use genga::motion::file;

/// What the program has of a file, too.
pub(crate) struct Read {
    pub(crate) clip: Clip,
    pub(crate) mark: ClipMark,
    pub(crate) notes: Vec<String>,
}

impl Read {
    /// Reads a file by its bytes, as it is. Errors begin with its name.
    pub(crate) fn of(name: &str, bytes: &[u8]) -> Result<Self, String> {
        let read = file::Options::default().read(bytes).map_err(of_file(name))?;
        let mark = ClipMark::of(name, &read.clip);
        let notes = read.warnings.iter().map(ToString::to_string).collect();
        Ok(Self { clip: read.clip, mark, notes })
    }
}

/// A clip without what no body did, and what is said of it beside the notes of its reader.
pub(crate) fn cleaned(
    name: &str,
    clip: Clip,
    mut notes: Vec<String>,
) -> Result<(Clip, Vec<String>), String> {
    let (clip, cleaned) = Cleaning::default().of(clip).map_err(of_file(name))?;
    clip.check_size().map_err(of_file(name))?;
    notes.extend(cleaned.iter().map(ToString::to_string));
    Ok((clip, notes))
}

fn of_file<E: Display>(name: &str) -> impl Fn(E) -> String {
    move |error| format!("{name}: {error}")
}
