//! What a person is told when something goes wrong, and the exit code.

use std::fmt;
use std::path::Path;

use crate::error::{Error, Place};

/// Why the program stops.
#[derive(Debug)]
pub(super) enum Failure {
    /// It could not be done: exit code 1.
    CouldNot(String),
    /// It was asked wrongly: exit code 2.
    AskedWrongly(String),
    /// A signal asked for an end: exit code 130, as shells have it.
    Stopped(String),
    /// Whoever read our output has closed it: no failure at all.
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

    /// What could not be done with a file or a folder, which the message names.
    pub(super) fn at(path: &Path, reason: impl fmt::Display) -> Self {
        Self::CouldNot(format!("{}: {reason}", path.display()))
    }

    /// An error that concerns a file, which its message then names.
    pub(super) fn of_file(path: &Path, error: Error) -> Self {
        let name = path.display();
        match error {
            Error::Bvh { .. }
            | Error::Motion { place: Place::Line(..), .. }
            | Error::Sheet { place: Some(_), .. } => Self::CouldNot(format!("{name}:{error}")),
            Error::Recipe { place, message, .. } => {
                let place = place.map(|(line, column)| format!("{line}:{column}:"));
                Self::AskedWrongly(format!("{name}:{} {message}", place.unwrap_or_default()))
            }
            Error::Clip { .. }
            | Error::Motion { .. }
            | Error::Sheet { .. }
            | Error::Table { .. }
            | Error::Camera { .. }
            | Error::Model { .. } => Self::CouldNot(format!("{name}: {error}")),
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
