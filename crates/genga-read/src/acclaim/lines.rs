//! Splits a text into lines of words with their places, the syntax of both Acclaim files.

use genga::error::{Error, Place};

/// A word of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Word<'a> {
    pub(super) text: &'a str,
    /// Line number, from 1.
    pub(super) line: usize,
    /// Column in bytes, from 1.
    pub(super) column: usize,
}

/// A line with at least one word; its comment is removed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'a> {
    text: &'a str,
    number: usize,
}

/// The lines of a text that contain words.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let lines = text.split('\n').enumerate().map(|(at, text)| {
        let text = text.split('#').next().unwrap_or_default();
        Line { text, number: at + 1 }
    });
    lines.filter(|line| !line.text.trim().is_empty())
}

impl<'a> Line<'a> {
    /// The words of the line.
    pub(super) fn words(&self) -> impl Iterator<Item = Word<'a>> + use<'a> {
        let Self { text, number } = *self;
        text.split_ascii_whitespace().map(move |word| {
            // The word is a slice of the line, so the difference of the pointers gives its column.
            let column = word.as_ptr() as usize - text.as_ptr() as usize + 1;
            Word { text: word, line: number, column }
        })
    }

    /// The first word of the line.
    pub(super) fn first(&self) -> Word<'a> {
        self.words().next().unwrap_or(Word { text: "", line: self.number, column: 1 })
    }

    /// An empty word at the end of the line.
    pub(super) fn end(&self) -> Word<'a> {
        Word { text: "", line: self.number, column: self.text.trim_end().len() + 1 }
    }
}

impl Word<'_> {
    /// Whether this is the word, ignoring case.
    pub(super) fn is(&self, word: &str) -> bool {
        self.text.eq_ignore_ascii_case(word)
    }

    /// Builds the error that something else was expected here.
    pub(super) fn instead_of(&self, expected: &str) -> Error {
        let found = if self.text.is_empty() {
            "the end of the line".to_owned()
        } else {
            format!("{:?}", self.text.chars().take(40).collect::<String>())
        };
        self.wrong(format!("expected {expected}, found {found}"))
    }

    /// Builds an error at this place.
    pub(super) fn wrong(&self, message: impl Into<String>) -> Error {
        Error::Motion { place: Place::Line(self.line, self.column), message: message.into() }
    }

    /// Parses the word as a finite number.
    pub(super) fn number(&self) -> Result<f64, Error> {
        let number = self.text.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| self.instead_of("a number"))
    }
}
