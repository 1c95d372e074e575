//! Maps parts of a text to their line and column.

use serde::Deserialize;
use serde_json::value::RawValue;

use crate::json_words;
use genga::error::Error;

/// The text of a file whose parts are parsed separately.
#[derive(Debug, Clone, Copy)]
pub(super) struct Text<'a>(pub(super) &'a str);

impl<'a> Text<'a> {
    /// Parses the whole file.
    pub(super) fn whole<T: Deserialize<'a>>(self) -> Result<T, Error> {
        self.part(self.0)
    }

    /// Parses one raw value.
    pub(super) fn value<T: Deserialize<'a>>(self, raw: &'a RawValue) -> Result<T, Error> {
        self.part(raw.get())
    }

    /// An error about a value, with the place where it begins.
    pub(super) fn error(self, raw: &RawValue, message: impl Into<String>) -> Error {
        Error::sheet_at(self.place(raw.get()), message)
    }

    fn part<T: Deserialize<'a>>(self, part: &'a str) -> Result<T, Error> {
        serde_json::from_str(part).map_err(|error| {
            let (line, column) = self.place(part);
            let place = match error.line() {
                0 | 1 => (line, column + error.column().saturating_sub(1)),
                further => (line + further - 1, error.column()),
            };
            Error::Sheet {
                place: Some(place),
                message: json_words(&error),
                source: Some(error.into()),
            }
        })
    }

    /// Line and column where a part begins, from 1.
    fn place(self, part: &str) -> (usize, usize) {
        let begin = (part.as_ptr() as usize).saturating_sub(self.0.as_ptr() as usize);
        let before = &self.0.as_bytes()[..begin.min(self.0.len())];
        let lines = before.iter().filter(|byte| **byte == b'\n').count();
        let line_begin = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        (lines + 1, before.len() - line_begin + 1)
    }
}
