//! Lists the motion file formats, one row each.

use std::path::Path;

use crate::reading::{Given, Options, Read};
use crate::{HEAD, acclaim, fbx, foreign, gltf, mmd};
use genga::error::{Error, Place};

/// A motion file format (形式).
#[derive(Debug)]
pub struct Format {
    /// The common name of the format.
    pub name: &'static str,
    /// File extensions, in lower case and without the dot. Folder searches look for these.
    pub endings: &'static [&'static str],
    /// The kind of data that it can hold, in words.
    pub holds: &'static str,
    /// Whether its motion consists of curves, which can be sampled at any rate.
    pub(super) has_curves: bool,
    /// Whether its bones are in a separate file, which the user can name.
    pub(super) has_skeleton_file: bool,
    /// Tests whether the first bytes of a file are of this format.
    pub(super) begins: fn(&[u8]) -> bool,
    /// Reads a file of this format.
    pub(super) read: fn(&Given<'_>, &Options) -> Result<Read, Error>,
}

/// All formats, the native one first.
pub const FORMATS: &[Format] = &[
    Format {
        name: "BVH",
        endings: &["bvh"],
        holds: "one take of joints, a row of angles a frame",
        has_curves: false,
        has_skeleton_file: false,
        begins: is_bvh,
        read: |given, options| Ok(options.for_bvh().read(given.bytes)?.into()),
    },
    Format {
        name: "FBX",
        endings: &["fbx"],
        holds: "takes of bones or nodes, as curves",
        has_curves: true,
        has_skeleton_file: false,
        begins: fbx::begins,
        read: fbx::read,
    },
    Format {
        name: "glTF",
        endings: &["glb", "gltf", "vrma", "vrm"],
        holds: "animations of joints or nodes, as curves; GLB and VRM are glTF",
        has_curves: true,
        has_skeleton_file: false,
        begins: gltf::begins,
        read: gltf::read,
    },
    Format {
        name: "VMD",
        endings: &["vmd"],
        holds: "keys of the bones of an MMD model, with curves between them",
        has_curves: false,
        has_skeleton_file: true,
        begins: mmd::is_motion,
        read: mmd::read,
    },
    Format {
        name: "ASF/AMC",
        endings: &["amc"],
        holds: "one take of bones, a row of angles a frame; the skeleton is an .asf beside it",
        has_curves: false,
        has_skeleton_file: true,
        begins: |head| acclaim::is_motion(head) || acclaim::is_skeleton(head),
        read: acclaim::read,
    },
    Format {
        name: MARKERS,
        // Folder searches skip these formats, since they cannot be read.
        endings: &[],
        holds: "points, which are no skeleton: they are refused",
        has_curves: false,
        has_skeleton_file: false,
        begins: is_points,
        read: |_, _| Err(refused(POINTS)),
    },
    Format {
        name: "PMX, PMD",
        endings: &[],
        holds: "a model of MMD, which has no motion: it is refused, and goes with a VMD",
        has_curves: false,
        has_skeleton_file: false,
        begins: |head| head.starts_with(b"PMX ") || head.starts_with(b"Pmd"),
        read: |_, _| Err(refused(MODEL)),
    },
    Format {
        name: "others",
        endings: &[],
        holds: "scenes of Blender and Maya, USD, archives, pictures, films: they are refused",
        has_curves: false,
        has_skeleton_file: false,
        begins: foreign::begins,
        read: |given, _| Err(foreign::refuse(given.bytes)),
    },
];

impl Format {
    /// Determines the format of a file from its first bytes, or else from its extension. A file of an
    /// unknown extension is taken for a BVH.
    pub(super) fn detect(head: &[u8], path: Option<&Path>) -> &'static Self {
        let by_content = FORMATS.iter().find(|format| (format.begins)(head));
        let by_ending = || FORMATS.iter().find(|format| path.is_some_and(|path| format.ends(path)));
        let is_c3d =
            path.and_then(Path::extension).is_some_and(|own| own.eq_ignore_ascii_case("c3d"));
        let refused_by_ending = || FORMATS.iter().find(|format| is_c3d && format.name == MARKERS);
        by_content.or_else(by_ending).or_else(refused_by_ending).unwrap_or(&FORMATS[0])
    }

    /// Whether a path has an extension of this format.
    pub fn ends(&self, path: &Path) -> bool {
        let ending = path.extension().unwrap_or_default();
        self.endings.iter().any(|own| ending.eq_ignore_ascii_case(own))
    }

    /// Determines the format of a motion from its first bytes; `None` if they are of none that is read. JSON is of glTF
    /// if it has an `asset`.
    pub fn of_motion(bytes: &[u8]) -> Option<&'static Self> {
        let head = &bytes[..bytes.len().min(HEAD)];
        let is_motion = |format: &&Self| !format.endings.is_empty() && (format.begins)(head);
        let is_other_json = head.trim_ascii_start().starts_with(b"{")
            && memchr::memmem::find(bytes, b"\"asset\"").is_none();
        FORMATS.iter().find(is_motion).filter(|_| !is_other_json)
    }

    /// Names all formats in the error of a file that does not even begin like the one it was taken for.
    pub(super) fn explain(&self, error: Error, head: &[u8]) -> Error {
        let is_taken = self.is_native() && !(self.begins)(head);
        if is_taken { foreign::with_formats(error) } else { error }
    }

    /// Whether this is BVH, which is opened by its own reader.
    pub(super) fn is_native(&self) -> bool {
        std::ptr::eq(self, &FORMATS[0]) || self.name == FORMATS[0].name
    }
}

/// Whether the text begins with the BVH keyword. Other bytes are skipped, since UTF-16 puts zeros between
/// the letters.
fn is_bvh(head: &[u8]) -> bool {
    let letters = head.iter().filter(|byte| byte.is_ascii_alphabetic());
    let word = letters.take(9).map(u8::to_ascii_uppercase);
    word.eq(*b"HIERARCHY")
}

/// Whether a file holds marker positions. TRC begins with a keyword, C3D with the number of its first block
/// and then 80.
fn is_points(head: &[u8]) -> bool {
    head.starts_with(b"PathFileType")
        || matches!(head, [2..=10, 0x50, _, _, ..]) && head.len() >= 512
}

/// The formats of markers.
const MARKERS: &str = "TRC, C3D";

/// Message for marker files.
const POINTS: &str = "these are the paths of markers and no skeleton: solve them in the program of the capture, and give what \
                      it exports with joints (BVH, FBX, glTF, AMC)";

/// Message for models.
const MODEL: &str =
    "this is a model of MMD and no motion: give a motion for it (.vmd), and this with --skeleton";

fn refused(message: &str) -> Error {
    Error::Motion { place: Place::Whole, message: message.into() }
}
