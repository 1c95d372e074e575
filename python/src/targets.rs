//! Targets: wanted properties of a sheet, in place of the settings that produce them.

use genga::Error;
use genga::target::{Outcome, Shortfall, Target};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::raised;

/// The names of all targets.
pub const TARGETS: [&str; 3] = ["keys", "drawings_per_second", "max_error"];

/// Parses targets by name: `{"keys": 9, "drawings_per_second": 6}`. A target of None is ignored.
pub fn targets(py: Python<'_>, asked: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Target>> {
    let Some(asked) = asked else {
        return Ok(Vec::new());
    };
    let wrongly = |name: &str, expected, found: &Bound<'_, PyAny>| match found.repr() {
        Ok(found) => {
            raised(py, Error::setting(name, format!("expected {expected}, found {found}")))
        }
        Err(error) => error,
    };
    let expected = "a dict of targets, as in {\"keys\": 9}";
    let asked = asked.cast::<PyDict>().map_err(|_| wrongly("targets", expected, asked))?;
    let mut found = Vec::new();
    for (name, value) in asked {
        if value.is_none() {
            continue;
        }
        let name: String = name.extract().map_err(|_| wrongly("targets", expected, asked))?;
        let number = value.extract().map_err(|_| wrongly(&name, "a number", &value))?;
        found.push(target(py, &name, number)?);
    }
    Ok(found)
}

/// An outcome as pickle takes it: `target`, `asked`, `reached`, and why in English and Japanese.
pub type Plain = (String, f64, f64, Option<(String, String)>);

/// Takes an outcome apart.
pub fn plain_of(outcome: &Outcome) -> Plain {
    let (name, asked) = named(outcome.target);
    let why = outcome.shortfall.as_ref();
    let why = why.map(|why| (why.to_string(), why.japanese().into()));
    (name.into(), asked, outcome.reached, why)
}

/// Puts an outcome together.
pub fn outcome_of(py: Python<'_>, (name, asked, reached, why): Plain) -> PyResult<Outcome> {
    let shortfall = why.map(|(english, japanese)| Shortfall::new(english, japanese));
    Ok(Outcome { target: target(py, &name, asked)?, reached, shortfall })
}

fn target(py: Python<'_>, name: &str, asked: f64) -> PyResult<Target> {
    Ok(match name {
        "keys" if asked >= 0.0 && asked.fract() == 0.0 => Target::Keys(asked as usize),
        "keys" => {
            return Err(raised(py, Error::setting(name, "expected a whole number, 0 or more")));
        }
        "drawings_per_second" => Target::DrawingsPerSecond(asked),
        "max_error" => Target::MaxError(asked),
        other => {
            let message = "there is no such target: use keys, drawings_per_second or max_error";
            return Err(raised(py, Error::setting(other, message)));
        }
    })
}

fn named(target: Target) -> (&'static str, f64) {
    match target {
        Target::Keys(count) => ("keys", count as f64),
        Target::DrawingsPerSecond(rate) => ("drawings_per_second", rate),
        Target::MaxError(most) => ("max_error", most),
    }
}

/// Describes the outcome of a target: `target`, `asked`, `reached`, `why` (None if it was met), and `words` for a
/// person.
pub fn told<'py>(py: Python<'py>, outcome: &Outcome) -> PyResult<Bound<'py, PyDict>> {
    let (name, asked) = named(outcome.target);
    let told = PyDict::new(py);
    told.set_item("target", name)?;
    for (what, value) in [("asked", asked), ("reached", outcome.reached)] {
        match outcome.target {
            Target::Keys(_) => told.set_item(what, value as usize)?,
            _ => told.set_item(what, value)?,
        }
    }
    told.set_item("why", outcome.shortfall.as_ref().map(ToString::to_string))?;
    told.set_item("words", outcome.to_string())?;
    Ok(told)
}
