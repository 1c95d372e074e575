//! Studies of settings, judgements of sheets, comparisons of methods.

use std::fs;
use std::sync::Arc;

use genga::motion::Clip as Motion;
use genga::pipeline::{Budget, Stop};
use genga_files::sheet_json;
use genga_lab::quality::{Compare, Evaluation, Row};
use genga_lab::study::{Axis, Grid, Measure, Noise, Study, is_table_1, table_1_recipe};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::clip::{Clip, Given, taken};
use crate::error::{asked_wrongly, raised, warned};
use crate::recipe::Recipe;
use crate::reference::ReferenceKeys;
use crate::table::{Column, plain, table};
use crate::words::{settings, unexpected, word};
use crate::work;

/// Varies one or two settings and measures the result for each combination. `x` and `y` are a name with its values:
/// `("filter.width", "10..60:5")`, `("filter.width", [10, 20, 30])` or `{"filter.width": [10, 20, 30]}`. Without both, computes Table 1 of the first
/// paper. Where the axes are both axes of Table 1 and nothing else (`filter.width` and `turns.persistence`, in
/// either order, whatever their values), all other settings are the paper's, `Recipe.table_1()`; with any other axes,
/// and with `filter.width` alone, they are those of `run`, `Recipe()`. A recipe that is given replaces either, and
/// `settings` are applied to it. Returns a `genga.Study`: a dict of columns with one row per combination, whose
/// attribute `recipe` is the recipe that was used and whose `notes` say what frames on an axis are in seconds, at each
/// frame rate of the clips; of several rates they are warnings too. Its columns are both settings, then one for each of `measures`
/// (a list, or text such as "union,total"): turns, genga, fills, union, total, drawings, drawings_per_second,
/// genga_per_second, longest_hold, held_koma, peak_ssd and median_ssd. By default they are the first five, or all if an
/// axis is a setting of the sheet (`spacing`, `omission`). The column of a setting has numbers if all of its values are plain
/// numbers, whole ones if all are whole: `table["union"][table["filter.width"] == 10]`. If one has a unit or is a word
/// (`"0.1s"`, `"4%"`, `"none"`), the column has text, each value as the recipe file writes it. With `per_joint` the columns are `joint` and `keys` and the
/// rows one per joint. Several clips, or motion files, in a list or another iterable, have a column `clip` first. A setting that is also an axis raises
/// `genga.Error`.
#[pyfunction]
#[pyo3(signature = (clip, recipe=None, *, x=None, y=None, measures=None, per_joint=false, **settings))]
#[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
pub fn study<'py>(
    py: Python<'py>,
    clip: &Bound<'py, PyAny>,
    recipe: Option<Recipe>,
    x: Option<Bound<'py, PyAny>>,
    y: Option<Bound<'py, PyAny>>,
    measures: Option<Bound<'py, PyAny>>,
    per_joint: bool,
    settings: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (x, y) = axes(py, x, y)?;
    not_set_too(py, &x, y.as_ref(), settings)?;
    let own = match is_table_1(&x, y.as_ref()) {
        true => table_1_recipe(),
        false => Recipe::default().recipe,
    };
    let own = Recipe { recipe: own, ..Recipe::default() };
    let recipe = settings_alone(py, recipe.unwrap_or(own).with_of(py, settings, "study")?)?;
    if per_joint && measures.is_some() {
        let message = "per_joint counts the keys of each joint: leave measures out";
        return Err(asked_wrongly(py, message));
    }
    let measures = match measures {
        Some(names) => match names.extract::<String>() {
            Ok(names) => names.split(',').map(|name| name.trim().parse()).collect(),
            Err(_) => names.extract::<Vec<String>>()?.iter().map(|name| name.parse()).collect(),
        },
        None => Ok(Measure::usual(&x, y.as_ref())),
    };
    let measures = measures.map_err(|error| raised(py, error))?;
    let study = Study { recipe, x, y, measures, keep_keys: false, budget: Budget::default() };
    let (clips, are_several) = several(clip)?;
    let names: Vec<String> = clips.iter().map(|clip| clip.get().cut()).collect();
    let names = are_several.then_some(&*names);
    let rates: Vec<_> = clips.iter().map(|clip| clip.get().motion.rate()).collect();
    let notes = study.in_seconds(&rates);
    if rates.iter().any(|rate| *rate != rates[0]) {
        notes.iter().try_for_each(|note| warned(py, note))?;
    }
    if per_joint {
        let joints: Vec<Vec<String>> = clips.iter().map(|clip| clip.get().joints()).collect();
        let counts = each(py, &study, &clips, |study, motion, stop| {
            study.joints_while(motion, || !stop.is_asked())
        })?;
        let table = of_joints(py, (&study, names), &joints, &counts)?;
        return with_recipe(&table, study.recipe, notes);
    }
    let grids = each(py, &study, &clips, |study, motion, stop| {
        study.run_while(motion, || !stop.is_asked())
    })?;
    with_recipe(&of_cells(py, (&study, names), &grids)?, study.recipe, notes)
}

