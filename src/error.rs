//! Errors, sorted by whose fault they are, and warnings with stable codes.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// An error of another library that caused ours.
pub type Cause = Box<dyn std::error::Error + Send + Sync>;

/// Every error of the crate, sorted by who can fix it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A motion or model file is malformed.
    #[error("{place}{message}")]
    Motion {
        /// Position in the file.
        place: Place,
        /// Expected and found input.
        message: String,
    },
    /// A setting has an invalid value.
    #[error("{name}: {message}")]
    Setting {
        /// Name of the knob, as in `--set` and in the recipe.
        name: String,
        /// Message naming the fault and the remedy.
        message: String,
    },
    /// The recipe file is not a recipe.
    #[error("recipe: {}{message}", located(*place))]
    Recipe {
        /// Line and column in the file, from 1, if known.
        place: Option<(usize, usize)>,
        /// Message naming the fault and the remedy.
        message: String,
        /// Error of the format's parser, or the reason why a setting was refused.
        source: Option<Cause>,
    },
    /// The clip cannot be processed as it is.
    #[error("{message}")]
    Clip {
        /// Message naming the missing part and the remedy.
        message: String,
    },
    /// An edit names something that the clip does not have.
    #[error("edits: {message}")]
    Edits {
        /// Message with the unknown name and the available ones.
        message: String,
    },
    /// A sheet is malformed, or does not fit its clip.
    #[error("{}{message}", located(*place))]
    Sheet {
        /// Line and column in the file, from 1, if known.
        place: Option<(usize, usize)>,
        /// Message naming the fault and the remedy.
        message: String,
        /// Error of the format's parser.
        source: Option<Cause>,
    },
    /// A table is malformed. The message names the field, so only the line number is put in front.
    #[error("{}{message}", line(*place))]
    Table {
        /// Line of the row and number of the field in it, from 1, if known.
        place: Option<(usize, usize)>,
        /// Expected and found input.
        message: String,
        /// Error of the format's parser.
        source: Option<Cause>,
    },
    /// A result cannot be encoded in its format. No input file is at fault.
    #[error("{what} could not be written: {source}")]
    Encoding {
        /// Name of the encoded item.
        what: &'static str,
        /// Error of the format's writer.
        source: Cause,
    },
    /// A file has no usable camera.
    #[error("{message}")]
    Camera {
        /// Message naming the fault and the available cameras.
        message: String,
    },
    /// Reading or writing a file failed.
    #[error("{}: {}", path.display(), refusal(source))]
    Io {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The work was [stopped](crate::pipeline::Stop) before it was done.
    #[error("stopped before it was done")]
    Stopped,
    /// A picture could not be drawn.
    #[error("picture: {message}")]
    Picture {
        /// Message naming the fault in the drawn data, or the drawing library's own message.
        message: String,
        /// Error of the drawing library.
        source: Option<Cause>,
    },
}

impl Error {
    /// Creates a setting error: `name` is the knob, `message` says what would be right.
    pub fn setting(name: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), message: message.into() }
    }

    /// Creates a clip error.
    pub fn clip(message: impl Into<String>) -> Self {
        Self::Clip { message: message.into() }
    }

    /// Creates an error about a sheet as a whole.
    pub fn sheet(message: impl Into<String>) -> Self {
        Self::Sheet { place: None, message: message.into(), source: None }
    }

    /// Creates an error at a line and column, from 1, of the sheet's file.
    pub fn sheet_at(place: (usize, usize), message: impl Into<String>) -> Self {
        Self::Sheet { place: Some(place), message: message.into(), source: None }
    }

    /// Returns line and column in the file, from 1, if the error points into a file.
    ///
    /// ```
    /// let error = genga::motion::bvh::read(b"HIERARCHY\nJOIN Hips").unwrap_err();
    /// assert_eq!(error.position(), Some((2, 1)));
    /// ```
    pub fn position(&self) -> Option<(usize, usize)> {
        match self {
            Self::Motion { place: Place::Line(line, column), .. } => Some((*line, *column)),
            Self::Recipe { place, .. } | Self::Sheet { place, .. } | Self::Table { place, .. } => {
                *place
            }
            _ => None,
        }
    }
}

/// Says in words why the system refused a file, and what to do, in place of its own words with a number. An error with a
/// message of its own, or of another kind, keeps its words.
///
/// ```
/// use std::io::{Error, ErrorKind};
///
/// let said = genga::error::refusal(&Error::from(ErrorKind::IsADirectory));
/// assert_eq!(said, "is a folder; name a file");
/// ```
pub fn refusal(error: &io::Error) -> String {
    use io::ErrorKind::{
        AlreadyExists, InvalidFilename, IsADirectory, NotADirectory, NotFound, PermissionDenied,
        QuotaExceeded, ReadOnlyFilesystem, StorageFull,
    };
    if error.get_ref().is_some() {
        return error.to_string();
    }
    let words = match error.kind() {
        NotFound => {
            "there is no such file or folder; check its name, and the folder that you are in"
        }
        IsADirectory => "is a folder; name a file",
        NotADirectory => "a part of this path is a file and no folder; check the path",
        AlreadyExists => "is there already; name another",
        PermissionDenied => "access is denied; change the permissions, or use another place",
        ReadOnlyFilesystem => "the disk can only be read; write elsewhere",
        StorageFull | QuotaExceeded => "the disk is full; make room, or write elsewhere",
        InvalidFilename => "the name is too long for the file system; use a shorter one",
        _ => return error.to_string(),
    };
    words.into()
}

