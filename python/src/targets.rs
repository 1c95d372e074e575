//! Targets: wanted properties of a sheet, in place of the settings that produce them.

use genga::Error;
use genga::target::{Outcome, Target};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::raised;

/// Parses targets by name: `{"keys": 9, "drawings_per_second": 6}`. A target of None is ignored.
pub fn targets(py: Python<'_>, asked: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<Target>> {
    let mut found = Vec::new();
    for (name, value) in asked.into_iter().flatten() {
        if value.is_none() {
            continue;
        }
        found.push(match name.extract::<String>()?.as_str() {
            "keys" => Target::Keys(value.extract()?),
            "drawings_per_second" => Target::DrawingsPerSecond(value.extract()?),
            "max_error" => Target::MaxError(value.extract()?),
            other => {
                let message = "there is no such target: use keys, drawings_per_second or max_error";
                return Err(raised(py, Error::setting(other, message)));
            }
        });
    }
    Ok(found)
}

/// Describes the outcome of a target: `target`, `asked`, `reached`, `why` (None if it was met), and `words` for a
/// person.
pub fn told<'py>(py: Python<'py>, outcome: &Outcome) -> PyResult<Bound<'py, PyDict>> {
    let (name, asked) = match outcome.target {
        Target::Keys(count) => ("keys", count as f64),
        Target::DrawingsPerSecond(rate) => ("drawings_per_second", rate),
        Target::MaxError(most) => ("max_error", most),
    };
    let told = PyDict::new(py);
    told.set_item("target", name)?;
    told.set_item("asked", asked)?;
    told.set_item("reached", outcome.reached)?;
    told.set_item("why", outcome.shortfall.as_ref())?;
    told.set_item("words", outcome.to_string())?;
    Ok(told)
}
