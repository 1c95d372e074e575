//! Tables as dicts of NumPy columns, as pandas and polars take them.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A column: a value a row.
pub enum Column {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers; NaN where there is none.
    Number(Vec<f64>),
    /// Words; empty where there is none.
    Words(Vec<String>),
}

impl Column {
    /// Whole numbers of what counts from 0.
    pub fn counts(values: impl IntoIterator<Item = usize>) -> Self {
        Self::Whole(values.into_iter().map(|value| value as i64).collect())
    }

    /// Numbers.
    pub fn numbers(values: impl IntoIterator<Item = f64>) -> Self {
        Self::Number(values.into_iter().collect())
    }

    /// Words.
    pub fn words<T: Into<String>>(values: impl IntoIterator<Item = T>) -> Self {
        Self::Words(values.into_iter().map(Into::into).collect())
    }

    fn array<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match self {
            Self::Whole(values) => Ok(PyArray1::from_vec(py, values).into_any()),
            Self::Number(values) => Ok(PyArray1::from_vec(py, values).into_any()),
            // NumPy's words are as wide as the longest: it copies them.
            Self::Words(values) => {
                let words = values.into_iter().collect::<Vec<_>>();
                py.import("numpy")?.call_method1("array", (words, "U"))
            }
        }
    }
}

/// A dict of columns, in their order.
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

/// What can be written as JSON, as dicts and lists.
pub fn plain<'py>(py: Python<'py>, value: &impl serde::Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(value)
        .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))?;
    py.import("json")?.call_method1("loads", (text,))
}
