//! A recipe as a mapping with the names of its TOML.

use genga::edits::Edits;
use genga::error::{Error, did_you_mean};
use genga::recipe::{KNOBS, Knob, Recipe as Settings, unknown_beside};
use genga_lab::study::{Noise, table_1_recipe};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::corrections::{self, Corrections};
use crate::error::raised;
use crate::pickle::Reduced;
use crate::targets::TARGETS;
use crate::words::{settings, value, word};

/// All settings of the chain, and a person's corrections. A mapping whose keys are the names in the recipe file
/// (`"filter.width"`). Settings that are not given have their defaults. A value outside its range raises `genga.Error`.
#[pyclass(module = "genga", from_py_object)]
#[derive(Clone, Default)]
pub struct Recipe {
    pub recipe: Settings,
    pub edits: Edits,
}

impl Recipe {
    /// Applies settings by name.
    pub fn with(self, py: Python<'_>, asked: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        self.with_of(py, asked, "Recipe")
    }

    /// Applies settings that are arguments of a function of the package. An unknown name may be meant for another one.
    pub fn with_of(
        mut self,
        py: Python<'_>,
        asked: Option<&Bound<'_, PyDict>>,
        function: &str,
    ) -> PyResult<Self> {
        for (name, word) in settings(asked)? {
            self.recipe.set(&name, &word).map_err(|error| match is_unknown(&name) {
                true => unknown(py, &name, function),
                false => raised(py, error),
            })?;
        }
        Ok(self)
    }

    fn names(&self) -> Vec<String> {
        self.recipe.settings().into_iter().map(|(name, _)| name).collect()
    }

    fn get_word(&self, name: &str) -> PyResult<String> {
        let found = self.recipe.settings().into_iter().find(|(own, _)| own == name);
        found.map(|(_, word)| word).ok_or_else(|| PyKeyError::new_err(name.to_owned()))
    }
}

/// Words for a number of keys, in `keys={"count": 9}`; `keys=9` has none.
const NUMBERS: [&str; 5] = ["", "keys", "count", "number", "n"];

/// Whether there is no such setting. A joint's weight, passages and a setting of a layer have no knob of their own.
fn is_unknown(name: &str) -> bool {
    !name.contains('/')
        && name != "passages"
        && !name.starts_with("keys.weights.")
        && Knob::find(name).is_err()
}

/// Builds the exception of an unknown argument of a function of the package.
fn unknown(py: Python<'_>, name: &str, function: &str) -> PyErr {
    let own = arguments(py, function).unwrap_or_default();
    let axes = if function == "study" { &Noise::AXES[..] } else { &[] };
    let own: Vec<&str> = own.iter().map(String::as_str).chain(axes.iter().copied()).collect();
    if own.contains(&"targets")
        && let Some(error) = meant_target(name, &own)
    {
        return raised(py, error);
    }
    raised(py, unknown_beside(name, &own))
}

/// Returns the error of a name that means a target, if it does: `keys=9`, `keys={"count": 9}`, `max_error=8`,
/// `target={"keys": 9}`.
fn meant_target(name: &str, own: &[&str]) -> Option<Error> {
    let (head, part) = name.split_once('.').unwrap_or((name, ""));
    let targets = "targets={\"keys\": 9}";
    let message = match head {
        "keys" => format!("there is no such setting; a number of keys is asked for by {targets}"),
        _ if TARGETS.contains(&head) => {
            format!("it is no setting but a target, as in targets={{\"{head}\": 8}}")
        }
        // Of a dict, each entry comes as a setting.
        _ if TARGETS.contains(&part) => match did_you_mean(head, own.iter().copied()) {
            hint if hint.is_empty() => return None,
            hint => format!("there is no such setting{hint} as in {targets}"),
        },
        _ => return None,
    };
    let is_near =
        head == "keys" && !did_you_mean(name, KNOBS.iter().map(|knob| knob.name)).is_empty();
    let is_number = NUMBERS.contains(&part);
    (!is_near || is_number).then(|| Error::setting(name, message))
}

/// Returns the names of the arguments of a function of the package.
fn arguments(py: Python<'_>, function: &str) -> PyResult<Vec<String>> {
    let get = py.import("operator")?.call_method1("attrgetter", (function,))?;
    let function = get.call1((py.import("genga")?,))?;
    let signature = py.import("inspect")?.call_method1("signature", (function,))?;
    let mut names = Vec::new();
    for argument in signature.getattr("parameters")?.call_method0("values")?.try_iter()? {
        let argument = argument?;
        if argument.getattr("kind")?.getattr("name")?.extract::<String>()? != "VAR_KEYWORD" {
            names.push(argument.getattr("name")?.extract()?);
        }
    }
    Ok(names)
}