/// Builds the `genga.Study` of a table, the recipe that was used and its notes.
fn with_recipe<'py>(
    table: &Bound<'py, PyDict>,
    recipe: genga::recipe::Recipe,
    notes: Vec<String>,
) -> PyResult<Bound<'py, PyAny>> {
    let made = table.py().import("genga._study")?.getattr("Study")?.call1((table,))?;
    made.setattr("recipe", Recipe { recipe, ..Recipe::default() })?;
    made.setattr("notes", notes)?;
    Ok(made)
}

/// Refuses a value of what is on an axis, or can only be.
fn not_set_too(
    py: Python<'_>,
    x: &Axis,
    y: Option<&Axis>,
    asked: Option<&Bound<'_, PyDict>>,
) -> PyResult<()> {
    let is_varied = |name: &str| [Some(x), y].into_iter().flatten().any(|axis| axis.name() == name);
    for (name, _) in settings(asked)? {
        let message = match &*name {
            name if is_varied(name) => "a study varies it already".into(),
            name if Noise::AXES.contains(&name) => {
                format!("it is no setting but an axis of a study, as in x=(\"{name}\", [0, 1])")
            }
            _ => continue,
        };
        return Err(raised(py, genga::Error::setting(name, message)));
    }
    Ok(())
}

/// Parses the axes; those of Table 1 by default.
fn axes<'py>(
    py: Python<'py>,
    x: Option<Bound<'py, PyAny>>,
    y: Option<Bound<'py, PyAny>>,
) -> PyResult<(Axis, Option<Axis>)> {
    let parse =
        |(name, values): (&str, &str)| Axis::new(name, values).map_err(|error| raised(py, error));
    match (x, y) {
        (None, None) => {
            Ok((parse(("filter.width", "10,20,30"))?, Some(parse(("turns.persistence", "5,10"))?)))
        }
        (Some(x), y) => Ok((axis("x", &x)?, y.map(|y| axis("y", &y)).transpose()?)),
        (None, Some(_)) => Err(asked_wrongly(py, "y is varied for each value of x: give x too")),
    }
}

/// Returns the clips of a list or another iterable, or the one that is given, and whether there may be several.
fn several<'py>(source: &Bound<'py, PyAny>) -> PyResult<(Vec<Bound<'py, Clip>>, bool)> {
    let sources = match source.extract::<Given<'_>>() {
        Ok(_) => None,
        Err(_) => source.try_iter().ok(),
    };
    let Some(sources) = sources else { return Ok((vec![taken(source)?], false)) };
    let clips: Vec<_> = sources.map(|clip| taken(&clip?)).collect::<PyResult<_>>()?;
    match clips.is_empty() {
        true => Err(asked_wrongly(source.py(), "there is no clip in the list")),
        false => Ok((clips, true)),
    }
}

/// Runs a study on a clip; `None` if it was stopped.
type Run<T> = fn(&Study, Arc<Motion>, &Stop) -> std::result::Result<Option<T>, genga::Error>;

/// Studies one clip after another.
fn each<T: Send + 'static>(
    py: Python<'_>,
    study: &Study,
    clips: &[Bound<'_, Clip>],
    run: Run<T>,
) -> PyResult<Vec<T>> {
    let study = study.clone();
    let motions: Vec<_> = clips.iter().map(|clip| Arc::clone(&clip.get().motion)).collect();
    let made = work::done(py, move |stop| {
        let of_one = |motion| run(&study, motion, stop)?.ok_or(genga::Error::Stopped);
        motions.into_iter().map(of_one).collect::<std::result::Result<Vec<T>, _>>()
    })?;
    made.map_err(|error| raised(py, error))
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

/// Parses an axis: a name with its values, which are text as the program takes it, or a list.
fn axis(argument: &str, given: &Bound<'_, PyAny>) -> PyResult<Axis> {
    let py = given.py();
    let (name, values) = named(argument, given)?;
    let words = match values.extract::<String>() {
        Ok(words) => words,
        Err(_) => {
            let values = values.try_iter().map_err(|_| {
                let message = "expected a list of values, or text such as \"10..60:5\"";
                raised(py, genga::Error::setting(&*name, message))
            })?;
            let words = values.map(|value| word(&value?));
            words.collect::<PyResult<Vec<_>>>()?.join(",")
        }
    };
    Axis::new(&name, &words).map_err(|error| raised(py, error))
}

/// Takes a name and its values from a tuple or a dict of one.
fn named<'py>(argument: &str, given: &Bound<'py, PyAny>) -> PyResult<(String, Bound<'py, PyAny>)> {
    let pair = match given.cast::<PyDict>() {
        Ok(dict) if dict.len() == 1 => dict.items().get_item(0)?,
        _ => given.clone(),
    };
    let found = given.repr()?;
    pair.extract().map_err(|_| {
        let message = format!(
            "expected a name and its values, as in (\"filter.width\", [10, 20]), found {found}"
        );
        raised(given.py(), genga::Error::setting(argument, message))
    })
}

