//! Decodes the names of a motion (文字コード): MMD writes CP932, other programs use other encodings, and each
//! name is cut to its field.

use std::collections::{HashMap, HashSet};

use encoding_rs::{Encoding, GBK, SHIFT_JIS, UTF_8};

use super::usual_skeleton;

/// Bytes of a bone-name field; longer names are cut.
pub(super) const WIDTH: usize = 15;

/// Encodings to try, MMD's own first; a tie goes to the earlier one.
const ENCODINGS: [&Encoding; 3] = [SHIFT_JIS, UTF_8, GBK];

/// The name encoding of a motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Names {
    encoding: &'static Encoding,
    /// MMD's standard bones, by their encoded and cut names.
    standard: HashMap<Vec<u8>, String>,
}

impl Names {
    /// Detects the encoding in which most names are standard bones; a tie goes to the encoding with the
    /// most valid text.
    pub(super) fn new(fields: &HashSet<&[u8]>) -> Self {
        let known = |names: &Self| {
            let standard = |field: &&&[u8]| names.standard.contains_key(up_to_zero(field));
            let is_text =
                |field: &&&[u8]| !names.encoding.decode_without_bom_handling(up_to_zero(field)).1;
            (fields.iter().filter(standard).count(), fields.iter().filter(is_text).count())
        };
        // `max_by_key` returns the last of equal elements, so the order is reversed.
        let tried = ENCODINGS.into_iter().rev().map(Self::in_encoding);
        tried.max_by_key(known).unwrap_or_else(|| Self::in_encoding(SHIFT_JIS))
    }

    fn in_encoding(encoding: &'static Encoding) -> Self {
        let written = |bone: usual_skeleton::RestBone| (field(&bone.name, encoding), bone.name);
        Self { encoding, standard: usual_skeleton::bones().into_iter().map(written).collect() }
    }

    /// Decodes a name up to its first zero. A standard bone gets its whole name, even if the field cut it.
    pub(super) fn read(&self, field: &[u8]) -> String {
        let written = up_to_zero(field);
        let standard = self.standard.get(written).cloned();
        let decoded = || self.encoding.decode_without_bom_handling(written).0.into_owned();
        standard.unwrap_or_else(decoded)
    }

    /// A bone's name as it appears in the motion.
    pub(super) fn of_bone(&self, name: &str) -> String {
        self.read(&field(name, self.encoding))
    }

    /// The encoding, if it is not MMD's own.
    pub(super) fn foreign(&self) -> Option<&'static str> {
        (self.encoding != SHIFT_JIS).then(|| self.encoding.name())
    }
}

/// The encoded name of a bone, cut to its field.
fn field(name: &str, encoding: &'static Encoding) -> Vec<u8> {
    let bytes = encoding.encode(name).0;
    bytes[..bytes.len().min(WIDTH)].to_vec()
}

pub(super) fn up_to_zero(field: &[u8]) -> &[u8] {
    field.split(|byte| *byte == 0).next().unwrap_or_default()
}
