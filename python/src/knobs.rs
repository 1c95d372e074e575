//! What is said of each setting, as a panel needs it: what it takes, its ranges, its default, help in two languages.

use genga::recipe::{KNOBS, Kind, Knob, Recipe, Who};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::words::value;

/// The settings there are, those of an animator first: a dict each.
///
/// `name`; `japanese`, its name in Japanese; `help` and `japanese_help`, a sentence or two; `who` turns it (animator,
/// researcher); `default`; `unit` (empty where it counts in nothing); `takes`, what it takes in words.
///
/// `kind` is number, span (source frames, or seconds as "0.2s"), amount (a count, or a share as "4%"), on (koma a
/// drawing, 2 or "1-3"), band (a number, or a share as "5%"), seen_from (a side, or a camera's place), choice, flag or
/// text. `choices` are the words of a choice.
///
/// `least` and `most` are the ends of what it may be (floats, `inf` where there is no end; None where it is no number
/// and no span). `slider` is the part of it that makes sense on a slider, a pair, for a number. `whole` numbers have no
/// fraction; what is `optional` may be None.
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
