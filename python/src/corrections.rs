//! A person's corrections: pins, forbidden frames, moves and holds.

use std::str::FromStr;

use genga::Error;
use genga::edits::{Edits, Forbidden, Hold, Move, Pin};
use pyo3::prelude::*;
use pyo3::types::{PyString, PyTuple};

use crate::error::raised;
use crate::words::{unexpected, word};

/// Each correction as Python writes it.
const PINS: &str =
    "a frame, as in 42, (42, \"contact\"), (42, \"contact\", 0.5) or \"42:contact@0.5\"";
const FORBID: &str = "a frame or a range without its end, as in 42, (120, 140) or \"120..140\"";
const MOVES: &str = "two frames, as in (41, 42) or \"41:42\"";
const HOLDS: &str = "a frame and a number of koma, as in (41, 6) or \"41:6\"";

/// Corrections given as arguments, besides those of the recipe. Each is a frame, a tuple, or text as in the program:
/// `42:contact@0.5`.
#[derive(Default)]
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
    pub fn add_to(&self, edits: &mut Edits) -> PyResult<()> {
        for pin in &self.pins {
            let made = pin_of(pin)?;
            edits.pins.push(made.map_err(|error| wrongly("pins", PINS, pin, error))?);
        }
        for frames in &self.forbid {
            let made = joined(frames, "..")?.parse();
            edits.forbidden.push(made.map_err(|error: <Forbidden as FromStr>::Err| {
                let error = Error::Edits { message: error.to_string() };
                wrongly("forbid", FORBID, frames, error)
            })?);
        }
        for moved in &self.moves {
            let made = Move::parse(&joined(moved, ":")?);
            edits.moves.push(made.map_err(|error| wrongly("moves", MOVES, moved, error))?);
        }
        for hold in &self.holds {
            let made = Hold::parse(&joined(hold, ":")?);
            edits.holds.push(made.map_err(|error| wrongly("holds", HOLDS, hold, error))?);
        }
        edits.only_pins |= self.only_pins;
        Ok(())
    }
}

/// Builds the exception of a correction: text has the program's notation, all else is told in Python's.
fn wrongly(name: &str, expected: &str, value: &Bound<'_, PyAny>, error: Error) -> PyErr {
    let py = value.py();
    let message = match (error, value.repr()) {
        (Error::Edits { message }, _) if value.is_instance_of::<PyString>() => message,
        (Error::Edits { .. }, Ok(found)) => format!("expected {expected}, found {found}"),
        (other, _) => return raised(py, other),
    };
    raised(py, Error::setting(name, message))
}

/// Takes a list of corrections, which are looked at later; `name` is that of the argument.
fn listed<'py>(
    name: &str,
    one: &str,
    given: &Bound<'py, PyAny>,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let wrongly = || unexpected(name, &format!("a list, each of {one}"), given);
    if given.is_instance_of::<PyString>() {
        return Err(wrongly());
    }
    given.try_iter().map_err(|_| wrongly())?.collect()
}

/// Takes the argument `pins`.
pub fn pins<'py>(given: &Bound<'py, PyAny>) -> PyResult<Vec<Bound<'py, PyAny>>> {
    listed("pins", PINS, given)
}

/// Takes the argument `forbid`.
pub fn forbid<'py>(given: &Bound<'py, PyAny>) -> PyResult<Vec<Bound<'py, PyAny>>> {
    listed("forbid", FORBID, given)
}

/// Takes the argument `moves`.
pub fn moves<'py>(given: &Bound<'py, PyAny>) -> PyResult<Vec<Bound<'py, PyAny>>> {
    listed("moves", MOVES, given)
}

/// Takes the argument `holds`.
pub fn holds<'py>(given: &Bound<'py, PyAny>) -> PyResult<Vec<Bound<'py, PyAny>>> {
    listed("holds", HOLDS, given)
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

/// Takes a pin: a tuple is a frame and a name, and may end with a weight.
fn pin_of(pin: &Bound<'_, PyAny>) -> PyResult<Result<Pin, Error>> {
    let Ok(parts) = pin.cast::<PyTuple>() else { return Ok(Pin::parse(&word(pin)?)) };
    let (frame, name, weight) = match parts.extract::<(Bound<'_, PyAny>, String)>() {
        Ok((frame, name)) => (frame, name, None),
        Err(_) => match parts.extract::<(Bound<'_, PyAny>, String, f64)>() {
            Ok((frame, name, weight)) => (frame, name, Some(weight)),
            Err(_) => return Ok(Err(Error::Edits { message: String::new() })),
        },
    };
    let name = Some(name.trim().to_owned()).filter(|name| !name.is_empty());
    Ok(Pin::parse(&word(&frame)?).map(|pin| Pin { name, weight, ..pin }))
}
