//! The codes of everything a BVH file may be warned of, and how warnings are gathered.

use super::places::Places;
use crate::error::Warning;

/// The file has more or fewer complete frames than it says.
pub const FRAMES_MISMATCH: &str = "W_FRAMES_MISMATCH";
/// A joint has no name; it is called `joint_N`.
pub const NAME_MISSING: &str = "W_NAME_MISSING";
/// Two joints have one name; the later one is called `NAME.2`.
pub const NAME_TWICE: &str = "W_NAME_TWICE";
/// The text is not UTF-8 but Shift-JIS or UTF-16.
pub const ENCODING: &str = "W_ENCODING";
/// Decimals are written with a comma.
pub const DECIMAL_COMMA: &str = "W_DECIMAL_COMMA";
/// A minus stands directly after the number before it.
pub const GLUED_MINUS: &str = "W_GLUED_MINUS";
/// A channel is neither a position nor a rotation; its column is left out.
pub const CHANNEL_UNKNOWN: &str = "W_CHANNEL_UNKNOWN";
/// CHANNELS says another number than there are names; the names count.
pub const CHANNEL_COUNT: &str = "W_CHANNEL_COUNT";
/// An End Site has channels; their columns are left out.
pub const END_SITE_CHANNELS: &str = "W_END_SITE_CHANNELS";
/// A joint has one channel twice.
pub const AXIS_TWICE: &str = "W_AXIS_TWICE";
/// NUL bytes or a Ctrl-Z follow the text.
pub const TRAILING_BYTES: &str = "W_TRAILING_BYTES";
/// A blank stands before the colon of `Frames:` or `Frame Time:`.
pub const LABEL_SPACING: &str = "W_LABEL_SPACING";
/// A frame lasts a second or more, as in a list of poses.
pub const POSES: &str = "W_POSES";
/// The file has several trees of joints, and none was asked for.
pub const ROOTS: &str = "W_ROOTS";
/// Repaired: a value was no finite number.
pub const VALUE_HELD: &str = "W_VALUE_HELD";
/// Repaired: a row was too long.
pub const ROW_CUT: &str = "W_ROW_CUT";

/// Every code of this reader. [`LeadIn`](super::LeadIn) adds `W_LEAD_IN`.
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

/// Warnings while they are gathered: one a code, so that a file which is odd in every line costs no
/// more memory than one which is odd once.
#[derive(Default)]
pub(super) struct Notices(Vec<Notice>);

struct Notice {
    code: &'static str,
    at: usize,
    count: usize,
    message: String,
}

impl Notices {
    /// Notes something about a byte of the text. The sentence is made for the first of a code alone.
    pub(super) fn add(&mut self, code: &'static str, at: usize, message: impl FnOnce() -> String) {
        match self.0.iter_mut().find(|notice| notice.code == code) {
            Some(notice) => notice.count += 1,
            None => self.0.push(Notice { code, at, count: 1, message: message() }),
        }
    }

    /// Where the first of a code is.
    pub(super) fn first(&self, code: &str) -> Option<usize> {
        self.0.iter().find(|notice| notice.code == code).map(|notice| notice.at)
    }

    /// All of them as warnings about the text, in its order.
    pub(super) fn into_warnings(mut self, text: &[u8]) -> Vec<Warning> {
        self.0.sort_by_key(|notice| notice.at);
        let mut places = Places::of(text);
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