/// Builds the columns that say which cell of which clip a row is of; `rows` is how many each cell of a clip has.
fn cells<'py>(
    py: Python<'py>,
    (study, names): (&Study, Option<&[String]>),
    rows: &[usize],
) -> PyResult<Bound<'py, PyDict>> {
    let of_y = study.y.as_ref().map_or(1, Axis::len);
    let each = || {
        let cells = rows
            .iter()
            .enumerate()
            .flat_map(|(clip, rows)| (0..study.len()).map(move |cell| (clip, cell, *rows)));
        cells.flat_map(|(clip, cell, rows)| std::iter::repeat_n((clip, cell), rows))
    };
    let made = PyDict::new(py);
    if let Some(names) = names {
        let of_clip = Column::words(each().map(|(clip, _)| &*names[clip]));
        made.update(table(py, [("clip", of_clip)])?.as_mapping())?;
    }
    let of_x: Vec<_> = each().map(|(_, cell)| &*study.x.values()[cell / of_y]).collect();
    made.update(table(py, [(study.x.name(), Column::read(&of_x))])?.as_mapping())?;
    if let Some(y) = &study.y {
        let of_y: Vec<_> = each().map(|(_, cell)| &*y.values()[cell % of_y]).collect();
        made.update(table(py, [(y.name(), Column::read(&of_y))])?.as_mapping())?;
    }
    Ok(made)
}

fn of_cells<'py>(
    py: Python<'py>,
    (study, names): (&Study, Option<&[String]>),
    grids: &[Grid],
) -> PyResult<Bound<'py, PyDict>> {
    let made = cells(py, (study, names), &vec![1; grids.len()])?;
    for measure in &study.measures {
        let values = grids.iter().flat_map(|grid| grid.values(*measure).unwrap_or_default());
        let column = match measure.is_whole() {
            true => Column::counts(values.map(|value| value as usize)),
            false => Column::numbers(values),
        };
        made.update(table(py, [(measure.name(), column)])?.as_mapping())?;
    }
    Ok(made)
}

/// Builds one row per joint of each cell; `counts` has a list of joints for each cell of each clip.
fn of_joints<'py>(
    py: Python<'py>,
    (study, names): (&Study, Option<&[String]>),
    joints: &[Vec<String>],
    counts: &[Vec<Vec<usize>>],
) -> PyResult<Bound<'py, PyDict>> {
    let rows: Vec<usize> = joints.iter().map(Vec::len).collect();
    let made = cells(py, (study, names), &rows)?;
    let of_clips = joints.iter().zip(counts);
    let joint = of_clips.flat_map(|(joints, cells)| cells.iter().flat_map(|_| joints.clone()));
    let keys = Column::counts(counts.iter().flatten().flatten().copied());
    made.update(table(py, [("joint", Column::words(joint)), ("keys", keys)])?.as_mapping())?;
    Ok(made)
}

/// Evaluates a sheet (a `genga.Result`, the dict of `Result.to_json()`, or a `sheet.json` as a path, its text or bytes)
/// against its clip. `reference` are key frames that somebody else chose: whole numbers, another `genga.Result`, or a path or the
/// bytes of a file of keys: a `sheet.json`, a CSV with a column `frame` or `source_frame`, or one frame per line. A key within `tolerance`
/// koma of one counts as the same. Those beyond the sheet and repeated ones do not count, with a warning. Nor do keys
/// within the first or last koma of the clip, in `reference` and in `found`, for both ends are always drawn; a warning
/// tells of those in `reference` that are neither the clip's ends nor those of the sheet. Of several layers the screen
/// is judged together, keys and pace by the first, with a warning; so are the keys of a `reference` that is a result.
///
/// Returns nested dicts. Errors are in % of body height. `timing` has the scores against `reference`, and is None
/// without it: `reference` and `found`, the numbers of keys; `pairs` of them that match one to one; `precision`, the
/// share of those found that are in a pair; `recall`, that of the reference; `f1`, the harmonic mean of both;
/// `mean_off`, the mean distance in koma from a reference key to the nearest found one, over all reference keys,
/// whatever the tolerance; `off_95`, its 95th percentile. Anything else as a sheet raises `TypeError`.
#[pyfunction]
#[pyo3(signature = (clip, sheet, *, reference=None, tolerance=1.0))]
pub fn evaluate<'py>(
    py: Python<'py>,
    clip: &Bound<'py, PyAny>,
    sheet: &Bound<'py, PyAny>,
    reference: Option<&Bound<'py, PyAny>>,
    tolerance: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let text = text_of(sheet)?;
    let reference = reference.map(ReferenceKeys::of).transpose()?;
    let motion = taken(clip)?.get().motion.clone();
    let fitted = work::done(py, move |_| {
        let file = sheet_json::read(&text)?;
        let (source, notes) = file.fit((*motion).clone())?;
        let drawn = file.drawn(&source)?;
        Ok((file.sheet, source, drawn, notes))
    })?;
    let (sheet, source, drawn, notes) = fitted.map_err(|error| raised(py, error))?;
    let reference = reference.map(|keys| keys.frames(py, &source)).transpose()?;
    let drawn = drawn.unwrap_or(source);
    let others = Evaluation::notes(&drawn, &sheet, reference.as_deref());
    notes.iter().try_for_each(|note| warned(py, note))?;
    others.iter().try_for_each(|note| warned(py, note))?;
    let made =
        work::done(py, move |_| Evaluation::new(&drawn, &sheet, reference.as_deref(), tolerance))?;
    plain(py, &made.map_err(|error| raised(py, error))?)
}

