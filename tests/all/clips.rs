//! Reads the clips of the tests.

use std::fs;
use std::path::{Path, PathBuf};

use genga::motion::clean::Cleaning;
use genga::motion::{Clip, bvh};

#[path = "../real/mod.rs"]
mod real;

pub(crate) use real::{all, more, name, with, with_all, without};

/// Path of a file in the repository.
pub(crate) fn here(path: &str) -> PathBuf {
    real::repository().join(path)
}

/// Reads a motion of `data/`.
pub(crate) fn sample(name: &str) -> Clip {
    read(&here("data").join(name))
}

/// Reads and cleans a clip as every command does.
pub(crate) fn read(path: &Path) -> Clip {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let clip = bvh::read(&bytes).unwrap_or_else(|error| panic!("{}:{error}", path.display())).clip;
    Cleaning::default().apply(clip).expect("all frames are asked for").0
}
