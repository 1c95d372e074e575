//! Converts Python values to the words that settings take, and back.

use genga::Error;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString, PyTuple};

use crate::error::raised;

/// Converts a value to a recipe's word: `0.2s`, `true`, `none`, `[{ name = "A", joints = ["Hips"] }]`.
pub fn word(value: &Bound<'_, PyAny>) -> PyResult<String> {
    match value.cast::<PyString>() {
        Ok(text) => Ok(text.to_cow()?.into_owned()),
        Err(_) => written(value),
    }
}

/// Converts a value to TOML, with quotes around text.
fn written(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if value.is_none() {
        return Ok("none".into());
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(flag.is_true().to_string());
    }
    if let Ok(text) = value.cast::<PyString>() {
        let quoted = serde_json::to_string(&text.to_cow()?);
        return quoted.map_err(|error| PyTypeError::new_err(error.to_string()));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items: Vec<_> =
            value.try_iter()?.map(|item| written(&item?)).collect::<PyResult<_>>()?;
        return Ok(format!("[{}]", items.join(", ")));
    }
    if let Ok(table) = value.cast::<PyDict>() {
        let pair = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            PyResult::Ok(format!("{} = {}", written(&name)?, written(&value)?))
        };
        let pairs: Vec<_> = table.iter().map(pair).collect::<PyResult<_>>()?;
        return Ok(format!("{{ {} }}", pairs.join(", ")));
    }
    // Numbers of Python and of NumPy alike.
    Ok(value.str()?.to_cow()?.into_owned())
}

/// Takes a whole number that is 0 or more; `name` is that of the argument.
pub fn whole(name: &str, given: &Bound<'_, PyAny>) -> PyResult<usize> {
    given.extract().map_err(|_| unexpected(name, "a whole number, 0 or more", given))
}

/// Builds the exception of an argument that is not as expected.
pub fn unexpected(name: &str, expected: &str, given: &Bound<'_, PyAny>) -> PyErr {
    match given.repr() {
        Ok(found) => {
            let message = format!("expected {expected}, found {found}");
            raised(given.py(), Error::setting(name, message))
        }
        Err(error) => error,
    }
}

/// Converts a word to a Python value: a number, True, None, or the text itself.
pub fn value(py: Python<'_>, word: &str) -> PyResult<Py<PyAny>> {
    Ok(match word {
        "none" => py.None(),
        "true" | "false" => PyBool::new(py, word == "true").to_owned().into_any().unbind(),
        _ => match (word.parse::<i64>(), word.parse::<f64>()) {
            (Ok(whole), _) => whole.into_pyobject(py)?.into_any().unbind(),
            (_, Ok(number)) => number.into_pyobject(py)?.into_any().unbind(),
            _ => PyString::new(py, word).into_any().unbind(),
        },
    })
}

/// Collects settings by name: `filter={"width": "0.2s"}`, `filter__width="0.2s"` and `**{"filter.width": "0.2s"}` are
/// equivalent.
pub fn settings(asked: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, String)>> {
    let mut found = Vec::new();
    if let Some(asked) = asked {
        collect("", asked, &mut found)?;
    }
    Ok(found)
}

fn collect(
    section: &str,
    asked: &Bound<'_, PyDict>,
    found: &mut Vec<(String, String)>,
) -> PyResult<()> {
    for (name, value) in asked {
        let own = name.extract::<String>()?;
        // A joint's name may contain `__`.
        let own = if section.starts_with("keys.weights") { own } else { own.replace("__", ".") };
        let name = if section.is_empty() { own } else { format!("{section}.{own}") };
        match value.cast::<PyDict>() {
            Ok(table) => collect(&name, table, found)?,
            Err(_) => found.push((name, word(&value)?)),
        }
    }
    Ok(())
}
