//! Converts errors of the library to exceptions.

use std::ffi::CString;
use std::path::Path;

use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyUserWarning, PyValueError};
use pyo3::prelude::*;

create_exception!(
    genga,
    Error,
    PyValueError,
    "An error, with the way to fix it. `file`, `line` and `column` (from 1) say where; each may be None."
);

/// Builds the exception of an error that no file caused.
pub fn raised(py: Python<'_>, error: genga::Error) -> PyErr {
    raised_of(py, error, None)
}

/// Builds the exception of an error; `file` is the one that was read.
pub fn raised_of(py: Python<'_>, error: genga::Error, file: Option<&Path>) -> PyErr {
    if let genga::Error::Io { path, source } = &error {
        let path = path.display().to_string();
        return match source.raw_os_error() {
            // Python picks the subclass, such as FileNotFoundError, by the number.
            Some(number) => PyOSError::new_err((number, source.to_string(), path)),
            None => PyOSError::new_err(error.to_string()),
        };
    }
    let place = error.position();
    let file = file.filter(|_| {
        matches!(
            error,
            genga::Error::Motion { .. }
                | genga::Error::Clip { .. }
                | genga::Error::Recipe { .. }
                | genga::Error::Sheet { .. }
        )
    });
    let file = file.map(|file| file.display().to_string());
    let between = if place.is_some() { ":" } else { ": " };
    let told = in_python(&error.to_string());
    let message = file.as_ref().map_or(told.clone(), |file| format!("{file}{between}{told}"));
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

/// Replaces options of the program that are arguments of `read`, and its help.
pub fn in_python(message: &str) -> String {
    let message = message.replace(
        "`genga run --help` lists them and the options",
        "genga.knobs() lists them, and help() of the function its arguments",
    );
    let argument = |name: &str| name.replace('-', "_");
    let message =
        ["repair", "keep-lead-in", "keep-glitches"].iter().fold(message, |message, name| {
            message.replace(&format!("--{name}"), &format!("{}=True", argument(name)))
        });
    ["fps", "root", "take", "trim"]
        .iter()
        .fold(message, |message, name| message.replace(&format!("--{name} "), &format!("{name} ")))
}

/// Issues a Python warning at the caller's line.
pub fn warned(py: Python<'_>, message: impl ToString) -> PyResult<()> {
    let message = CString::new(message.to_string().replace('\0', " "))?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &message, 1)
}

/// Builds the exception of a wrong argument.
pub fn asked_wrongly(py: Python<'_>, message: impl Into<String>) -> PyErr {
    raised(py, genga::Error::clip(message))
}
