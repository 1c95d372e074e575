//! A motion file of any format that genga reads (どの形式でも): the door through which every clip comes.
//!
//! [`FORMATS`] has a row a format. A file's first bytes say which it is; its ending decides only where they do not. A new
//! reader is a file and a row: it takes a [`Given`] and the [`Options`], and gives a [`Read`]. Its errors are
//! [`Error::Motion`], with a place in the file; what it found is told in [`Read::found`].
//!
//! [`bvh`](super::bvh) is the native format. Its files are read in blocks, as they always were; all others are read
//! whole, up to the limit of [`Options::stream`].

mod formats;
#[cfg(test)]
pub(super) mod tests;

use std::fs::File;
use std::io::{Read as _, Seek};
use std::path::Path;

use super::bvh::no_tree;
use crate::error::{Error, Place, Warning};
use crate::motion::{Declared, StreamLimit, Word, bytes_in_words};

pub use super::rates::KEY_FAR;
pub use super::reading::{Found, Given, Options, Read, TAKES, Take};
pub use formats::{FORMATS, Format};

/// What a person should know of a file that is no BVH: as what it was read.
pub const FORMAT: &str = "W_FORMAT";

/// Bytes by which a format is known.
const HEAD: usize = 4096;

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
            let read = self.for_bvh().open(path)?.into();
            self.check_take(&[])?;
            return Ok(self.declare(read));
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

    fn given(&self, bytes: &[u8], path: Option<&Path>) -> Result<Read, Error> {
        let format = Format::of(&bytes[..bytes.len().min(HEAD)], path);
        self.check(format)?;
        self.read_as(format, &Given { bytes, path })
    }

    /// Refuses what a format cannot have.
    fn check(&self, format: &Format) -> Result<(), Error> {
        if self.skeleton.is_some() && !format.has_skeleton_file {
            let message =
                format!("{} has its bones itself, and takes none of another file", format.name);
            return Err(Error::setting("skeleton", message));
        }
        Ok(())
    }

    fn read_as(&self, format: &Format, given: &Given<'_>) -> Result<Read, Error> {
        if given.bytes.is_empty() && !format.is_native() {
            let message = format!("the file is empty; expected {}", format.name);
            return Err(Error::Motion { place: Place::Whole, message });
        }
        let mut read = (format.read)(given, self)?;
        self.check_take(&read.takes)?;
        if format.is_native() {
            return Ok(self.declare(read));
        }
        self.check_root(&read)?;
        if let (true, Some(Warning { code, message, .. })) = (self.strict, read.warnings.first()) {
            let message = format!("{message} [{code}]");
            return Err(Error::Motion { place: Place::Whole, message });
        }
        if let Some(fps) = self.fps.filter(|_| !format.has_curves) {
            read.clip = read.clip.with_rate(fps);
        }
        let words: Vec<&str> = read.found.iter().map(|found| found.is.as_str()).collect();
        read.warnings.push(Warning::new(FORMAT, format!("read as {}", words.join("; "))));
        Ok(self.declare(read))
    }

    /// Puts a person's word before the file's.
    fn declare(&self, read: Read) -> Read {
        let of_file = read.clip.declared();
        let up = self.up.map(|up| (up, Word::Person)).or(of_file.up);
        let bones = self.bones.as_ref().map(|bones| bones.limbs_said(read.clip.skeleton()));
        let declared = Declared { up, metres: of_file.metres, ..bones.unwrap_or(of_file) };
        Read { clip: read.clip.with_declared(declared), ..read }
    }

    /// Refuses a root that is asked for and not there: some formats have one tree, and choose none.
    fn check_root(&self, read: &Read) -> Result<(), Error> {
        let joints = &read.clip.skeleton().joints;
        let roots = joints.iter().filter(|joint| joint.parent.is_none());
        let names: Vec<&str> = roots.map(|joint| joint.name.as_str()).collect();
        match self.root.as_deref().filter(|root| !names.contains(root)) {
            None => Ok(()),
            Some(root) => Err(no_tree(root, &names.join(", "))),
        }
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