#[pymethods]
impl Recipe {
    #[new]
    #[pyo3(signature = (**settings))]
    fn new(py: Python<'_>, settings: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::default().with(py, settings)
    }

    /// Parses the text of a recipe file (TOML). Errors have line and column.
    #[classmethod]
    fn parse(_class: &Bound<'_, PyType>, py: Python<'_>, text: &str) -> PyResult<Self> {
        let (recipe, edits) = Settings::parse(text).map_err(|error| raised(py, error))?;
        Ok(Self { recipe, edits })
    }

    /// Returns the settings of Table 1 of the first paper: those of `genga.study` by itself.
    #[classmethod]
    fn table_1(_class: &Bound<'_, PyType>) -> Self {
        Self { recipe: table_1_recipe(), edits: Edits::default() }
    }

    /// Adds corrections, in the notation of `genga.run`.
    #[pyo3(signature = (*, pins=vec![], forbid=vec![], moves=vec![], holds=vec![], only_pins=false))]
    fn correct<'py>(
        &mut self,
        #[pyo3(from_py_with = corrections::pins)] pins: Vec<Bound<'py, PyAny>>,
        #[pyo3(from_py_with = corrections::forbid)] forbid: Vec<Bound<'py, PyAny>>,
        #[pyo3(from_py_with = corrections::moves)] moves: Vec<Bound<'py, PyAny>>,
        #[pyo3(from_py_with = corrections::holds)] holds: Vec<Bound<'py, PyAny>>,
        only_pins: bool,
    ) -> PyResult<()> {
        Corrections { pins, forbid, moves, holds, only_pins }.add_to(&mut self.edits)
    }

    /// Returns the recipe file as the program writes it.
    fn to_toml(&self) -> String {
        self.recipe.write(&self.edits)
    }

    /// For pickle: the recipe file.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let parse = py.get_type::<Self>().getattr("parse")?;
        Ok((parse, (self.to_toml(),).into_pyobject(py)?.into_any()))
    }

    /// Returns an independent copy.
    fn copy(&self) -> Self {
        self.clone()
    }

    fn __len__(&self) -> usize {
        self.names().len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.names().into_pyobject(py)?.call_method0("__iter__")
    }

    fn __contains__(&self, name: &str) -> bool {
        self.get_word(name).is_ok()
    }

    fn __getitem__(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
        value(py, &self.get_word(name)?)
    }

    fn __setitem__(
        &mut self,
        py: Python<'_>,
        name: &str,
        value: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        self.recipe.set(name, &word(value)?).map_err(|error| raised(py, error))
    }

    /// Resets a setting to its default.
    fn __delitem__(&mut self, py: Python<'_>, name: &str) -> PyResult<()> {
        self.get_word(name)?;
        let default = Settings::default().get(name).unwrap_or("none".into());
        self.recipe.set(name, &default).map_err(|error| raised(py, error))
    }

    /// Returns the value of a setting, or `default` if there is no such setting.
    #[pyo3(signature = (name, default=None))]
    fn get(&self, py: Python<'_>, name: &str, default: Option<Py<PyAny>>) -> PyResult<Py<PyAny>> {
        match self.get_word(name) {
            Ok(word) => value(py, &word),
            Err(_) => Ok(default.unwrap_or_else(|| py.None())),
        }
    }

    fn keys(&self) -> Vec<String> {
        self.names()
    }

    fn values(&self, py: Python<'_>) -> PyResult<Vec<Py<PyAny>>> {
        self.recipe.settings().iter().map(|(_, word)| value(py, word)).collect()
    }

    fn items(&self, py: Python<'_>) -> PyResult<Vec<(String, Py<PyAny>)>> {
        let pair = |(name, word): (String, String)| Ok((name, value(py, &word)?));
        self.recipe.settings().into_iter().map(pair).collect()
    }

    /// Sets several settings: `update(filter={"width": 20})`, `update({"filter.width": 20})`.
    #[pyo3(signature = (other=None, **settings))]
    fn update(
        &mut self,
        py: Python<'_>,
        other: Option<&Bound<'_, PyDict>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        *self = self.clone().with(py, other)?.with(py, settings)?;
        Ok(())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.recipe == other.recipe && self.edits == other.edits
    }

    fn __repr__(&self) -> String {
        let own = Settings::default().settings();
        let changed = self.recipe.settings().into_iter().filter(|pair| !own.contains(pair));
        let changed: Vec<_> = changed.map(|(name, word)| format!("'{name}': '{word}'")).collect();
        format!("Recipe(**{{{}}})", changed.join(", "))
    }
}
