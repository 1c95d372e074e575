//! Decodes a file to UTF-8, whatever its encoding, and drops junk bytes at its end.

use std::borrow::Cow;

use encoding_rs::{Encoding, SHIFT_JIS, UTF_16BE, UTF_16LE};

use super::line_column::Places;
use super::number::is_blank;
use super::warnings::{ENCODING, Notices, TRAILING_BYTES};
use crate::error::{Error, Place};

/// Decodes a file to UTF-8. Only names can hold more than ASCII, so everything after the line MOTION is
/// kept as it is, and an ordinary file is not copied.
pub(super) fn decode<'a>(bytes: &'a [u8], notices: &mut Notices) -> Result<Cow<'a, [u8]>, Error> {
    let text = match bytes {
        [0xef, 0xbb, 0xbf, text @ ..] => from_names(text, notices)?,
        [0xff, 0xfe, text @ ..] => Cow::Owned(from_utf_16(text, UTF_16LE, notices)?),
        [0xfe, 0xff, text @ ..] => Cow::Owned(from_utf_16(text, UTF_16BE, notices)?),
        text => from_names(text, notices)?,
    };
    let length = without_trailing_bytes(&text, notices);
    Ok(match text {
        Cow::Borrowed(text) => Cow::Borrowed(&text[..length]),
        Cow::Owned(mut text) => {
            text.truncate(length);
            Cow::Owned(text)
        }
    })
}

fn from_utf_16(
    text: &[u8],
    encoding: &'static Encoding,
    notices: &mut Notices,
) -> Result<Vec<u8>, Error> {
    notices.add(ENCODING, 0, || "the file is UTF-16; save it as UTF-8".into());
    match encoding.decode_without_bom_handling_and_without_replacement(text) {
        Some(text) => Ok(text.into_owned().into_bytes()),
        None => {
            let message = "the file begins as UTF-16 does, but is not UTF-16 text";
            Err(Error::Motion { place: Place::Line(1, 1), message: message.into() })
        }
    }
}

/// Decodes text whose names are UTF-8 or, failing that, CP932, the Windows variant of Shift-JIS. This must
/// precede the split into words, because the second byte of a character may be a brace.
fn from_names<'a>(text: &'a [u8], notices: &mut Notices) -> Result<Cow<'a, [u8]>, Error> {
    let (head, table) = text.split_at(begin_of_motion(text));
    let Err(wrong) = std::str::from_utf8(head) else { return Ok(Cow::Borrowed(text)) };
    if !is_hierarchy(head) {
        // The file may be a picture; the hierarchy reader will report that it is no BVH file.
        return Ok(Cow::Borrowed(text));
    }
    let Some(names) = SHIFT_JIS.decode_without_bom_handling_and_without_replacement(head) else {
        let (line, column) = Places::from_text(text).place(wrong.valid_up_to());
        let message = "the names are neither UTF-8 nor Shift-JIS text; save the file as UTF-8";
        return Err(Error::Motion { place: Place::Line(line, column), message: message.into() });
    };
    // Everything before the first such byte is ASCII, so its offset is the same in the decoded text.
    let first = head.iter().position(|byte| !byte.is_ascii()).unwrap_or(0);
    notices.add(ENCODING, first, || "the names are Shift-JIS; save the file as UTF-8".into());
    let mut decoded = names.into_owned().into_bytes();
    decoded.extend_from_slice(table);
    Ok(Cow::Owned(decoded))
}

fn is_hierarchy(head: &[u8]) -> bool {
    let begin = head.iter().position(|&byte| !is_blank(byte)).unwrap_or(0);
    let word = head[begin..].get(..9);
    word.is_some_and(|word| word.eq_ignore_ascii_case(b"HIERARCHY"))
}

/// Start of the line MOTION; the end of the text if that line is missing.
fn begin_of_motion(text: &[u8]) -> usize {
    let mut at = 0;
    for line in text.split(|byte| matches!(byte, b'\n' | b'\r')) {
        let word = line.trim_ascii_start().get(..6);
        if word.is_some_and(|word| word.eq_ignore_ascii_case(b"MOTION")) {
            return at;
        }
        at += line.len() + 1;
    }
    text.len()
}

/// The length of the text without trailing NUL and Ctrl-Z bytes and the blanks among them.
fn without_trailing_bytes(text: &[u8], notices: &mut Notices) -> usize {
    let is_junk = |byte: u8| matches!(byte, 0 | 0x1a);
    let is_text = |&byte: &u8| !is_junk(byte) && !is_blank(byte);
    let end = text.iter().rposition(is_text).map_or(0, |last| last + 1);
    let Some(junk) = text[end..].iter().position(|&byte| is_junk(byte)) else { return text.len() };
    let at = end + junk;
    let count = text[at..].iter().filter(|&&byte| is_junk(byte)).count();
    notices.add(TRAILING_BYTES, at, || {
        let s = if count == 1 { " follows" } else { "s follow" };
        format!("{count} NUL or Ctrl-Z byte{s} the text; left out")
    });
    at
}