/// Returns the text of a sheet that is given as a result, as its files, as a path or as the text.
pub fn text_of(sheet: &Bound<'_, PyAny>) -> PyResult<Vec<u8>> {
    let files = match sheet.is_instance_of::<crate::result::Result>() {
        true => sheet.call_method0("to_json")?,
        false => sheet.clone(),
    };
    let wrongly = || {
        let kind = sheet.get_type();
        PyTypeError::new_err(format!(
            "expected a genga.Result, the dict of its to_json(), or the path or the text of a sheet.json, not {kind}"
        ))
    };
    let text = match files.cast::<PyDict>() {
        Ok(files) => files.get_item("sheet.json")?.ok_or_else(wrongly)?,
        Err(_) => files,
    };
    match text.extract::<String>() {
        Ok(text) if text.trim_start_matches('\u{feff}').trim_start().starts_with('{') => {
            return Ok(text.into_bytes());
        }
        _ => {}
    }
    match text.extract().map_err(|_| wrongly())? {
        Given::Bytes(bytes) => Ok(bytes.as_bytes().to_vec()),
        Given::Path(path) => {
            fs::read(&path).map_err(|source| raised(sheet.py(), genga::Error::Io { path, source }))
        }
    }
}

/// Chooses the same number of keys by several methods, and evaluates each. `keys` lists the numbers of keys, without
/// both ends; by default as many as the recipe finds, half and double. `noise`, in degrees, is added to every rotation
/// for the column `steady`.
///
/// Recipe and settings are those of the method `genga`. `kt11`, the first paper alone, takes none of them but the rate:
/// its settings are those of `Recipe.table_1()`, without rests, and its keys those shared by most joints first. The keys
/// that the recipe finds are counted before timing, without both ends and corrections. The genga of a run are other in
/// number, for its report counts both ends, and on its sheet a key that is too close to another or to an end gives way.
///
/// Returns a dict of columns with one row per method and number: `asked` and `keys`, the numbers; `mean` and `worst`,
/// the error of the motion slerped between the keys, in % of body height; `mean_ratio` and `worst_ratio`, the same as a
/// multiple of the least possible; `hits`, the share of the largest turns of wrists, ankles or head in the world, as
/// many as keys, that have a key within a koma; `by_chance`, the mean of that share if the keys are rotated around the
/// clip by 1, 2, 3 … koma; `off`, the mean distance from such a turn to the nearest key, in koma; `steady`, the F1
/// within a koma between the keys with and without noise. Missing values are NaN.
#[pyfunction]
#[pyo3(signature = (clip, recipe=None, *, keys=vec![], noise=0.1, **settings))]
pub fn compare<'py>(
    py: Python<'py>,
    clip: &Bound<'py, PyAny>,
    recipe: Option<Recipe>,
    #[pyo3(from_py_with = counts)] keys: Vec<usize>,
    noise: f64,
    settings: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let recipe = settings_alone(py, recipe.unwrap_or_default().with_of(py, settings, "compare")?)?;
    let noise = Noise { degrees: noise, ..Noise::default() };
    let asked = Compare { recipe, counts: keys, noise, ..Compare::default() };
    let motion = taken(clip)?.get().motion.clone();
    let made = work::done(py, move |stop| asked.run_until(motion, stop))?
        .map_err(|error| raised(py, error))?;
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

/// Takes the argument `keys` of `compare`.
fn counts(given: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    let expected = "a list of whole numbers, 1 or more, as in [8, 16]";
    given.extract().map_err(|_| unexpected("keys", expected, given))
}
