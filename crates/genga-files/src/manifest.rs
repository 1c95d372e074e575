//! The manifest of a results folder (目録), which lets the next run tell its own files from a person's.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use serde::{Deserialize, Serialize};

use super::sheet_json::digest;
use genga::error::Error;
use genga::motion::Clip;

/// The version of the format, stored in the file.
const SCHEMA: &str = "genga-run-1";

/// The files of a results folder and their input. The same input gives the same manifest, because it holds
/// neither a time nor a path of the machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    schema: String,
    /// The version of genga that wrote the folder last.
    pub genga: String,
    /// The motion that the files were made of.
    pub clip: ClipMark,
    /// Digest of recipe and corrections as in `recipe.toml`; `None` if only a sheet was delivered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recipe: Option<String>,
    /// Names of the formats that the files belong to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub formats: Vec<String>,
    /// Settings of the formats that differ from their defaults, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub settings: BTreeMap<String, String>,
    /// Settings of the recipe that a target found, by name: the words before and after the search.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub found: BTreeMap<String, [String; 2]>,
    /// Digests of the files, by name with `/` between folders.
    pub files: BTreeMap<String, String>,
}

/// The identity of a motion, whichever part of it was used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClipMark {
    /// The name of its file, without folders.
    pub file: String,
    /// Digest of all channel values.
    pub motion: String,
    /// Digest of hierarchy, offsets and channels.
    pub skeleton: String,
}

impl ClipMark {
    /// Computes the mark of a whole clip, including frames before the motion.
    pub fn new(file: &str, clip: &Clip) -> Self {
        Self {
            file: file.into(),
            motion: digest::motion(clip),
            skeleton: digest::skeleton(clip.skeleton()),
        }
    }

    /// Whether both are the same motion, whatever the files are called.
    pub fn is_of(&self, other: &Self) -> bool {
        (&self.motion, &self.skeleton) == (&other.motion, &other.skeleton)
    }
}

impl Manifest {
    /// Creates the manifest of a folder in which nothing has been written yet.
    pub fn new(clip: ClipMark) -> Self {
        let genga = env!("CARGO_PKG_VERSION").into();
        Self {
            schema: SCHEMA.into(),
            genga,
            clip,
            recipe: None,
            formats: vec![],
            settings: BTreeMap::new(),
            found: BTreeMap::new(),
            files: BTreeMap::new(),
        }
    }

    /// Computes a file's digest as listed in [`files`](Self::files).
    pub fn digest(bytes: &[u8]) -> String {
        digest::bytes(bytes)
    }

    /// Whether a file is listed and unchanged since it was written.
    pub fn has(&self, name: &str, digest: &str) -> bool {
        self.files.get(name).is_some_and(|listed| listed == digest)
    }

    /// Whether a name of a file stays inside its folder, so that the listed file may be deleted.
    pub fn is_inside(name: &str) -> bool {
        let is_plain = |part| matches!(part, Component::Normal(_));
        !name.is_empty() && Path::new(name).components().all(is_plain)
    }

    /// Reads a manifest.
    ///
    /// # Errors
    /// [`Error::Encoding`] if the text is not a manifest of this version.
    pub fn read(text: &str) -> Result<Self, Error> {
        let read: Self = serde_json::from_str(text).map_err(failed)?;
        if read.schema != SCHEMA {
            return Err(failed(format!("the schema is {}, not {SCHEMA}", read.schema)));
        }
        match read.files.keys().find(|name| !Self::is_inside(name)) {
            Some(outside) => Err(failed(format!("{outside} is not in its folder"))),
            None => Ok(read),
        }
    }

    /// Writes the manifest as JSON.
    ///
    /// # Errors
    /// Never fails in practice, because the manifest is plain data; the signature allows [`Error::Encoding`].
    pub fn write(&self) -> Result<String, Error> {
        Ok(serde_json::to_string_pretty(self).map_err(failed)? + "\n")
    }
}

fn failed(source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Error {
    Error::Encoding { what: "a manifest", source: source.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_manifest_reads_back_and_knows_its_files() {
        let clip = crate::tests::wave();
        let mut manifest = Manifest::new(ClipMark::new("kick.bvh", &clip));
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
