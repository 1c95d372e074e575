//! What a results folder consists of (目録), so that the next run knows its own files from a person's.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use serde::{Deserialize, Serialize};

use super::sheet_json::digest;
use crate::error::Error;
use crate::motion::Clip;

/// The version of the format, in the file itself.
const SCHEMA: &str = "genga-run-1";

/// The files of a folder, and what they were made of. The same input gives the same manifest: it holds no time of day and
/// no folder of a machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    schema: String,
    /// The version of genga that wrote last.
    pub genga: String,
    /// The motion.
    pub clip: ClipMark,
    /// A digest of recipe and corrections as `recipe.toml` has them; none where a sheet alone was delivered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recipe: Option<String>,
    /// The files by name, with `/` between folders, each with its digest.
    pub files: BTreeMap<String, String>,
}

/// By what a motion is known again, whichever part of it was worked on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClipMark {
    /// The name of its file, without folders.
    pub file: String,
    /// A digest of all channel values.
    pub motion: String,
    /// A digest of hierarchy, offsets and channels.
    pub skeleton: String,
}

impl ClipMark {
    /// The mark of a whole clip, with everything that stands in front of the motion.
    pub fn of(file: &str, clip: &Clip) -> Self {
        Self {
            file: file.into(),
            motion: digest::motion(clip),
            skeleton: digest::skeleton(clip.skeleton()),
        }
    }

    /// Whether it is the same motion, whatever its file is called.
    pub fn is_of(&self, other: &Self) -> bool {
        (&self.motion, &self.skeleton) == (&other.motion, &other.skeleton)
    }
}

impl Manifest {
    /// The manifest of a folder in which nothing was written yet.
    pub fn new(clip: ClipMark) -> Self {
        let genga = env!("CARGO_PKG_VERSION").into();
        Self { schema: SCHEMA.into(), genga, clip, recipe: None, files: BTreeMap::new() }
    }

    /// The digest of a file by which [`files`](Self::files) knows it.
    pub fn digest(bytes: &[u8]) -> String {
        digest::bytes(bytes)
    }

    /// Whether a file is listed and is still as it was written.
    pub fn has(&self, name: &str, digest: &str) -> bool {
        self.files.get(name).is_some_and(|listed| listed == digest)
    }

    /// Reads it.
    ///
    /// # Errors
    /// [`Error::Encoding`] for what is no manifest of this version.
    pub fn read(text: &str) -> Result<Self, Error> {
        let read: Self = serde_json::from_str(text).map_err(failed)?;
        if read.schema != SCHEMA {
            return Err(failed(format!("the schema is {}, not {SCHEMA}", read.schema)));
        }
        // What it lists may be removed.
        match read.files.keys().find(|name| !is_inside(name)) {
            Some(outside) => Err(failed(format!("{outside} is not in its folder"))),
            None => Ok(read),
        }
    }

    /// Its text.
    ///
    /// # Errors
    /// [`Error::Encoding`] never happens: it is plain data.
    pub fn write(&self) -> Result<String, Error> {
        Ok(serde_json::to_string_pretty(self).map_err(failed)? + "\n")
    }
}

/// Whether a name stays in its folder.
fn is_inside(name: &str) -> bool {
    !name.is_empty()
        && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

fn failed(source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Error {
    Error::Encoding { what: "a manifest", source: source.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_manifest_reads_back_and_knows_its_files() {
        let clip = crate::deliver::tests::wave();
        let mut manifest = Manifest::new(ClipMark::of("kick.bvh", &clip));
        manifest.files.insert("images/A_0001.png".into(), Manifest::digest(b"drawn"));
        let read = Manifest::read(&manifest.write().unwrap()).unwrap();
        assert_eq!(read, manifest);
        assert!(read.has("images/A_0001.png", &Manifest::digest(b"drawn")));
        assert!(!read.has("images/A_0001.png", &Manifest::digest(b"painted")));
        assert!(!read.has("images/A_0002.png", &Manifest::digest(b"drawn")));
        let later = manifest.write().unwrap().replace(SCHEMA, "genga-run-2");
        assert!(Manifest::read(&later).unwrap_err().to_string().contains("genga-run-2"));
        assert!(Manifest::read("{}").is_err());
        for outside in ["../kick.bvh", "/kick.bvh", "images/../../kick.bvh", ""] {
            let text = manifest.write().unwrap().replace("images/A_0001.png", outside);
            assert!(Manifest::read(&text).is_err(), "{outside}");
        }
    }

    #[test]
    fn a_digest_sees_every_byte_and_the_length() {
        let digest = Manifest::digest;
        assert_eq!(digest(b"genga"), digest(b"genga"));
        for other in [&b""[..], b"gengb", b"genga\0", b"genga\0\0\0", b"\0genga"] {
            assert_ne!(digest(b"genga"), digest(other), "{other:?}");
        }
        let long: Vec<u8> = (0..100).collect();
        for at in 0..long.len() {
            let mut other = long.clone();
            other[at] ^= 0x80;
            assert_ne!(digest(&long), digest(&other), "byte {at}");
        }
    }
}
