//! How a motion writes its names (文字コード): MMD in CP932, other programs in other encodings, each cut to its field.

use std::collections::{HashMap, HashSet};

use encoding_rs::{Encoding, GBK, SHIFT_JIS, UTF_8};

use super::figure;

/// Bytes of a bone's name: a longer one is cut.
pub(super) const WIDTH: usize = 15;

/// The encodings that are tried, MMD's own first: of equal ones the first is taken.
const ENCODINGS: [&Encoding; 3] = [SHIFT_JIS, UTF_8, GBK];

/// The names of a motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Names {
    encoding: &'static Encoding,
    /// MMD's standard bones, by what is written for them.
    standard: HashMap<Vec<u8>, String>,
}

impl Names {
    /// The names of bones are written in the encoding in which most of them are standard ones; of equal ones in that in
    /// which most of them are text.
    pub(super) fn of(fields: &HashSet<&[u8]>) -> Self {
        let known = |names: &Self| {
            let standard = |field: &&&[u8]| names.standard.contains_key(up_to_zero(field));
            let is_text =
                |field: &&&[u8]| !names.encoding.decode_without_bom_handling(up_to_zero(field)).1;
            (fields.iter().filter(standard).count(), fields.iter().filter(is_text).count())
        };
        // The last of equal ones is the greatest: so the first comes last.
        let tried = ENCODINGS.into_iter().rev().map(Self::in_encoding);
        tried.max_by_key(known).unwrap_or_else(|| Self::in_encoding(SHIFT_JIS))
    }

    fn in_encoding(encoding: &'static Encoding) -> Self {
        let written = |bone: figure::RestBone| (field(&bone.name, encoding), bone.name);
        Self { encoding, standard: figure::bones().into_iter().map(written).collect() }
    }

    /// A name up to its first zero: the whole name of a standard bone, though the field has cut it.
    pub(super) fn read(&self, field: &[u8]) -> String {
        let written = up_to_zero(field);
        let standard = self.standard.get(written).cloned();
        let decoded = || self.encoding.decode_without_bom_handling(written).0.into_owned();
        standard.unwrap_or_else(decoded)
    }

    /// A bone's name as the motion has it.
    pub(super) fn of_bone(&self, name: &str) -> String {
        self.read(&field(name, self.encoding))
    }

    /// The encoding, where it is not MMD's own.
    pub(super) fn foreign(&self) -> Option<&'static str> {
        (self.encoding != SHIFT_JIS).then(|| self.encoding.name())
    }
}

/// What stands in the field of a bone's name.
fn field(name: &str, encoding: &'static Encoding) -> Vec<u8> {
    let bytes = encoding.encode(name).0;
    bytes[..bytes.len().min(WIDTH)].to_vec()
}

fn up_to_zero(field: &[u8]) -> &[u8] {
    field.split(|byte| *byte == 0).next().unwrap_or_default()
}
