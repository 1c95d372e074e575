//! Reference keys: frames, another result, or a file of keys.

use std::fs;
use std::path::PathBuf;

use genga::Error;
use genga::motion::Clip;
use genga::time::Frame;
use genga_files::reference_keys;
use pyo3::prelude::*;

use crate::clip::Given;
use crate::error::{raised, raised_of};
use crate::judge::text_of;
use crate::result::Result;
use crate::words::unexpected;

/// What is accepted, for messages.
const EXPECTED: &str =
    "source frames, as in [12, 40], a genga.Result, or a path or the bytes of a file of keys";

/// Reference keys as they are given.
pub enum ReferenceKeys {
    /// Source frames.
    Frames(Vec<Frame>),
    /// A file of keys, with its path if it has one.
    File(Vec<u8>, Option<PathBuf>),
}

impl ReferenceKeys {
    /// Takes frames, a result, a path or bytes.
    pub fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if given.is_instance_of::<Result>() {
            return Ok(Self::File(text_of(given)?, None));
        }
        match given.extract() {
            Ok(Given::Bytes(bytes)) => Ok(Self::File(bytes.as_bytes().to_vec(), None)),
            Ok(Given::Path(path)) => match fs::read(&path) {
                Ok(bytes) => Ok(Self::File(bytes, Some(path))),
                Err(source) => Err(raised(given.py(), Error::Io { path, source })),
            },
            Err(_) => {
                let items = given.try_iter().map_err(|_| wrongly(given))?;
                Ok(Self::Frames(items.map(|item| frame(&item?)).collect::<PyResult<_>>()?))
            }
        }
    }

    /// Returns the frames in the numbering of the sheet's motion.
    pub fn frames(self, py: Python<'_>, clip: &Clip) -> PyResult<Vec<Frame>> {
        match self {
            Self::Frames(frames) => Ok(frames),
            Self::File(bytes, path) => {
                reference_keys(&bytes, clip).map_err(|error| raised_of(py, error, path.as_deref()))
            }
        }
    }
}

/// Takes a whole number that is 0 or more, of any type.
fn frame(item: &Bound<'_, PyAny>) -> PyResult<Frame> {
    let is_frame = |place: &f64| (0.0..1e15).contains(place) && place.fract() == 0.0;
    let place = item.extract().ok().filter(is_frame);
    place.map(|place| Frame(place as usize)).ok_or_else(|| wrongly(item))
}

fn wrongly(given: &Bound<'_, PyAny>) -> PyErr {
    unexpected("reference", EXPECTED, given)
}
