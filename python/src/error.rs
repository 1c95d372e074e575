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

/// Most characters of a text that an error repeats.
const MOST_OF_TEXT: usize = 80;

/// Length of a name, in bytes, from which on no system has a file of that name.
const NO_NAME: usize = 256;

/// Whether what was given as a path is more likely the text of a file.
fn is_text(path: &str) -> bool {
    let is_long = |name: &str| name.len() >= NO_NAME;
    path.chars().count() > MOST_OF_TEXT
        && (path.contains(['\n', '\r']) || path.split(['/', '\\']).any(is_long))
}

/// Builds the exception of an error that no file caused.
pub fn raised(py: Python<'_>, error: genga::Error) -> PyErr {
    raised_of(py, error, None)
}

/// Builds the exception of an error; `file` is the one that was read.
pub fn raised_of(py: Python<'_>, error: genga::Error, file: Option<&Path>) -> PyErr {
    if let genga::Error::Io { path, source } = &error {
        let path = path.display().to_string();
        return match source.raw_os_error() {
            Some(number) if is_text(&path) => {
                let begin: String = path.chars().take(MOST_OF_TEXT - 1).collect();
                let told = format!("{source}; the text of a file is given as bytes, text.encode()");
                PyOSError::new_err((number, told, begin + "…"))
            }
            // Python picks the subclass, such as FileNotFoundError, by the number.
            Some(number) => PyOSError::new_err((number, source.to_string(), path)),
            None => PyOSError::new_err(in_python(&error.to_string())),
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

/// What messages say of the program's commands and options, and what Python has in their place: nothing if it has none.
const IN_PYTHON: [(&str, &str); 28] = [
    (
        "`genga recipe` lists them, `genga run --help` the options",
        "genga.knobs() lists them, and help() of the function its arguments",
    ),
    (
        "genga split --cycles lists the best rounds of a take, and --trim A..B takes one",
        "Clip.cycles() lists the best rounds of a take, and Clip.cleaned(trim=(A, B)) takes one",
    ),
    ("; genga inspect tells more", ""),
    ("--loop makes one, in a recipe loop = true", "loop=True makes one"),
    ("without --loop", "without loop"),
    ("(see --layers)", "(see the setting layers)"),
    (
        "name one with --within",
        "name one, as in passages=[{\"frames\": [120, 240], \"spacing\": {\"on\": 1}}]",
    ),
    (
        "this genga was built without it, that is, without the feature `pictures`",
        "only the program writes it",
    ),
    ("measure: expected", "measures: expected"),
    ("max-error: ", "max_error: "),
    ("drawings-per-second: ", "drawings_per_second: "),
    (
        "; a file of bones says which (--bones)",
        "; genga.Clip takes other names of the joints, by which they are known",
    ),
    (" ([extra] in a file of bones takes it up: --bones)", ""),
    (" (--bones names joints)", " (genga.Clip takes other names of the joints)"),
    (", which were taken (--bones)", ", which were taken"),
    ("(--up y, --up z)", "(up=\"y\", up=\"z\")"),
    (", and this with --camera-work", ""),
    ("and this with --skeleton", "and this as skeleton"),
    ("--skeleton ", "skeleton="),
    ("; --memory GIB allows more", ""),
    ("--keep-lead-in", "keep_lead_in=True"),
    ("--keep-glitches", "keep_glitches=True"),
    ("--repair", "repair=True"),
    ("--fps ", "fps "),
    ("--root ", "root "),
    ("--take ", "take "),
    ("--trim ", "trim "),
    (", or allow more with --memory GIB", ""),
];

/// Replaces commands and options of the program by what Python has.
pub fn in_python(message: &str) -> String {
    let message = IN_PYTHON
        .iter()
        .fold(message.to_owned(), |message, (option, own)| message.replace(option, own));
    // The last way out, which Python has not: so many GiB.
    match message.split_once(", --memory ") {
        Some((before, _)) => before.into(),
        None => message,
    }
}

/// Issues a Python warning at the caller's line.
pub fn warned(py: Python<'_>, message: impl ToString) -> PyResult<()> {
    let message = CString::new(in_python(&message.to_string()).replace('\0', " "))?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &message, 1)
}

/// Builds the exception of a wrong argument.
pub fn asked_wrongly(py: Python<'_>, message: impl Into<String>) -> PyErr {
    raised(py, genga::Error::clip(message))
}
