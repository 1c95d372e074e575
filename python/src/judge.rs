//! Studies of settings, judgements of sheets, comparisons of methods.

use std::sync::atomic::Ordering;

use genga::pipeline::Budget;
use genga::time::Frame;
use genga_files::sheet_json;
use genga_lab::quality::{Compare, Evaluation, Row};
use genga_lab::study::{Axis, Grid, Measure, Noise, Study, table_1_recipe};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::clip::Clip;
use crate::error::{asked_wrongly, raised, warned};
use crate::recipe::Recipe;
use crate::table::{Column, plain, table};
use crate::words::word;
use crate::work;

/// Varies one or two settings and measures the result for each combination. `x` and `y` are a name with its values:
/// `("filter.width", "10..60:5")` or `("filter.width", [10, 20, 30])`. Without both, computes Table 1 of the first
/// paper, with the paper's settings. Returns a dict of columns with one row per combination: both settings (text), then
/// one column for each of `measures` (`genga study --help` lists them).
#[pyfunction]
#[pyo3(signature = (clip, recipe=None, *, x=None, y=None, measures=None, **settings))]
pub fn study<'py>(
    py: Python<'py>,
    clip: &Clip,
    recipe: Option<Recipe>,
    x: Option<(String, Bound<'py, PyAny>)>,
    y: Option<(String, Bound<'py, PyAny>)>,
    measures: Option<Vec<String>>,
    settings: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let is_table_1 = x.is_none() && y.is_none();
    let own = if is_table_1 { table_1_recipe() } else { Recipe::default().recipe };
    let own = Recipe { recipe: own, ..Recipe::default() };
    let recipe = settings_alone(py, recipe.unwrap_or(own).with(py, settings)?)?;
    let parse =
        |(name, values): (&str, &str)| Axis::new(name, values).map_err(|error| raised(py, error));
    let (x, y) = match (x, y) {
        (None, None) => {
            (parse(("filter.width", "10,20,30"))?, Some(parse(("turns.persistence", "5,10"))?))
        }
        (Some(x), y) => (axis(py, x)?, y.map(|y| axis(py, y)).transpose()?),
        (None, Some(_)) => {
            return Err(asked_wrongly(py, "y is varied for each value of x: give x too"));
        }
    };
    let measures = measures.unwrap_or_else(|| vec!["union".into(), "total".into()]);
    let measures: std::result::Result<Vec<Measure>, _> =
        measures.iter().map(|name| name.parse()).collect();
    let measures = measures.map_err(|error| raised(py, error))?;
    let study = Study { recipe, x, y, measures, keep_keys: false, budget: Budget::default() };
    let motion = clip.motion.clone();
    let made = work::done(py, move |is_ended| {
        study.run_while(motion, || !is_ended.load(Ordering::Relaxed))
    })?;
    match made.map_err(|error| raised(py, error))? {
        Some(grid) => columns(py, &grid),
        None => Err(PyKeyboardInterrupt::new_err(())),
    }
}

/// Returns the settings of a recipe, and warns that its corrections do not count here.
fn settings_alone(py: Python<'_>, recipe: Recipe) -> PyResult<genga::recipe::Recipe> {
    if recipe.edits != genga::edits::Edits::default() {
        warned(
            py,
            "the recipe's corrections (pins, moves, holds, …) are ignored here: only its settings are compared",
        )?;
    }
    Ok(recipe.recipe)
}

/// Parses an axis: values as the program takes them, or a list.
fn axis(py: Python<'_>, (name, values): (String, Bound<'_, PyAny>)) -> PyResult<Axis> {
    let words = match values.extract::<String>() {
        Ok(words) => words,
        Err(_) => {
            let words = values.try_iter()?.map(|value| word(&value?));
            words.collect::<PyResult<Vec<_>>>()?.join(",")
        }
    };
    Axis::new(&name, &words).map_err(|error| raised(py, error))
}

