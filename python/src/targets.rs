//! Targets: what a sheet is to be, in place of the settings that make it so.

use genga::Error;
use genga::target::{Outcome, Target};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::raised;

/// Targets by their names: `{"keys": 9, "drawings_per_second": 6}`; one that is None is not asked for.
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
                let message =
                    "there is no such target; there are keys, drawings_per_second and max_error";
                return Err(raised(py, Error::setting(other, message)));
            }
        });
    }
    Ok(found)
}

/// What became of a target: `target`, `asked`, `reached`, `why` (None where it was met), and `words` for a person.
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
