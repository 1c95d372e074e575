//! Where clips come from.

use std::fs;
use std::path::{Path, PathBuf};

use genga::motion::{Clip, bvh};

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

/// The paths of the real clips, sorted; none when the folder is not there, which is an error in CI.
#[allow(clippy::print_stderr, reason = "a test that tests nothing must say so")]
pub(crate) fn real() -> Vec<PathBuf> {
    let folder = here("../shared/data/bvh");
    let Ok(entries) = fs::read_dir(&folder) else {
        let missing =
            format!("NO REAL CLIPS: {} is not there, nothing was tested", folder.display());
        assert!(std::env::var_os("CI").is_none(), "{missing}");
        eprintln!("{missing}");
        return Vec::new();
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "bvh"));
    paths.sort();
    paths
}

/// A clip's name.
pub(crate) fn name(path: &Path) -> String {
    path.file_stem().unwrap().to_string_lossy().into_owned()
}
