//! Error messages and exit codes.

use std::fmt;
use std::io;
use std::path::Path;

use genga::error::{Error, Place};

/// The reason the program stops.
#[derive(Debug)]
pub(super) enum Failure {
    /// The work failed: exit code 1.
    CouldNot(String),
    /// The command line or an input asks for something impossible: exit code 2.
    AskedWrongly(String),
    /// A signal stopped the program: exit code 130, as in shells.
    Stopped(String),
    /// The reader of the output closed the pipe: no failure.
    ClosedPipe,
}

impl Failure {
    pub(super) fn code(&self) -> u8 {
        match self {
            Self::CouldNot(_) => 1,
            Self::AskedWrongly(_) => 2,
            Self::Stopped(_) => 130,
            Self::ClosedPipe => 0,
        }
    }

    /// Builds a failure about a file or folder, with its path in the message.
    pub(super) fn at(path: &Path, reason: impl fmt::Display) -> Self {
        Self::CouldNot(format!("{}: {reason}", path.display()))
    }

    /// Builds a failure of the system at a file or folder.
    pub(super) fn io(path: &Path, source: io::Error) -> Self {
        Error::Io { path: path.to_owned(), source }.into()
    }

    /// Builds a failure from an error in a file, with the file's path in the message.
    pub(super) fn of_file(path: &Path, error: Error) -> Self {
        let name = path.display();
        match error {
            Error::Motion { place: Place::Line(..), .. } | Error::Sheet { place: Some(_), .. } => {
                Self::CouldNot(format!("{name}:{error}"))
            }
            Error::Recipe { place, message, .. } => {
                let place = place.map(|(line, column)| format!("{line}:{column}:"));
                Self::AskedWrongly(format!("{name}:{} {message}", place.unwrap_or_default()))
            }
            Error::Clip { .. }
            | Error::Motion { .. }
            | Error::Sheet { .. }
            | Error::Table { .. }
            | Error::Camera { .. } => Self::CouldNot(format!("{name}: {error}")),
            other => other.into(),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Setting { .. } | Error::Recipe { .. } | Error::Edits { .. } => {
                Self::AskedWrongly(error.to_string())
            }
            other => Self::CouldNot(other.to_string()),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CouldNot(message) | Self::AskedWrongly(message) | Self::Stopped(message) => {
                f.write_str(message)
            }
            Self::ClosedPipe => f.write_str("the output was closed"),
        }
    }
}
