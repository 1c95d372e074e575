//! A motion file of any format that genga reads (どの形式でも): the door through which every clip comes.
//!
//! [`FORMATS`] has a row a format. A file's first bytes say which it is; its ending decides only where they do not. A new
//! reader is a file and a row: it takes a [`Given`] and the [`Options`], and gives a [`Read`]. Its errors are
//! [`Error::Motion`], with a place in the file; what it found is told in [`Read::found`].
//!
//! [`bvh`](super::bvh) is the native format. Its files are read in blocks, as they always were; all others are read
//! whole, up to the limit of [`Options::stream`].

mod formats;
mod given;
mod takes;
#[cfg(test)]
pub(super) mod tests;

use std::fs::File;
use std::io::{Read as _, Seek};
use std::path::{Path, PathBuf};

use crate::error::{Error, Place, Warning};
use crate::motion::{Clip, StreamLimit, bytes_in_words};
use crate::time::FrameRate;

pub use formats::{FORMATS, Format};
pub use given::Given;
pub use takes::Take;

/// What a person should know of a file that is no BVH: as what it was read.
pub const FORMAT: &str = "W_FORMAT";
/// The file has several takes, and none was asked for.
pub const TAKES: &str = "W_TAKES";

/// Bytes by which a format is known.
const HEAD: usize = 4096;

/// How a motion file is read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Makes the first warning of the reader an error. Default: false.
    pub strict: bool,
    /// Holds the value before one that is no number: of a BVH. Default: false, an error.
    pub repair: bool,
    /// The rate, whatever the file says: the frames stay, they are shown slower or faster. Default: none, the file's.
    pub fps: Option<FrameRate>,
    /// The root of the one tree of joints to read. Default: none, all trees.
    pub root: Option<String>,
    /// The take to read, of a file that has several. Default: none, the first in which a joint moves.
    pub take: Option<String>,
    /// Frames a second at which curves are sampled. Default: none, the file's own rate. Lowered, what is between
    /// the samples is lost.
    pub sample_rate: Option<FrameRate>,
    /// The file that has the bones, of a format whose motions have none: a model of MMD (`.pmx`, `.pmd`) for a VMD, an
    /// `.asf` for an AMC. Default: none, a figure of usual proportions, and the `.asf` that lies beside it.
    pub skeleton: Option<PathBuf>,
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
}

/// Opens (開く) a motion file as [`Options::open`] does by default.
///
/// # Errors
/// As [`Options::open`].
///
/// ```
/// let read = genga::motion::file::open("data/kick.bvh".as_ref())?;
/// assert_eq!((read.clip.len(), read.found.len()), (92, 0));
/// # Ok::<(), genga::Error>(())
/// ```
pub fn open(path: &Path) -> Result<Read, Error> {
    Options::default().open(path)
}

impl Options {
    /// Opens a file of any format: a BVH as [`bvh::Options::open`](super::bvh::Options::open) does, others whole.
    ///
    /// # Errors
    /// [`Error::Io`] when the file cannot be read, and those of [`Options::read`].
    pub fn open(&self, path: &Path) -> Result<Read, Error> {
        let failed = |source| Error::Io { path: path.to_owned(), source };
        let mut file = File::open(path).map_err(failed)?;
        let about = file.metadata().map_err(failed)?;
        if !about.is_file() {
            return self.given(&self.stream.read(file).map_err(failed)?, Some(path));
        }
        let mut bytes = Vec::new();
        (&mut file).take(HEAD as u64).read_to_end(&mut bytes).map_err(failed)?;
        let format = Format::of(&bytes, Some(path));
        self.check(format)?;
        if format.is_native() {
            return Ok(self.for_bvh().open(path)?.into());
        }
        if about.len() > self.stream.bytes {
            return Err(too_large(format, about.len(), self.stream));
        }
        file.rewind().map_err(failed)?;
        bytes.clear();
        file.take(self.stream.bytes).read_to_end(&mut bytes).map_err(failed)?;
        self.read_as(format, &Given { bytes: &bytes, path: Some(path) })
    }

    /// Reads a file of any format from memory. What it keeps in files beside it is not there then.
    ///
    /// # Errors
    /// [`Error::Bvh`] of a BVH and [`Error::Motion`] of others, with the place, where a file is not what it should
    /// be. [`Error::Setting`] where no take, no tree and no curve is there that was asked for.
    pub fn read(&self, bytes: &[u8]) -> Result<Read, Error> {
        self.given(bytes, None)
    }

    /// As [`takes::choose`] has it.
    pub(super) fn choose(&self, takes: &[Take]) -> Result<Option<(usize, Option<Warning>)>, Error> {
        takes::choose(self.take.as_deref(), takes)
    }

    /// What BVH knows of these.
    pub(super) fn for_bvh(&self) -> super::bvh::Options {
        let Self { strict, repair, fps, ref root, stream, .. } = *self;
        super::bvh::Options { strict, repair, fps, root: root.clone(), stream }
    }

    fn given(&self, bytes: &[u8], path: Option<&Path>) -> Result<Read, Error> {
        let format = Format::of(&bytes[..bytes.len().min(HEAD)], path);
        self.check(format)?;
        self.read_as(format, &Given { bytes, path })
    }

    /// Refuses what a format cannot have.
    fn check(&self, format: &Format) -> Result<(), Error> {
        if self.sample_rate.is_some() && !format.has_curves {
            let message = format!(
                "{} has a row a frame, and no curves to sample; --fps gives its frames another rate",
                format.name
            );
            return Err(Error::setting("sample-rate", message));
        }
        if self.skeleton.is_some() && !format.has_skeleton_file {
            let message =
                format!("{} has its bones itself, and takes none of another file", format.name);
            return Err(Error::setting("skeleton", message));
        }
        Ok(())
    }

    fn read_as(&self, format: &Format, given: &Given<'_>) -> Result<Read, Error> {
        let mut read = (format.read)(given, self)?;
        takes::check(self.take.as_deref(), &read.takes)?;
        if format.is_native() {
            return Ok(read);
        }
        if let (true, Some(Warning { code, message, .. })) = (self.strict, read.warnings.first()) {
            let message = format!("{message} [{code}]");
            return Err(Error::Motion { place: Place::Whole, message });
        }
        if let Some(fps) = self.fps {
            read.clip = read.clip.with_rate(fps);
        }
        let words: Vec<&str> = read.found.iter().map(|found| found.is.as_str()).collect();
        read.warnings.push(Warning::new(FORMAT, format!("read as {}", words.join("; "))));
        Ok(read)
    }
}

impl From<super::bvh::Read> for Read {
    fn from(read: super::bvh::Read) -> Self {
        let super::bvh::Read { clip, warnings, written_frame_time } = read;
        let written_frame_time = Some(written_frame_time);
        Self { clip, warnings, written_frame_time, found: Vec::new(), takes: Vec::new() }
    }
}

fn too_large(format: &Format, size: u64, limit: StreamLimit) -> Error {
    let (size, most) = (bytes_in_words(size as f64), bytes_in_words(limit.bytes as f64));
    let message = format!(
        "{size} of {} have to be in memory at once, and {most} are allowed; --memory GIB allows more",
        format.name
    );
    Error::Motion { place: Place::Whole, message }
}
