//! Errors of the library as exceptions.

use std::ffi::CString;
use std::path::Path;

use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyUserWarning, PyValueError};
use pyo3::prelude::*;

create_exception!(
    genga,
    Error,
    PyValueError,
    "What is wrong, where, and the way out. `file`, `line` and `column` (from 1) are None where there is no such place."
);

/// The exception of an error that no file is at fault of.
pub fn raised(py: Python<'_>, error: genga::Error) -> PyErr {
    raised_of(py, error, None)
}

/// The exception of an error; `file` is the one that was read.
pub fn raised_of(py: Python<'_>, error: genga::Error, file: Option<&Path>) -> PyErr {
    if let genga::Error::Io { path, source } = &error {
        let path = path.display().to_string();
        return match source.raw_os_error() {
            // Python makes FileNotFoundError and its like of the number.
            Some(number) => PyOSError::new_err((number, source.to_string(), path)),
            None => PyOSError::new_err(error.to_string()),
        };
    }
    let place = error.position();
    let file = file.filter(|_| {
        matches!(
            error,
            genga::Error::Bvh { .. }
                | genga::Error::Motion { .. }
                | genga::Error::Clip { .. }
                | genga::Error::Recipe { .. }
        )
    });
    let file = file.map(|file| file.display().to_string());
    let between = if place.is_some() { ":" } else { ": " };
    let message = file.as_ref().map_or(error.to_string(), |file| format!("{file}{between}{error}"));
    let exception = Error::new_err(message);
    let value = exception.value(py);
    let set = value
        .setattr("file", file)
        .and_then(|()| value.setattr("line", place.map(|(line, _)| line)))
        .and_then(|()| value.setattr("column", place.map(|(_, column)| column)));
    match set {
        Ok(()) => exception,
        Err(other) => other,
    }
}

/// Tells a person of something as Python warns, under the caller's line.
pub fn warned(py: Python<'_>, message: impl ToString) -> PyResult<()> {
    let message = CString::new(message.to_string().replace('\0', " "))?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &message, 1)
}

/// An error of what was asked for, in the words of Python.
pub fn asked_wrongly(py: Python<'_>, message: impl Into<String>) -> PyErr {
    raised(py, genga::Error::clip(message))
}
