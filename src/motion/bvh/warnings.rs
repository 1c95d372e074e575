//! Defines the warning codes of the BVH reader, and collects warnings.

use super::line_column::Places;
use crate::error::Warning;

/// The number of complete frames differs from the declared one.
pub const FRAMES_MISMATCH: &str = "W_FRAMES_MISMATCH";
/// A joint has no name; it is called `joint_N`.
pub const NAME_MISSING: &str = "W_NAME_MISSING";
/// Two joints have the same name; the later one is called `NAME.2`.
pub const NAME_TWICE: &str = "W_NAME_TWICE";
/// The text is not UTF-8 but Shift-JIS or UTF-16.
pub const ENCODING: &str = "W_ENCODING";
/// Decimals are written with a comma.
pub const DECIMAL_COMMA: &str = "W_DECIMAL_COMMA";
/// A minus stands directly after the number before it.
pub const GLUED_MINUS: &str = "W_GLUED_MINUS";
/// A channel is neither a position nor a rotation; its column is left out.
pub const CHANNEL_UNKNOWN: &str = "W_CHANNEL_UNKNOWN";
/// The count of CHANNELS differs from the number of names; the names win.
pub const CHANNEL_COUNT: &str = "W_CHANNEL_COUNT";
/// An End Site has channels; their columns are left out.
pub const END_SITE_CHANNELS: &str = "W_END_SITE_CHANNELS";
/// A joint has the same channel twice.
pub const AXIS_TWICE: &str = "W_AXIS_TWICE";
/// NUL bytes or a Ctrl-Z follow the text.
pub const TRAILING_BYTES: &str = "W_TRAILING_BYTES";
/// A blank stands before the colon of `Frames:` or `Frame Time:`.
pub const LABEL_SPACING: &str = "W_LABEL_SPACING";
/// A frame lasts a second or more, as in a list of poses.
pub const POSES: &str = "W_POSES";
/// The file has several trees of joints, and the user chose none.
pub const ROOTS: &str = "W_ROOTS";
/// Repaired: a value was not finite and is replaced by the one before it.
pub const VALUE_HELD: &str = "W_VALUE_HELD";
/// Repaired: a row was too long and its surplus values are dropped.
pub const ROW_CUT: &str = "W_ROW_CUT";

/// Every code of this reader. [`LeadIn`](crate::motion::clean::LeadIn) adds `W_LEAD_IN`.
pub const ALL: [&str; 16] = [
    FRAMES_MISMATCH,
    NAME_MISSING,
    NAME_TWICE,
    ENCODING,
    DECIMAL_COMMA,
    GLUED_MINUS,
    CHANNEL_UNKNOWN,
    CHANNEL_COUNT,
    END_SITE_CHANNELS,
    AXIS_TWICE,
    TRAILING_BYTES,
    LABEL_SPACING,
    POSES,
    ROOTS,
    VALUE_HELD,
    ROW_CUT,
];

/// Warnings in the making: one per code, so that a file with a fault in every line takes no more memory
/// than a file with one fault.
#[derive(Default)]
pub(super) struct Notices(Vec<Notice>);

struct Notice {
    code: &'static str,
    at: usize,
    count: usize,
    message: String,
}

impl Notices {
    /// Records a notice about a byte of the text. `message` is called only for the first notice of a code.
    pub(super) fn add(&mut self, code: &'static str, at: usize, message: impl FnOnce() -> String) {
        match self.0.iter_mut().find(|notice| notice.code == code) {
            Some(notice) => notice.count += 1,
            None => self.0.push(Notice { code, at, count: 1, message: message() }),
        }
    }

    /// Byte offset of the first notice of a code.
    pub(super) fn first(&self, code: &str) -> Option<usize> {
        self.0.iter().find(|notice| notice.code == code).map(|notice| notice.at)
    }

    /// Converts the notices to warnings, in the order of the text.
    pub(super) fn into_warnings(mut self, text: &[u8]) -> Vec<Warning> {
        self.0.sort_by_key(|notice| notice.at);
        let mut places = Places::from_text(text);
        let warning = |notice: Notice| {
            let Notice { code, at, count, mut message } = notice;
            if count > 1 {
                message.push_str(&format!(" (the first of {count})"));
            }
            Warning::at(places.place(at), code, message)
        };
        self.0.into_iter().map(warning).collect()
    }
}
