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
    /// Reads a file by its bytes. Errors begin with its name.
    pub(crate) fn of(name: &str, bytes: &[u8]) -> Result<Self, String> {
        let of_file = |error: &dyn Display| format!("{name}: {error}");
        let read = file::Options::default().read(bytes).map_err(|error| of_file(&error))?;
        let mark = ClipMark::of(name, &read.clip);
        let (clip, cleaned) = Cleaning::default().of(read.clip).map_err(|error| of_file(&error))?;
        clip.check_size().map_err(|error| of_file(&error))?;
        let notes = read.warnings.iter().chain(&cleaned).map(ToString::to_string).collect();
        Ok(Self { clip, mark, notes })
    }
}
