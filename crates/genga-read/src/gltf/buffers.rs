//! Loads a document's buffers: from the GLB chunk, from a data URI, or from a file beside it.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::PathBuf;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::document::Document;
use super::wrong;
use crate::reading::{Given, Options, read_beside};
use genga::error::{Error, Place};
use genga::motion::StreamLimit;

/// Base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// All buffers, each loaded on first use. Buffers of one file share its bytes, and all files together take at most what
/// one may: else a short document that names a large file a thousand times fills the memory.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    given: &'a Given<'a>,
    chunk: Option<&'a [u8]>,
    /// What the files may still bring.
    left: StreamLimit,
    loaded: Vec<Cow<'a, [u8]>>,
    /// Index of each buffer's bytes in `loaded`.
    places: Vec<Option<usize>>,
    /// The same of each file.
    files: HashMap<PathBuf, usize>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        document: &'a Document,
        given: &'a Given<'a>,
        options: &'a Options,
        chunk: Option<&'a [u8]>,
    ) -> Self {
        let places = vec![None; document.buffers.len()];
        let (left, loaded, files) = (options.stream, Vec::new(), HashMap::new());
        Self { document, given, chunk, left, loaded, places, files }
    }

    /// The bytes of a buffer.
    pub(super) fn get(&mut self, at: usize) -> Result<&[u8], Error> {
        let place = match self.places.get(at) {
            None => return Err(wrong(format!("buffers[{at}]"), "there is no such buffer")),
            Some(Some(place)) => *place,
            Some(None) => self.load(at)?,
        };
        self.places[at] = Some(place);
        Ok(&self.loaded[place])
    }

    /// Loads the bytes of a URI of another part: data in it, or a file beside the document.
    pub(super) fn load_uri(&mut self, uri: &str, part: &str) -> Result<Vec<u8>, Error> {
        match inline(uri) {
            Some(text) => {
                let bytes = text.and_then(|text| BASE64.decode(text).ok());
                bytes.ok_or_else(|| wrong(part, "its data is no base64"))
            }
            None => {
                let at = self.load_file(&unescaped(uri), Place::Part(part.to_owned()))?;
                Ok(self.loaded[at].to_vec())
            }
        }
    }

    /// Loads a buffer, and returns the index of its bytes.
    fn load(&mut self, at: usize) -> Result<usize, Error> {
        let part = format!("buffers[{at}]");
        let uri = self.document.buffers[at].uri.as_deref();
        let bytes = match (uri, self.chunk) {
            (None, Some(chunk)) if at == 0 => Cow::Borrowed(chunk),
            (None, _) => return Err(wrong(part, "its bytes are missing: the file is cut off")),
            (Some(uri), _) => match inline(uri) {
                Some(text) => {
                    let bytes = text.and_then(|text| BASE64.decode(text).ok());
                    Cow::Owned(bytes.ok_or_else(|| wrong(part, "its data is no base64"))?)
                }
                None => return self.load_file(&unescaped(uri), Place::Part(part)),
            },
        };
        self.loaded.push(bytes);
        Ok(self.loaded.len() - 1)
    }

    fn load_file(&mut self, name: &str, place: Place) -> Result<usize, Error> {
        let path = self.given.find_beside(name, &place)?;
        if let Some(at) = self.files.get(&path) {
            return Ok(*at);
        }
        let bytes = read_beside(&path, place, self.left)?;
        self.left.bytes -= bytes.len() as u64;
        self.loaded.push(Cow::Owned(bytes));
        self.files.insert(path, self.loaded.len() - 1);
        Ok(self.loaded.len() - 1)
    }
}

/// The base64 of a `data:` URI, if it has some; `None` if the URI names a file. Both words may be in capitals.
fn inline(uri: &str) -> Option<Option<&str>> {
    let scheme = uri.get(..5)?;
    if !scheme.eq_ignore_ascii_case("data:") {
        return None;
    }
    let (kind, text) = uri.split_once(',').unwrap_or_default();
    let ending = kind.len().checked_sub(7).and_then(|from| kind.get(from..));
    Some(ending.filter(|word| word.eq_ignore_ascii_case(";base64")).map(|_| text))
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

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;
    use crate::gltf::document::Buffer;

    /// What buffers with these URIs bring from a folder in which `a.bin` and `b.bin` have 600 bytes each.
    fn loaded<T>(uris: &[&str], limit: u64, look: impl Fn(&mut Buffers<'_>) -> T) -> T {
        let place = tempfile::tempdir().unwrap();
        for name in ["a.bin", "b.bin"] {
            fs::write(place.path().join(name), [7; 600]).unwrap();
        }
        let buffers = uris.iter().map(|uri| Buffer { uri: Some((*uri).to_owned()) }).collect();
        let document = Document { buffers, ..Document::default() };
        let path: &Path = &place.path().join("clip.gltf");
        let given = Given { bytes: b"", path: Some(path) };
        let options = Options { stream: StreamLimit { bytes: limit }, ..Options::default() };
        look(&mut Buffers::new(&document, &given, &options, None))
    }

    #[test]
    fn a_file_is_read_once_however_often_and_however_it_is_named() {
        let uris: Vec<&str> =
            ["a.bin", "./a.bin", "%61.bin"].into_iter().cycle().take(2000).collect();
        loaded(&uris, 1000, |buffers| {
            for at in 0..uris.len() {
                assert_eq!(buffers.get(at).unwrap().len(), 600, "{at}");
            }
            assert_eq!(buffers.loaded.len(), 1);
        });
    }

    #[test]
    fn all_files_together_bring_no_more_than_one_may() {
        loaded(&["a.bin", "b.bin"], 1200, |buffers| {
            assert!(buffers.get(0).is_ok() && buffers.get(1).is_ok())
        });
        loaded(&["a.bin", "b.bin"], 1199, |buffers| {
            assert!(buffers.get(0).is_ok());
            let error = buffers.get(1).unwrap_err().to_string();
            assert!(
                error.starts_with("buffers[1]: it needs b.bin beside it: more than"),
                "{error}"
            );
        });
    }

    #[test]
    fn a_data_uri_may_be_in_capitals() {
        let uris = ["DATA:Application/Octet-Stream;BASE64,AQID", "data:;base64,AQID", "data:,AQID"];
        loaded(&uris, 0, |buffers| {
            assert_eq!(buffers.get(0).unwrap(), [1, 2, 3]);
            assert_eq!(buffers.get(1).unwrap(), [1, 2, 3]);
            assert!(buffers.get(2).unwrap_err().to_string().contains("no base64"));
        });
    }
}
