//! Loads a document's buffers: from the GLB chunk, from a data URI, or from a file beside it.

use std::borrow::Cow;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::document::Document;
use super::wrong;
use crate::reading::{Given, Options};
use genga::error::{Error, Place};

/// Base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// All buffers, each loaded on first use.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    given: &'a Given<'a>,
    options: &'a Options,
    chunk: Option<&'a [u8]>,
    read: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        document: &'a Document,
        given: &'a Given<'a>,
        options: &'a Options,
        chunk: Option<&'a [u8]>,
    ) -> Self {
        let read = vec![None; document.buffers.len()];
        Self { document, given, options, chunk, read }
    }

    /// The bytes of a buffer.
    pub(super) fn get(&mut self, at: usize) -> Result<&[u8], Error> {
        let part = || format!("buffers[{at}]");
        let Some(place) = self.read.get_mut(at) else {
            return Err(wrong(part(), "there is no such buffer"));
        };
        if place.is_none() {
            let uri = self.document.buffers[at].uri.as_deref();
            *place = Some(match (uri, self.chunk) {
                (None, Some(chunk)) if at == 0 => Cow::Borrowed(chunk),
                (None, _) => {
                    return Err(wrong(part(), "its bytes are missing: the file is cut off"));
                }
                (Some(uri), _) => Cow::Owned(loaded(uri, part(), self.given, self.options)?),
            });
        }
        Ok(place.as_deref().unwrap_or_default())
    }
}

/// Loads the data of a URI.
fn loaded(uri: &str, part: String, given: &Given<'_>, options: &Options) -> Result<Vec<u8>, Error> {
    if let Some(data) = uri.strip_prefix("data:") {
        let text = data.split_once(";base64,").map(|(_, text)| text);
        let bytes = text.and_then(|text| BASE64.decode(text).ok());
        return bytes.ok_or_else(|| wrong(part, "its data is no base64"));
    }
    given.beside(&unescaped(uri), Place::Part(part), options)
}

/// Decodes a URI to a file name: `%20` is a blank.
fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, others @ ..] = rest {
        let code = (*first == b'%').then(|| others.get(..2)).flatten();
        let code = code.and_then(|code| std::str::from_utf8(code).ok());
        let code = code.and_then(|code| u8::from_str_radix(code, 16).ok());
        bytes.push(code.unwrap_or(*first));
        rest = if code.is_some() { &others[2..] } else { others };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
