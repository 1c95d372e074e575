//! Splits a BVH file into tokens and keeps track of their places.

use super::line_column::Places;
use super::number::{self, ends_a_word, is_blank};
use super::number_spellings::{self, piece, with_point};
use super::warnings::{DECIMAL_COMMA, GLUED_MINUS, LABEL_SPACING, Notices};
use crate::error::{Error, Place};

/// Most bytes of a wrong word quoted in an error.
const QUOTED_BYTES: usize = 32;

/// A cursor over the text of a file. It counts no lines; an error computes its own line when it is made.
pub(super) struct Scanner<'a> {
    text: &'a [u8],
    at: usize,
    /// Whether a comma may stand for the decimal point.
    pub(super) takes_commas: bool,
    pub(super) notices: Notices,
}

/// A token and the byte it starts at; empty at the end of the file.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    pub(super) text: &'a [u8],
    pub(super) at: usize,
}

impl Word<'_> {
    /// Whether this is the keyword, ignoring case.
    pub(super) fn is(&self, keyword: &str) -> bool {
        self.text.eq_ignore_ascii_case(keyword.as_bytes())
    }
}

impl<'a> Scanner<'a> {
    /// Creates a cursor at the beginning of a text, with the notices collected so far.
    pub(super) fn new(text: &'a [u8], notices: Notices) -> Self {
        Self { text, at: 0, takes_commas: true, notices }
    }

    /// The whole text.
    pub(super) fn text(&self) -> &'a [u8] {
        self.text
    }

    /// The byte offset of the cursor.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// The unread rest of the text.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.text[self.at..]
    }

    /// Skips blanks and line ends; returns false at the end of the file.
    #[inline]
    pub(super) fn has_more(&mut self) -> bool {
        let mut rest = &self.text[self.at..];
        while let [byte, after @ ..] = rest
            && is_blank(*byte)
        {
            rest = after;
        }
        self.at = self.text.len() - rest.len();
        !rest.is_empty()
    }

    /// Takes the next token: a brace, or a run of bytes between blanks and braces.
    pub(super) fn word(&mut self) -> Word<'a> {
        let word = self.peek();
        self.at += word.text.len();
        word
    }

    /// Returns the next token without taking it.
    pub(super) fn peek(&mut self) -> Word<'a> {
        self.has_more();
        word_at(self.text, self.at)
    }

    /// Takes the rest of the line up to a `{`, trimmed of blanks.
    pub(super) fn rest_of_line(&mut self) -> Word<'a> {
        let rest = self.rest();
        let ends = |&byte: &u8| matches!(byte, b'\n' | b'\r' | b'{');
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        let is_mark = |&byte: &u8| !is_blank(byte);
        let begin = rest[..length].iter().position(is_mark).unwrap_or(length);
        let end = rest[..length].iter().rposition(is_mark).map_or(length, |last| last + 1);
        let word = Word { text: &rest[begin..end], at: self.at + begin };
        self.at += length;
        word
    }

    /// Takes a label: the keyword `words` and a colon, with or without blanks between them.
    pub(super) fn label(&mut self, words: &[&str]) -> Result<(), Error> {
        let start = self.peek();
        let is_named = words.iter().all(|word| self.take(word.as_bytes()));
        let end = self.at;
        if !(is_named && self.take(b":")) {
            return Err(self.expected(&format!("\"{}:\"", words.join(" ")), start));
        }
        if self.at > end + 1 {
            self.notices.add(LABEL_SPACING, end, || {
                let label = words.join(" ");
                format!("a blank stands before the colon of \"{label}:\"; some programs find none")
            });
        }
        Ok(())
    }

    fn take(&mut self, text: &[u8]) -> bool {
        self.has_more();
        let found = self.rest().get(..text.len()).is_some_and(|it| it.eq_ignore_ascii_case(text));
        self.at += if found { text.len() } else { 0 };
        found
    }

    /// Takes the next number, which is always finite.
    pub(super) fn number(&mut self) -> Result<f64, Error> {
        self.has_more();
        let at = self.at;
        self.value()?.ok_or_else(|| self.no_value(at, "", ""))
    }

    /// Takes the next number; `None` if a program wrote a non-finite one, such as `nan`.
    pub(super) fn value(&mut self) -> Result<Option<f64>, Error> {
        self.has_more();
        match number::scan(self.rest()) {
            Some((value, length)) if value.is_finite() => {
                self.at += length;
                Ok(Some(value))
            }
            _ => self.odd_value(),
        }
    }

    #[cold]
    fn odd_value(&mut self) -> Result<Option<f64>, Error> {
        let (all, at, text) = (self.text, self.at, piece(self.rest()));
        let has_comma = text.contains(&b',');
        let scanned = if has_comma { with_point(text) } else { number::scan(text) };
        let value = match scanned {
            Some(_) if has_comma && !self.takes_commas => return Err(self.not_a_number()),
            Some((value, _)) => Some(value).filter(|value| value.is_finite()),
            None if number_spellings::is_no_finite_number(text) => None,
            None => return Err(self.not_a_number()),
        };
        let word = || quoted(word_at(all, at).text);
        if has_comma {
            let message = || format!("{} has a decimal comma", word());
            self.notices.add(DECIMAL_COMMA, at, message);
        }
        if self.rest().get(text.len()) == Some(&b'-') {
            let message = || format!("a blank is missing before a minus in {}", word());
            self.notices.add(GLUED_MINUS, at + text.len(), message);
        }
        self.at += text.len();
        Ok(value)
    }

    /// Takes a whole number of at least 0, such as `2` or `2.0`; one too large saturates.
    pub(super) fn count(&mut self) -> Result<usize, Error> {
        let word = self.peek();
        let value = self.number()?;
        if value < 0.0 || value.fract() != 0.0 {
            return Err(self.expected("a whole number of at least 0", word));
        }
        Ok(value as usize)
    }

    #[cold]
    fn not_a_number(&self) -> Error {
        let word = word_at(self.text, self.at);
        let has = |byte| word.text.contains(&byte);
        let is_only = |allowed: &[u8]| word.text.iter().all(|byte| allowed.contains(byte));
        let hint = if has(b',') && is_only(b"0123456789+-,") {
            " (other decimals here are written with a dot)"
        } else if !word.text.is_empty() && is_only(b"0123456789+-.") {
            " (a blank may be missing)"
        } else {
            ""
        };
        self.error(word.at, format!("expected a number, found {}{hint}", quoted(word.text)))
    }

    /// Builds the error for a non-finite number at a byte. `what` describes the expected value, `out`
    /// suggests a way out; both are added to the sentence.
    #[cold]
    pub(super) fn no_value(&self, at: usize, what: &str, out: &str) -> Error {
        let word = word_at(self.text, at).text;
        let hint = if word.contains(&b'#') {
            " (Windows for: this is no number)"
        } else if number::scan(piece(word)).is_some() {
            " (it is too large)"
        } else {
            ""
        };
        self.error(at, format!("expected a number{what}, found {}{hint}{out}", quoted(word)))
    }

    /// Builds the error for an unexpected word.
    #[cold]
    pub(super) fn expected(&self, expected: &str, found: Word) -> Error {
        self.error(found.at, format!("expected {expected}, found {}", quoted(found.text)))
    }

    /// Builds an error at a byte of the text.
    #[cold]
    pub(super) fn error(&self, at: usize, message: impl Into<String>) -> Error {
        let (line, column) = self.place(at);
        Error::Motion { place: Place::Line(line, column), message: message.into() }
    }

    /// Line and column of a byte, both counted from 1.
    pub(super) fn place(&self, at: usize) -> (usize, usize) {
        Places::from_text(self.text).place(at)
    }
}

