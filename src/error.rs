//! Errors by whose fault they are, and warnings with stable codes.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// What another library said, behind an error.
pub type Cause = Box<dyn std::error::Error + Send + Sync>;

/// Everything that can go wrong, sorted by who can mend it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The motion file is not what it should be. Line and column count from 1.
    #[error("{line}:{column}: {message}")]
    Bvh {
        /// Line in the file, from 1.
        line: usize,
        /// Column in that line in bytes, from 1.
        column: usize,
        /// What was expected and what was found.
        message: String,
    },
    /// A motion file of another format than BVH is not what it should be.
    #[error("{place}{message}")]
    Motion {
        /// Where in the file.
        place: Place,
        /// What was expected and what was found.
        message: String,
    },
    /// A setting has a value it cannot have.
    #[error("{name}: {message}")]
    Setting {
        /// The knob, as `--set` and the recipe name it.
        name: String,
        /// What is wrong and what would be right.
        message: String,
    },
    /// The recipe file is not a recipe.
    #[error("recipe: {}{message}", located(*place))]
    Recipe {
        /// Line and column in the file, from 1, where there is a place to point at.
        place: Option<(usize, usize)>,
        /// What is wrong, and what would be right.
        message: String,
        /// What the reader of its format said, or why a setting was refused.
        source: Option<Cause>,
    },
    /// The clip cannot be worked on as it is.
    #[error("{message}")]
    Clip {
        /// What is missing, and the way out.
        message: String,
    },
    /// A correction names something the clip does not have.
    #[error("edits: {message}")]
    Edits {
        /// What was named and what there is.
        message: String,
    },
    /// A sheet is not what it should be, or does not fit its clip.
    #[error("{}{message}", located(*place))]
    Sheet {
        /// Line and column in the file, from 1, where there is a place to point at.
        place: Option<(usize, usize)>,
        /// What is wrong, and the way out.
        message: String,
        /// What the reader of its format said.
        source: Option<Cause>,
    },
    /// A table is not what it should be. Its message has the name of the field, so that only the line goes before it.
    #[error("{}{message}", line(*place))]
    Table {
        /// Line of the row and number of the field in it, from 1, where there is a place to point at.
        place: Option<(usize, usize)>,
        /// What was expected and what was found.
        message: String,
        /// What the reader of its format said.
        source: Option<Cause>,
    },
    /// A result does not go into its format. No file of a person is at fault.
    #[error("{what} could not be written: {source}")]
    Encoding {
        /// What was to be written.
        what: &'static str,
        /// What the writer of the format said.
        source: Cause,
    },
    /// A file has no camera that can be used.
    #[error("{message}")]
    Camera {
        /// What is wrong with it, and what there is.
        message: String,
    },
    /// A file is no model of MMD that can be used.
    #[error("byte {byte}: {message}")]
    Model {
        /// The byte of the file, from 0.
        byte: usize,
        /// What was expected and what was found.
        message: String,
    },
    /// Reading or writing failed.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A picture could not be drawn.
    #[error("picture: {message}")]
    Picture {
        /// What is wrong with what should be drawn, or what the drawing library said.
        message: String,
        /// What the drawing library said.
        source: Option<Cause>,
    },
}

impl Error {
    /// A setting error: `name` is the knob, `message` says what would be right.
    pub fn setting(name: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), message: message.into() }
    }

    /// A clip error.
    pub fn clip(message: impl Into<String>) -> Self {
        Self::Clip { message: message.into() }
    }

    /// An error of a sheet as a whole.
    pub fn sheet(message: impl Into<String>) -> Self {
        Self::Sheet { place: None, message: message.into(), source: None }
    }

    /// An error of a sheet at a line and column of its file, from 1.
    pub fn sheet_at(place: (usize, usize), message: impl Into<String>) -> Self {
        Self::Sheet { place: Some(place), message: message.into(), source: None }
    }

    /// Line and column in the file, from 1, where there is a file to point into.
    ///
    /// ```
    /// let error = genga::motion::bvh::read(b"HIERARCHY\nJOIN Hips").unwrap_err();
    /// assert_eq!(error.position(), Some((2, 1)));
    /// ```
    pub fn position(&self) -> Option<(usize, usize)> {
        match self {
            Self::Bvh { line, column, .. } => Some((*line, *column)),
            Self::Motion { place: Place::Line(line, column), .. } => Some((*line, *column)),
            Self::Recipe { place, .. } | Self::Sheet { place, .. } | Self::Table { place, .. } => {
                *place
            }
            _ => None,
        }
    }
}

/// Where in a motion file something is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// Nowhere: the file as a whole.
    Whole,
    /// In a line and its column, both from 1, of a file that is text.
    Line(usize, usize),
    /// At a byte, from 0, of one that is not.
    Byte(u64),
    /// In a part that has a name or a path, such as `animations[0].samplers[3]`.
    Part(String),
}

/// As it stands before a message.
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

/// The name nearest to one that is not there, to offer it.
pub(crate) fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    names.min_by_key(|other| distance(other, name))
}

/// Letters to change, add or drop between two names.
fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.bytes().enumerate() {
            let change = diagonal + usize::from(x != y);
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

/// Something a person should know which does not stop the work.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// A stable code to match on, such as `W_LEAD_IN`.
    pub code: &'static str,
    /// One plain sentence.
    pub message: String,
    /// Line and column in the file, from 1, where there is a place to point at.
    pub place: Option<(usize, usize)>,
}

impl Warning {
    /// A warning with a stable code, about the whole.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), place: None }
    }

    /// A warning about a line and column of the file, from 1.
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
