//! Where clips come from.

use std::fs;
use std::path::{Path, PathBuf};

use genga::motion::{Clip, bvh};

#[path = "../real/mod.rs"]
mod real;

pub(crate) use real::{all, more, name, with, with_all, without};

/// A file in the repository.
pub(crate) fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// A motion of `data/`.
pub(crate) fn sample(name: &str) -> Clip {
    read(&here("data").join(name))
}

/// A clip as every command takes it.
pub(crate) fn read(path: &Path) -> Clip {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let clip = bvh::read(&bytes).unwrap_or_else(|error| panic!("{}:{error}", path.display())).clip;
    bvh::Cleaning::default().of(clip).expect("all frames are asked for").0
}
