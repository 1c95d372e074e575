//! Defines the input and output of every reader.

mod given;
mod takes;

use std::path::PathBuf;

use genga::error::{Error, Warning};
use genga::motion::bvh;
use genga::motion::{Axis, BoneMap, Clip, StreamLimit};
use genga::time::FrameRate;

pub use given::Given;
pub(crate) use given::{read_beside, shortened};
pub use takes::{TAKES, Take};

/// Options for reading a motion file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Makes the reader's first warning an error. Default: false.
    pub strict: bool,
    /// Replaces a non-finite value of a BVH by the value before it. Default: false, which makes it an
    /// error.
    pub repair: bool,
    /// Frames per second, whatever the file says. The rows of a table stay and play slower or faster.
    /// Curves are sampled at this rate, so detail between the samples is lost. Default: none, the file's.
    pub fps: Option<FrameRate>,
    /// Root of the one tree of joints to read. Default: none, all trees.
    pub root: Option<String>,
    /// Take to read, if a file has several. Default: none, the first in which a joint moves.
    pub take: Option<String>,
    /// File with the bones, for formats whose motions have none: an MMD model (`.pmx`, `.pmd`) for a VMD,
    /// an `.asf` for an AMC. Default: none, which means a figure of usual proportions, and the `.asf`
    /// beside the motion.
    pub skeleton: Option<PathBuf>,
    /// File with the camera of the take, a VMD or a glTF, over one in the motion's own file. It begins with the motion.
    /// Default: none.
    pub camera: Option<PathBuf>,
    /// Axis that points up, whatever the file says. Default: none, as the file declares or as the body
    /// stands.
    pub up: Option<Axis>,
    /// The user's bone map, which assigns joints to head and limbs. Default: none, derived from names or
    /// the body's shape.
    pub bones: Option<BoneMap>,
    /// Limit for input that is not a regular file, and for files that are read whole. Sampled curves and
    /// unpacked data may take the same amount again.
    pub stream: StreamLimit,
}

/// The result of reading a motion file.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The motion.
    pub clip: Clip,
    /// Warnings about the file.
    pub warnings: Vec<Warning>,
    /// Seconds per frame as written in the file, if it says so.
    pub written_frame_time: Option<f64>,
    /// Facts about the file and its conversion: format, unit, axes, rate. Empty for a BVH, whose values
    /// stay as written.
    pub found: Vec<Found>,
    /// The takes of the file, for formats with takes.
    pub takes: Vec<Take>,
}

/// A fact that a reader found about a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// Its kind: `format`, `unit`, `up`.
    pub what: &'static str,
    /// Its value, in words.
    pub is: String,
}

impl Found {
    /// Creates a fact.
    pub fn new(what: &'static str, is: impl Into<String>) -> Self {
        Self { what, is: is.into() }
    }

    /// Lists the parts of a file that a reader leaves out, with the number of each kind; `None` if there
    /// are none.
    #[cfg(feature = "fbx")]
    pub(super) fn left_out(kinds: &[(usize, &str)]) -> Option<Self> {
        Some(Self::new("left out", format!("left out: {}", counted(kinds)?)))
    }
}

/// Lists kinds of things with the number of each: `cameras (1), shapes (2)`; `None` if there are none.
pub(super) fn counted(kinds: &[(usize, &str)]) -> Option<String> {
    let there = kinds.iter().filter(|(count, _)| *count > 0);
    let counted: Vec<String> = there.map(|(count, what)| format!("{what} ({count})")).collect();
    (!counted.is_empty()).then(|| counted.join(", "))
}

/// Most names listed in a sentence.
const MOST: usize = 12;

/// Joins names for a sentence, with an ellipsis if there are too many.
pub(super) fn join_names(names: &[impl std::borrow::Borrow<str>]) -> String {
    let more = if names.len() > MOST { ", …" } else { "" };
    format!("{}{more}", names[..names.len().min(MOST)].join(", "))
}

impl Options {
    /// Chooses a take, see [`takes::choose`].
    pub(super) fn choose(&self, takes: &[Take]) -> Result<Option<(usize, Option<Warning>)>, Error> {
        takes::choose(self.take.as_deref(), takes)
    }

    /// Rejects a requested take that does not exist.
    pub(super) fn check_take(&self, takes: &[Take]) -> Result<(), Error> {
        takes::check(self.take.as_deref(), takes)
    }

    /// The options that apply to BVH.
    pub(super) fn for_bvh(&self) -> bvh::Options {
        let Self { strict, repair, fps, ref root, stream, .. } = *self;
        bvh::Options { strict, repair, fps, root: root.clone(), stream }
    }
}

impl From<bvh::Read> for Read {
    fn from(read: bvh::Read) -> Self {
        let bvh::Read { clip, warnings, written_frame_time } = read;
        let written_frame_time = Some(written_frame_time);
        Self { clip, warnings, written_frame_time, found: Vec::new(), takes: Vec::new() }
    }
}
