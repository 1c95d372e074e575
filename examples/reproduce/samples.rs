//! The synthetic clips of `data/`, which stand in for captures that are not public.

use std::fs;

use genga::motion::{Clip, bvh};

use crate::{Outcome, root};

/// Reads the clip `data/NAME.bvh`.
pub(crate) fn clip(name: &str) -> Outcome<Clip> {
    let path = root().join(format!("data/{name}.bvh"));
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let bytes = fs::read(&path).map_err(|error| failed(&error))?;
    Ok(bvh::read(&bytes).map_err(|error| failed(&error))?.clip)
}
