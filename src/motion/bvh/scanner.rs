//! Tokens of a BVH file, and where they stand.

use super::number::{self, is_blank};
use crate::error::Error;

/// So much of a wrong word is quoted in an error.
const QUOTED_BYTES: usize = 32;

/// A cursor over the bytes of a file. It counts no lines: an error finds its own when it is made.
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
}

/// A token and the byte it starts at; empty at the end of the file.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    pub(super) text: &'a [u8],
    pub(super) at: usize,
}

impl Word<'_> {
    /// Whether this is the keyword, in whatever case.
    pub(super) fn is(&self, keyword: &str) -> bool {
        self.text.eq_ignore_ascii_case(keyword.as_bytes())
    }
}

impl<'a> Scanner<'a> {
    /// A cursor at the first byte after a byte order mark.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), at: 0 }
    }

    /// All of the file, after a byte order mark.
    pub(super) fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// The byte the cursor stands at.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// What is still to be read.
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Skips blanks and line ends; false at the end of the file.
    #[inline]
    pub(super) fn has_more(&mut self) -> bool {
        let mut rest = &self.bytes[self.at..];
        while let [byte, after @ ..] = rest
            && is_blank(*byte)
        {
            rest = after;
        }
        self.at = self.bytes.len() - rest.len();
        !rest.is_empty()
    }

    /// Takes the next token: a brace, or what stands between blanks and braces.
    pub(super) fn word(&mut self) -> Word<'a> {
        let word = self.peek();
        self.at += word.text.len();
        word
    }

    /// The next token, without taking it.
    pub(super) fn peek(&mut self) -> Word<'a> {
        self.has_more();
        let rest = self.rest();
        let length = match rest {
            [b'{' | b'}', ..] => 1,
            _ => rest.iter().position(|&byte| ends_a_word(byte)).unwrap_or(rest.len()),
        };
        Word { text: &rest[..length], at: self.at }
    }

    /// Takes what is left of the line, up to a `{`, without blanks around it.
    pub(super) fn rest_of_line(&mut self) -> Word<'a> {
        let rest = self.rest();
        let ends = |&byte: &u8| matches!(byte, b'\n' | b'\r' | b'{');
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        let blanks = rest[..length].iter().take_while(|&&byte| is_blank(byte)).count();
        let word = Word { text: rest[..length].trim_ascii(), at: self.at + blanks };
        self.at += length;
        word
    }

    /// Takes the keyword `words` and the colon after it, blanks or not between them.
    pub(super) fn label(&mut self, words: &[&str]) -> Result<(), Error> {
        let start = self.peek();
        let found = words.iter().all(|word| self.take(word.as_bytes())) && self.take(b":");
        if found {
            return Ok(());
        }
        Err(self.expected(&format!("\"{}:\"", words.join(" ")), start))
    }

    fn take(&mut self, text: &[u8]) -> bool {
        self.has_more();
        let found = self.rest().get(..text.len()).is_some_and(|it| it.eq_ignore_ascii_case(text));
        self.at += if found { text.len() } else { 0 };
        found
    }

    /// Takes the next number, always finite.
    #[inline]
    pub(super) fn number(&mut self) -> Result<f64, Error> {
        self.has_more();
        match number::scan(self.rest()) {
            Some((value, length)) if value.is_finite() => {
                self.at += length;
                Ok(value)
            }
            _ => Err(self.not_a_number()),
        }
    }

    /// Takes a whole number of at least 0, such as `2` or `2.0`; one too large is the largest.
    pub(super) fn count(&mut self) -> Result<usize, Error> {
        let word = self.peek();
        let value = self.number()?;
        if value < 0.0 || value.fract() != 0.0 {
            return Err(self.expected("a whole number of at least 0", word));
        }
        Ok(value as usize)
    }

    #[cold]
    fn not_a_number(&mut self) -> Error {
        let word = self.peek();
        let has = |byte| word.text.contains(&byte);
        let only = |allowed: &[u8]| word.text.iter().all(|byte| allowed.contains(byte));
        let hint = if number::scan(word.text).is_some() {
            " (it is too large)"
        } else if has(b',') && only(b"0123456789+-,") {
            " (write decimals with a dot)"
        } else if !word.text.is_empty() && only(b"0123456789+-.") {
            " (a blank may be missing)"
        } else {
            ""
        };
        self.error(word.at, format!("expected a number, found {}{hint}", quoted(word.text)))
    }

    /// The error that something else stands where `expected` should.
    #[cold]
    pub(super) fn expected(&self, expected: &str, found: Word) -> Error {
        self.error(found.at, format!("expected {expected}, found {}", quoted(found.text)))
    }

    /// An error at a byte of the file.
    #[cold]
    pub(super) fn error(&self, at: usize, message: impl Into<String>) -> Error {
        let (line, column) = self.place(at);
        Error::Bvh { line, column, message: message.into() }
    }

    /// Line and column of a byte, from 1. Lines end in LF, CRLF or CR.
    pub(super) fn place(&self, at: usize) -> (usize, usize) {
        let (mut line, mut start) = (1, 0);
        for (index, &byte) in self.bytes[..at].iter().enumerate() {
            let ends = match byte {
                b'\n' => true,
                b'\r' => self.bytes.get(index + 1) != Some(&b'\n'),
                _ => false,
            };
            if ends {
                (line, start) = (line + 1, index + 1);
            }
        }
        (line, at - start + 1)
    }
}

fn ends_a_word(byte: u8) -> bool {
    is_blank(byte) || matches!(byte, b'{' | b'}')
}

/// A word as a person should see it.
pub(super) fn quoted(text: &[u8]) -> String {
    if text.is_empty() {
        return "the end of the file".to_owned();
    }
    let shown = String::from_utf8_lossy(&text[..text.len().min(QUOTED_BYTES)]);
    let dots = if text.len() > QUOTED_BYTES { "…" } else { "" };
    format!("\"{}{dots}\"", shown.escape_debug())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_lf_crlf_or_cr_and_columns_are_bytes() {
        let scanner = Scanner::new(b"\xef\xbb\xbfa\nb\r\nc\rd e");
        let places = [0, 1, 2, 3, 5, 7, 9].map(|at| scanner.place(at));
        assert_eq!(places, [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (4, 1), (4, 3)]);
    }

    #[test]
    fn braces_are_tokens_even_when_glued() {
        let mut scanner = Scanner::new(b" a{b}\x0b}");
        let words: Vec<_> =
            std::iter::from_fn(|| Some(scanner.word().text).filter(|text| !text.is_empty()))
                .collect();
        assert_eq!(words, [&b"a"[..], b"{", b"b", b"}", b"}"]);
    }

    #[test]
    fn a_long_or_odd_word_is_cut_and_escaped() {
        assert_eq!(quoted(&[b'x'; 100]), format!("\"{}…\"", "x".repeat(32)));
        assert_eq!(quoted(b"\0\x1b"), "\"\\0\\u{1b}\"");
        assert_eq!(quoted(b""), "the end of the file");
    }
}
