//! Opens a motion file of any format that genga reads (どの形式でも): the entry point for every clip.
//!
//! [`FORMATS`] lists the formats. The first bytes of a file determine its format; its extension decides
//! only if they do not. To add a format, write a reader and add its row: it takes a [`Given`] and the
//! [`Options`], and returns a [`Read`]. Its errors are [`Error::Motion`] with a place in the file; its
//! findings go into [`Read::found`].
//!
//! [`bvh`](genga::motion::bvh) is the native format, whose files are read in blocks. All other files are
//! read whole, up to the limit of [`Options::stream`].

// A test may compare with the standard library.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

mod acclaim;
mod fbx;
mod foreign;
mod gltf;
mod gltf_camera;
mod input_formats;
mod mmd;
mod other_camera;
mod posed;
mod rates;
mod reading;
#[cfg(test)]
#[path = "../../../tests/real/mod.rs"]
mod real;
#[cfg(test)]
#[path = "../../../tests/stage.rs"]
mod stage;
#[cfg(test)]
mod tests;
mod track;

use std::fs::File;
use std::io::{Read as _, Seek};
use std::path::Path;

use genga::error::{Error, Place, Warning};
use genga::motion::bvh::no_tree;
use genga::motion::{Declared, StreamLimit, Word, bytes_in_words};

pub use gltf::{Carrier, GltfNode, GltfScene, GltfTrack};
pub use gltf_camera::GltfCamera;
pub use input_formats::{FORMATS, Format};
pub use mmd::{
    MORPH_NAME, MmdLeg, MmdModel, VmdBeside, VmdCamera, VmdCameraKey, is_motion as is_vmd,
    key_frames as vmd_key_frames,
};
pub use rates::KEY_FAR;
pub use reading::{Found, Given, Options, Read, TAKES, Take};
pub use track::{Between, Track};

/// Warning that tells how a file other than BVH was interpreted.
pub const FORMAT: &str = "W_FORMAT";

/// Number of leading bytes that determine the format.
const HEAD: usize = 4096;

/// Opens (開く) a motion file as [`Options::open`] does by default.
///
/// # Errors
/// Errors of [`Options::open`].
///
/// ```
/// let read = genga_read::open("../../data/kick.bvh".as_ref())?;
/// assert_eq!((read.clip.len(), read.found.len()), (92, 0));
/// # Ok::<(), genga::Error>(())
/// ```
pub fn open(path: &Path) -> Result<Read, Error> {
    Options::default().open(path)
}

impl Options {
    /// Opens a file of any format: BVH like [`bvh::Options::open`](genga::motion::bvh::Options::open),
    /// others as a whole.
    ///
    /// # Errors
    /// [`Error::Io`] if the file cannot be read, and the errors of [`Options::read`].
    pub fn open(&self, path: &Path) -> Result<Read, Error> {
        self.with_camera(self.opened(path)?)
    }

    fn opened(&self, path: &Path) -> Result<Read, Error> {
        let failed = |source| Error::Io { path: path.to_owned(), source };
        let mut file = File::open(path).map_err(failed)?;
        let about = file.metadata().map_err(failed)?;
        if !about.is_file() {
            return self.given(&self.stream.read(file).map_err(failed)?, Some(path));
        }
        let mut bytes = Vec::new();
        (&mut file).take(HEAD as u64).read_to_end(&mut bytes).map_err(failed)?;
        let format = Format::detect(&bytes, Some(path));
        self.check(format)?;
        if format.is_native() {
            let read =
                self.for_bvh().open(path).map_err(|error| format.explain(error, &bytes))?.into();
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

    /// Reads a file of any format from memory. Files beside it, to which it may refer, are not available.
    ///
    /// # Errors
    /// [`Error::Motion`] with the place if the file is invalid. [`Error::Setting`] if the requested take or tree does not exist, or if the format takes no
    /// skeleton file.
    pub fn read(&self, bytes: &[u8]) -> Result<Read, Error> {
        self.with_camera(self.given(bytes, None)?)
    }

    fn given(&self, bytes: &[u8], path: Option<&Path>) -> Result<Read, Error> {
        let head = &bytes[..bytes.len().min(HEAD)];
        let format = Format::detect(head, path);
        self.check(format)?;
        let read = self.read_as(format, &Given { bytes, path });
        read.map_err(|error| format.explain(error, head))
    }

    /// Rejects options that the format does not support.
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

    /// Applies the user's declarations, which override those of the file.
    fn declare(&self, read: Read) -> Read {
        let of_file = read.clip.declared();
        let up = self.up.map(|up| (up, Word::Person)).or(of_file.up);
        let bones = self.bones.as_ref().map(|bones| bones.limbs_said(&read.clip));
        let declared = Declared { up, metres: of_file.metres, ..bones.unwrap_or(of_file) };
        Read { clip: read.clip.with_declared(declared), ..read }
    }

    /// Rejects a requested root that does not exist. Formats with a single tree do not select one
    /// themselves.
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