fn columns<'py>(py: Python<'py>, grid: &Grid) -> PyResult<Bound<'py, PyDict>> {
    let rows = grid.rows();
    let cells = 0..grid.cells.len();
    let of_x = Column::words(cells.clone().map(|at| &*grid.x.values()[at / rows]));
    let made = table(py, [(grid.x.name(), of_x)])?;
    if let Some(y) = &grid.y {
        let of_y = Column::words(cells.map(|at| &*y.values()[at % rows]));
        made.update(table(py, [(y.name(), of_y)])?.as_mapping())?;
    }
    for measure in &grid.measures {
        let values = grid.values(*measure).unwrap_or_default();
        made.set_item(measure.name(), PyArray1::from_vec(py, values))?;
    }
    Ok(made)
}

/// Evaluates a sheet (the text of a `sheet.json`, or the dict of `Result.to_json()`) against its clip. `reference` are
/// key frames that somebody else chose; a key within `tolerance` koma of one counts as the same. Returns nested dicts
/// like the output of `genga eval --json`. Errors are in % of body height.
#[pyfunction]
#[pyo3(signature = (clip, sheet, *, reference=None, tolerance=1.0))]
pub fn evaluate<'py>(
    py: Python<'py>,
    clip: &Clip,
    sheet: &Bound<'py, PyAny>,
    reference: Option<Vec<usize>>,
    tolerance: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let sheet = match sheet.cast::<PyDict>() {
        Ok(files) => files.as_any().get_item("sheet.json")?,
        Err(_) => sheet.clone(),
    };
    let text: Vec<u8> =
        sheet.extract::<String>().map(String::into_bytes).or_else(|_| sheet.extract())?;
    let reference: Option<Vec<Frame>> =
        reference.map(|frames| frames.into_iter().map(Frame).collect());
    let motion = clip.motion.clone();
    let made = work::done(py, move |_| {
        let file = sheet_json::read(&text)?;
        let (source, notes) = file.fit((*motion).clone())?;
        let drawn = file.drawn(&source)?.unwrap_or(source);
        Ok((Evaluation::new(&drawn, &file.sheet, reference.as_deref(), tolerance)?, notes))
    })?;
    let (evaluation, notes) = made.map_err(|error| raised(py, error))?;
    notes.iter().try_for_each(|note| warned(py, note))?;
    plain(py, &evaluation)
}

/// Chooses the same number of keys by several methods, and evaluates each. `keys` lists the numbers of keys, without
/// both ends. `noise`, in degrees, is added to every rotation for the column `steady`. Returns a dict of columns with
/// one row per method and number. Errors are in % of body height; missing values are NaN.
#[pyfunction]
#[pyo3(signature = (clip, recipe=None, *, keys=vec![], noise=0.1, **settings))]
pub fn compare<'py>(
    py: Python<'py>,
    clip: &Clip,
    recipe: Option<Recipe>,
    keys: Vec<usize>,
    noise: f64,
    settings: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let recipe = settings_alone(py, recipe.unwrap_or_default().with(py, settings)?)?;
    let noise = Noise { degrees: noise, ..Noise::default() };
    let asked = Compare { recipe, counts: keys, noise, ..Compare::default() };
    let motion = clip.motion.clone();
    let made = work::done(py, move |_| asked.run(motion))?.map_err(|error| raised(py, error))?;
    let rows: Vec<&Row> = made.rows.iter().chain(&made.paces).collect();
    let number = |of: fn(&Row) -> Option<f64>| {
        Column::numbers(rows.iter().map(|row| of(row).unwrap_or(f64::NAN)))
    };
    table(
        py,
        [
            ("method", Column::words(rows.iter().map(|row| row.method.word()))),
            ("asked", Column::counts(rows.iter().map(|row| row.asked))),
            ("keys", Column::counts(rows.iter().map(|row| row.keys))),
            ("mean", number(|row| Some(row.mean))),
            ("worst", number(|row| Some(row.worst))),
            ("mean_ratio", number(|row| row.mean_ratio)),
            ("worst_ratio", number(|row| row.worst_ratio)),
            ("hits", number(|row| row.hits)),
            ("by_chance", number(|row| row.by_chance)),
            ("off", number(|row| row.off)),
            ("steady", number(|row| row.steady)),
        ],
    )
}
