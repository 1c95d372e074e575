//! What every reader takes and gives, whatever its format.

mod given;
mod takes;

use std::path::PathBuf;

use crate::error::{Error, Warning};
use crate::motion::read::bvh;
use crate::motion::{Axis, BoneMap, Clip, StreamLimit};
use crate::time::FrameRate;

pub use given::Given;
pub use takes::{TAKES, Take};

/// How a motion file is read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Makes the first warning of the reader an error. Default: false.
    pub strict: bool,
    /// Holds the value before one that is no number: of a BVH. Default: false, an error.
    pub repair: bool,
    /// Frames a second, whatever the file says. Rows stay and are shown slower or faster; curves are sampled at it, and
    /// what is between the samples is lost. Default: none, the file's.
    pub fps: Option<FrameRate>,
    /// The root of the one tree of joints to read. Default: none, all trees.
    pub root: Option<String>,
    /// The take to read, of a file that has several. Default: none, the first in which a joint moves.
    pub take: Option<String>,
    /// The file that has the bones, of a format whose motions have none: a model of MMD (`.pmx`, `.pmd`) for a VMD, an
    /// `.asf` for an AMC. Default: none, a figure of usual proportions, and the `.asf` that lies beside it.
    pub skeleton: Option<PathBuf>,
    /// The axis that points up, whatever the file says. Default: none, as the file declares or as the body stands.
    pub up: Option<Axis>,
    /// A person's table of bones: which joints are head and limbs. Default: none, as names say or the body's shape.
    pub bones: Option<BoneMap>,
    /// How much is read of what is no regular file, and of a file that is read whole. What is sampled of curves, or
    /// unpacked, may take as much again.
    pub stream: StreamLimit,
}

/// What a reader gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The motion.
    pub clip: Clip,
    /// What a person should know about the file.
    pub warnings: Vec<Warning>,
    /// Seconds a frame as the file writes them, where it does.
    pub written_frame_time: Option<f64>,
    /// What the file is, and what was made of it: unit, axes, rate. Empty for a BVH, whose values stay as written.
    pub found: Vec<Found>,
    /// Its takes, where the format has them.
    pub takes: Vec<Take>,
}

/// Something that a reader found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// A word: `format`, `unit`, `up`.
    pub what: &'static str,
    /// What it is, in words.
    pub is: String,
}

impl Found {
    /// Something that was found.
    pub fn new(what: &'static str, is: impl Into<String>) -> Self {
        Self { what, is: is.into() }
    }

    /// What a reader leaves out of a file: of each kind how many, where there are any.
    pub(super) fn left_out(kinds: &[(usize, &str)]) -> Option<Self> {
        let there = kinds.iter().filter(|(count, _)| *count > 0);
        let counted: Vec<String> = there.map(|(count, what)| format!("{what} ({count})")).collect();
        let message = format!("left out: {}", counted.join(", "));
        (!counted.is_empty()).then(|| Self::new("left out", message))
    }
}

/// Names at the most in a sentence.
const MOST: usize = 12;

/// Names in a sentence, not too many.
pub(super) fn join_names(names: &[impl std::borrow::Borrow<str>]) -> String {
    let more = if names.len() > MOST { ", …" } else { "" };
    format!("{}{more}", names[..names.len().min(MOST)].join(", "))
}

impl Options {
    /// As [`takes::choose`] has it.
    pub(super) fn choose(&self, takes: &[Take]) -> Result<Option<(usize, Option<Warning>)>, Error> {
        takes::choose(self.take.as_deref(), takes)
    }

    /// Refuses a take that is asked for and not there.
    pub(super) fn check_take(&self, takes: &[Take]) -> Result<(), Error> {
        takes::check(self.take.as_deref(), takes)
    }

    /// What BVH knows of these.
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