/// The token at a byte: a brace, or a run of bytes between blanks and braces.
fn word_at(text: &[u8], at: usize) -> Word<'_> {
    let rest = &text[at..];
    let length = match rest {
        [b'{' | b'}', ..] => 1,
        _ => rest.iter().position(|&byte| ends_a_word(byte)).unwrap_or(rest.len()),
    };
    Word { text: &rest[..length], at }
}

/// A word as shown to people: quoted, escaped and cut.
pub(super) fn quoted(text: &[u8]) -> String {
    if text.is_empty() {
        return "the end of the file".to_owned();
    }
    let cut = &text[..text.len().min(QUOTED_BYTES)];
    let shown = String::from_utf8_lossy(cut);
    if cut.len() == text.len() {
        return format!("\"{}\"", shown.escape_debug());
    }
    // The cut may have split a character.
    format!("\"{}…\"", shown.trim_end_matches('\u{fffd}').escape_debug())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braces_are_tokens_even_when_glued() {
        let mut scanner = Scanner::new(b" a{b}\x0b}", Notices::default());
        let words: Vec<_> =
            std::iter::from_fn(|| Some(scanner.word().text).filter(|text| !text.is_empty()))
                .collect();
        assert_eq!(words, [&b"a"[..], b"{", b"b", b"}", b"}"]);
    }

    #[test]
    fn a_long_or_odd_word_is_cut_and_escaped() {
        assert_eq!(quoted(&[b'x'; 100]), format!("\"{}…\"", "x".repeat(32)));
        assert_eq!(quoted("腰".repeat(40).as_bytes()), format!("\"{}…\"", "腰".repeat(10)));
        assert_eq!(quoted(b"\0\x1b"), "\"\\0\\u{1b}\"");
        assert_eq!(quoted(b""), "the end of the file");
    }
}