/// Says in words which number a reader of a file expected, in place of its type in Rust.
///
/// ```
/// let said = genga::error::in_words("invalid type: floating point `1.5`, expected usize");
/// assert_eq!(said, "invalid type: floating point `1.5`, expected a whole number, 0 or more");
/// ```
pub fn in_words(message: &str) -> String {
    const TYPES: [(&str, &str); 8] = [
        ("usize", "a whole number, 0 or more"),
        ("u64", "a whole number, 0 or more"),
        ("u32", "a whole number, 0 or more"),
        ("i64", "a whole number"),
        ("f64", "a number"),
        ("struct Pin", "{ frame = 42 }"),
        ("struct Move", "{ from = 79, to = 81 }"),
        ("struct Hold", "{ frame = 60, koma = 6 }"),
    ];
    let Some((found, expected)) = message.rsplit_once("expected ") else { return message.into() };
    let words = TYPES.iter().find(|(name, _)| *name == expected);
    words.map_or_else(|| message.into(), |(_, words)| format!("{found}expected {words}"))
}

/// A position in a motion or model file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// No position: the file as a whole.
    Whole,
    /// A line and a column in bytes, both from 1, of a text file.
    Line(usize, usize),
    /// A byte offset, from 0, in a binary file.
    Byte(u64),
    /// A part with a name or a path, such as `animations[0].samplers[3]`.
    Part(String),
}

/// Formats the position as the prefix of a message.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Line(line, column) => write!(f, "{line}:{column}: "),
            Self::Byte(byte) => write!(f, "byte {byte}: "),
            Self::Part(path) => write!(f, "{path}: "),
        }
    }
}

/// Asks whether the most similar name was meant, as the end of a sentence about an unknown one: `; did you mean Hips?`.
/// Empty if no name is similar.
pub fn did_you_mean<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> String {
    nearest(name, names).map_or_else(String::new, |meant| format!("; did you mean {meant}?"))
}

/// Finds the most similar name, if it is similar at all.
fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    names.filter(|other| is_like(name, other)).min_by_key(|other| distance(other, name))
}

/// Whether one name has the other in it, or a third of its letters differ at most. Two swapped letters count as similar
/// in short names too.
fn is_like(name: &str, other: &str) -> bool {
    const PART: usize = 3;
    let has = |whole: &str, part: &str| part.len() >= PART && whole.contains(part);
    let most = (name.len() / 3).max(2).min(name.len().saturating_sub(1));
    has(name, other) || has(other, name) || distance(name, other) <= most
}

/// Levenshtein distance: the fewest bytes to change, add or drop between two names; letters are the same in either case.
fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.bytes().enumerate() {
            let change = diagonal + usize::from(!x.eq_ignore_ascii_case(&y));
            diagonal = row[j + 1];
            row[j + 1] = change.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

fn located(place: Option<(usize, usize)>) -> String {
    place.map_or_else(String::new, |(line, column)| format!("{line}:{column}: "))
}

fn line(place: Option<(usize, usize)>) -> String {
    place.map_or_else(String::new, |(line, _)| format!("line {line}: "))
}

/// A problem worth reporting that does not stop the work.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Stable code to match on, such as `W_LEAD_IN`.
    pub code: &'static str,
    /// One plain sentence.
    pub message: String,
    /// Line and column in the file, from 1, if known.
    pub place: Option<(usize, usize)>,
}

impl Warning {
    /// Creates a warning about the whole, with a stable code.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), place: None }
    }

    /// Creates a warning about a line and column, from 1, of the file.
    pub fn at(place: (usize, usize), code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), place: Some(place) }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.place {
            write!(f, "{line}:{column}: ")?;
        }
        write!(f, "{} [{}]", self.message, self.code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_system_is_quoted_only_where_there_are_no_better_words() {
        use io::ErrorKind;
        let io = |source: io::Error| Error::Io { path: "walk.bvh".into(), source }.to_string();
        for (kind, says) in [
            (ErrorKind::NotFound, "there is no such file"),
            (ErrorKind::PermissionDenied, "access is denied; change the permissions"),
            (ErrorKind::StorageFull, "the disk is full; make room"),
            (ErrorKind::NotADirectory, "a part of this path is a file"),
        ] {
            let said = io(kind.into());
            assert!(said.starts_with(&format!("walk.bvh: {says}")), "{said}");
        }
        assert_eq!(io(io::Error::new(ErrorKind::NotFound, "no ffmpeg")), "walk.bvh: no ffmpeg");
        assert_eq!(io(ErrorKind::TimedOut.into()), "walk.bvh: timed out");
    }

    #[test]
    fn a_name_is_suggested_only_if_it_is_similar() {
        let names = ["Hips", "LeftHand", "mixamorig:Spine", "x", "filter.width"];
        for (name, meant) in [
            ("Hisp", "Hips"),
            ("HIPS", "Hips"),
            ("LeftHnad", "LeftHand"),
            ("Spine", "mixamorig:Spine"),
            ("Armature|LeftHand", "LeftHand"),
            ("width", "filter.width"),
        ] {
            let hint = did_you_mean(name, names.into_iter());
            assert_eq!(hint, format!("; did you mean {meant}?"), "{name}");
        }
        for name in ["zzzz", "zz", "z", "", "*Tail*", "RightFoot", "filter.qqqqq"] {
            assert_eq!(did_you_mean(name, names.into_iter()), "", "{name}");
        }
    }
}
