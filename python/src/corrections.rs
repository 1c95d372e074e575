//! A person's corrections: pins, forbidden frames, moves and holds.

use genga::Error;
use genga::edits::{Edits, Forbidden, Hold, Move, Pin};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::error::raised;
use crate::words::word;

/// Corrections given as arguments, besides those of the recipe. Each is a frame, a tuple, or text as in the program:
/// `42:contact@0.5`.
#[derive(FromPyObject, Default)]
pub struct Corrections<'py> {
    /// Frames that are keys whatever is found.
    pub pins: Vec<Bound<'py, PyAny>>,
    /// Frames near which no key is found.
    pub forbid: Vec<Bound<'py, PyAny>>,
    /// Keys drawn at another frame.
    pub moves: Vec<Bound<'py, PyAny>>,
    /// Numbers of koma for which drawings stay.
    pub holds: Vec<Bound<'py, PyAny>>,
    /// Whether pins and moves are the only keys.
    pub only_pins: bool,
}

impl Corrections<'_> {
    /// Adds them to the existing corrections.
    pub fn add_to(&self, py: Python<'_>, edits: &mut Edits) -> PyResult<()> {
        let parsed = |error: Error| raised(py, error);
        for pin in &self.pins {
            edits.pins.push(Pin::parse(&joined(pin, ":")?).map_err(parsed)?);
        }
        for frames in &self.forbid {
            edits.forbidden.push(joined(frames, "..")?.parse().map_err(
                |error: <Forbidden as std::str::FromStr>::Err| {
                    raised(py, Error::Edits { message: error.to_string() })
                },
            )?);
        }
        for moved in &self.moves {
            edits.moves.push(Move::parse(&joined(moved, ":")?).map_err(parsed)?);
        }
        for hold in &self.holds {
            edits.holds.push(Hold::parse(&joined(hold, ":")?).map_err(parsed)?);
        }
        edits.only_pins |= self.only_pins;
        Ok(())
    }
}

/// Joins a tuple into the program's notation.
fn joined(value: &Bound<'_, PyAny>, between: &str) -> PyResult<String> {
    match value.cast::<PyTuple>() {
        Ok(parts) => {
            let parts: Vec<_> = parts.iter().map(|part| word(&part)).collect::<PyResult<_>>()?;
            Ok(parts.join(between))
        }
        Err(_) => word(value),
    }
}
