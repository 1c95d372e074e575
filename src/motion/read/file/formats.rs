//! The formats that motion comes in, a row each.

use std::path::Path;

use crate::error::{Error, Place};
use crate::motion::read::reading::{Given, Options, Read};
use crate::motion::read::{acclaim, fbx, gltf, mmd};

/// A format that motion comes in (形式).
#[derive(Debug)]
pub struct Format {
    /// What people call it.
    pub name: &'static str,
    /// How its files end, in small letters and without the dot. Folders are searched for these.
    pub endings: &'static [&'static str],
    /// What it can hold, in words.
    pub holds: &'static str,
    /// Whether its motion is curves, which are sampled at any rate.
    pub(super) has_curves: bool,
    /// Whether its bones are in a file of their own, which can be named.
    pub(super) has_skeleton_file: bool,
    /// Whether a file begins as one of this format.
    pub(super) begins: fn(&[u8]) -> bool,
    /// Reads a file that is taken for one.
    pub(super) read: fn(&Given<'_>, &Options) -> Result<Read, Error>,
}

/// All of them, the native one first.
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
        name: "TRC, C3D",
        // No folder is searched for them: there is nothing to read.
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
];

impl Format {
    /// The format of a file: by its first bytes, and where they say nothing by its ending. What is called as none of
    /// them is taken for a BVH.
    pub(super) fn of(head: &[u8], path: Option<&Path>) -> &'static Self {
        let by_content = FORMATS.iter().find(|format| (format.begins)(head));
        let by_ending = || FORMATS.iter().find(|format| path.is_some_and(|path| format.ends(path)));
        by_content.or_else(by_ending).unwrap_or(&FORMATS[0])
    }

    /// Whether a path ends as files of this format do.
    pub fn ends(&self, path: &Path) -> bool {
        let ending = path.extension().unwrap_or_default();
        self.endings.iter().any(|own| ending.eq_ignore_ascii_case(own))
    }

    /// Whether it is BVH, which has a way of its own to be opened.
    pub(super) fn is_native(&self) -> bool {
        std::ptr::eq(self, &FORMATS[0]) || self.name == FORMATS[0].name
    }
}

/// Whether there is the word that a BVH begins with: in UTF-16 there are zeros in it.
fn is_bvh(head: &[u8]) -> bool {
    let letters = head.iter().filter(|byte| byte.is_ascii_alphabetic());
    let word = letters.take(9).map(u8::to_ascii_uppercase);
    word.eq(*b"HIERARCHY")
}

/// Whether a file is one of markers: TRC has a word for it, C3D a number of its first block and then 80.
fn is_points(head: &[u8]) -> bool {
    head.starts_with(b"PathFileType")
        || matches!(head, [2..=10, 0x50, _, _, ..]) && head.len() >= 512
}

/// What is said of markers.
const POINTS: &str = "these are the paths of markers and no skeleton: solve them in the program of the capture, and give what \
                      it exports with joints (BVH, FBX, glTF, AMC)";

/// What is said of a model.
const MODEL: &str =
    "this is a model of MMD and no motion: give a motion for it (.vmd), and this with --skeleton";

fn refused(message: &str) -> Error {
    Error::Motion { place: Place::Whole, message: message.into() }
}
