//! Describes each setting as a panel needs it: accepted values, range, default, help in two languages.

use genga::recipe::{KNOBS, Kind, Knob, Recipe, Who};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::words::value;

/// Lists all settings as dicts, those for animators first.
///
/// `name`; `japanese`, its Japanese name; `help` and `japanese_help`, a sentence or two; `who` uses it (animator,
/// researcher); `default`; `unit`, empty if it has none; `takes`, a description of the accepted values.
///
/// `kind` is number, span (source frames, or seconds as "0.2s"), amount (a count, or a share as "4%"), on (koma per
/// drawing, 2 or "1-3"), or_auto (a number, or "auto"), band (a number, or a share as "5%"), seen_from (a side, or a
/// camera position), choice, flag or text. `choices` lists the words of a choice.
///
/// `least` and `most` are the limits of a number or span (floats, `inf` if unlimited), else None. `slider` is a useful
/// range for a number's slider, a pair, else None. A `whole` number has no fraction. An `optional` setting may be None.
#[pyfunction]
pub fn knobs(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let defaults = Recipe::default();
    KNOBS.iter().map(|knob| described(py, knob, &defaults)).collect()
}

fn described<'py>(py: Python<'py>, knob: &Knob, defaults: &Recipe) -> PyResult<Bound<'py, PyDict>> {
    let about = PyDict::new(py);
    about.set_item("name", knob.name)?;
    about.set_item("japanese", knob.japanese)?;
    about.set_item("help", knob.help)?;
    about.set_item("japanese_help", knob.japanese_help)?;
    about.set_item("who", if knob.who == Who::Animator { "animator" } else { "researcher" })?;
    about.set_item("default", value(py, &defaults.get(knob.name).unwrap_or_default())?)?;
    about.set_item("unit", knob.unit)?;
    about.set_item("takes", knob.takes())?;
    about.set_item("kind", word_of(knob.kind))?;
    let choices = if let Kind::Choice(words) = knob.kind { words } else { &[] };
    about.set_item("choices", choices)?;
    let is_measured = matches!(knob.kind, Kind::Number { .. } | Kind::Span);
    about.set_item("least", is_measured.then(|| knob.range.least()))?;
    about.set_item("most", is_measured.then(|| knob.range.most()))?;
    let slider =
        if let Kind::Number { min, max, .. } = knob.kind { Some((min, max)) } else { None };
    about.set_item("slider", slider)?;
    about.set_item("whole", matches!(knob.kind, Kind::Number { whole: true, .. }))?;
    about.set_item("optional", knob.is_optional())?;
    Ok(about)
}

fn word_of(kind: Kind) -> &'static str {
    match kind {
        Kind::Number { .. } => "number",
        Kind::Span => "span",
        Kind::Amount => "amount",
        Kind::On => "on",
        Kind::OrAuto => "or_auto",
        Kind::Band => "band",
        Kind::SeenFrom => "seen_from",
        Kind::Choice(_) => "choice",
        Kind::Flag => "flag",
        Kind::Text => "text",
    }
}
