//! Tables as dicts of NumPy columns, as pandas and polars take them.

use std::str::FromStr;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A column with one value per row.
pub enum Column {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers; NaN if missing.
    Number(Vec<f64>),
    /// Words; empty if missing.
    Words(Vec<String>),
}

impl Column {
    /// Builds a column of whole numbers from counts.
    pub fn counts(values: impl IntoIterator<Item = usize>) -> Self {
        Self::Whole(values.into_iter().map(|value| value as i64).collect())
    }

    /// Builds a column of numbers.
    pub fn numbers(values: impl IntoIterator<Item = f64>) -> Self {
        Self::Number(values.into_iter().collect())
    }

    /// Builds a column of words.
    pub fn words<T: Into<String>>(values: impl IntoIterator<Item = T>) -> Self {
        Self::Words(values.into_iter().map(Into::into).collect())
    }

    /// Builds a column of numbers if all words are plain numbers, whole ones if all are whole; else of words.
    pub fn read(words: &[&str]) -> Self {
        if let Some(whole) = parsed(words) {
            return Self::Whole(whole);
        }
        parsed(words).map_or_else(|| Self::words(words.iter().copied()), Self::Number)
    }

    fn array<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match self {
            Self::Whole(values) => Ok(PyArray1::from_vec(py, values).into_any()),
            Self::Number(values) => Ok(PyArray1::from_vec(py, values).into_any()),
            // NumPy strings have a fixed width, so they are copied.
            Self::Words(values) => {
                let words = values.into_iter().collect::<Vec<_>>();
                py.import("numpy")?.call_method1("array", (words, "U"))
            }
        }
    }
}

/// Parses all words; `None` if one cannot be parsed.
fn parsed<T: FromStr>(words: &[&str]) -> Option<Vec<T>> {
    words.iter().map(|word| word.parse().ok()).collect()
}

/// Builds a dict of columns, in their order.
pub fn table<'py, const N: usize>(
    py: Python<'py>,
    columns: [(&str, Column); N],
) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    for (name, column) in columns {
        table.set_item(name, column.array(py)?)?;
    }
    Ok(table)
}

/// Converts serializable data to Python dicts and lists.
pub fn plain<'py>(py: Python<'py>, value: &impl serde::Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(value)
        .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))?;
    py.import("json")?.call_method1("loads", (text,))
}
