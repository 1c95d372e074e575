//! A run: the sheet and all intermediate results.

use std::fs;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use genga::keys::Key;
use genga::pipeline::{Breakdown, Engine, LayerBreakdown};
use genga::sheet::{Drawing, Layer};
use genga::signal::{Signals, Turn, TurnKind};
use genga::target::{Outcome, Target, meet};
use genga_files::{Format, Report, Settings, limited};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::clip::Clip;
use crate::corrections::Corrections;
use crate::error::{raised, warned};
use crate::files::{Files, Handed};
use crate::recipe::Recipe;
use crate::table::{Column, plain, table};
use crate::targets::{targets as targets_of, told};
use crate::words::settings;
use crate::work;

/// The result of a run. Each attribute is computed on access.
#[pyclass(frozen, module = "genga")]
pub struct Result {
    /// The cached stages: running again with the same settings computes nothing.
    engine: Mutex<Engine>,
    settings: Recipe,
    outcomes: Vec<Outcome>,
    cut: String,
    file: String,
}

/// The timesheet (タイムシート): which drawing is shown on which koma.
#[pyclass(frozen, get_all, module = "genga")]
pub struct Sheet {
    /// Koma per second.
    rate: f64,
    /// Length of the sheet in koma, K.
    koma: usize,
    /// One row per drawing: `layer`, `drawing` (its number in the layer, from 0), `place` (source frame, fractional),
    /// `role` (genga, inbetween, end), `reason`, `strength`, `price` (% of body height), `why`.
    drawings: Py<PyDict>,
    /// One row per exposure: `layer`, `begin` (koma from 0), `koma` (length), `drawing`.
    exposures: Py<PyDict>,
}

/// The input of a run.
struct Begun {
    engine: Engine,
    settings: Recipe,
    targets: Vec<Target>,
    cut: String,
    file: String,
}

impl Begun {
    /// Finds the settings that meet the targets, and runs the clip with them.
    fn run(mut self) -> std::result::Result<Result, genga::Error> {
        let Recipe { recipe, edits } = &mut self.settings;
        let mut outcomes = Vec::new();
        if !self.targets.is_empty() {
            let met = meet(&mut self.engine, recipe, edits, &self.targets)?;
            (*recipe, outcomes) = (met.recipe, met.outcomes);
        }
        self.engine.run(recipe, edits)?;
        let Self { engine, settings, cut, file, .. } = self;
        Ok(Result { engine: Mutex::new(engine), settings, outcomes, cut, file })
    }

    fn done(self, py: Python<'_>) -> PyResult<Result> {
        work::done(py, move |_| self.run())?.map_err(|error| raised(py, error))
    }
}

/// Finds the key drawings of a clip and times them. Settings have the recipe's names: `keys={"min_price": 15}`,
/// `keys__min_price=15` and `**{"keys.min_price": 15}` are the same. `pins` are frames that are always keys (42,
/// (42, "contact"), "42:contact@0.5"); `forbid` are frames without a key nearby (42, "120..140"); `moves` are pairs
/// (from, to), `holds` pairs (frame, koma). `targets` are wanted properties of the sheet, `{"keys": 9}`,
/// `{"drawings_per_second": 6}` or `{"max_error": 8}` (% of body height), for which genga searches settings. `name` is
/// the name of the cut.
#[pyfunction]
#[pyo3(signature = (clip, recipe=None, *, pins=vec![], forbid=vec![], moves=vec![], holds=vec![], only_pins=false, targets=None, name=None, **settings))]
#[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
pub fn run<'py>(
    py: Python<'py>,
    clip: &Clip,
    recipe: Option<Recipe>,
    pins: Vec<Bound<'py, PyAny>>,
    forbid: Vec<Bound<'py, PyAny>>,
    moves: Vec<Bound<'py, PyAny>>,
    holds: Vec<Bound<'py, PyAny>>,
    only_pins: bool,
    targets: Option<&Bound<'py, PyDict>>,
    name: Option<String>,
    settings: Option<&Bound<'py, PyDict>>,
) -> PyResult<Result> {
    let mut asked = recipe.unwrap_or_default().with(py, settings)?;
    Corrections { pins, forbid, moves, holds, only_pins }.add_to(py, &mut asked.edits)?;
    let begun = Begun {
        engine: Engine::new(clip.motion.clone()).map_err(|error| raised(py, error))?,
        settings: asked,
        targets: targets_of(py, targets)?,
        cut: name.unwrap_or_else(|| clip.cut()),
        file: clip.file.clone(),
    };
    begun.done(py)
}

impl Result {
    /// Passes the breakdown to `at`, with Python's lock released.
    fn look<T: Send>(
        &self,
        py: Python<'_>,
        at: impl FnOnce(&Breakdown<'_>) -> std::result::Result<T, genga::Error> + Send,
    ) -> PyResult<T> {
        let Recipe { recipe, edits } = &self.settings;
        let looked = py.detach(|| {
            let mut engine = self.engine.lock().ok()?;
            Some(engine.run(recipe, edits).and_then(|breakdown| at(&breakdown)))
        });
        let looked = looked.ok_or_else(|| PyRuntimeError::new_err("an earlier access failed"))?;
        looked.map_err(|error| raised(py, error))
    }

    fn files_of(
        &self,
        py: Python<'_>,
        names: &[String],
        asked: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Files> {
        let formats = Format::find_all(names.iter().map(String::as_str))
            .map_err(|error| raised(py, error))?;
        let mut own = Settings::default();
        for (name, word) in settings(asked)? {
            own.set(&name, &word).map_err(|error| raised(py, error))?;
        }
        let Recipe { recipe, edits } = &self.settings;
        let handed = Handed { cut: &self.cut, file: &self.file, recipe, edits };
        let mut interrupt = None;
        let go_on = || {
            // Ctrl-C reaches only the caller's thread, which is this one.
            Python::attach(|py| py.check_signals()).map_err(|error| {
                interrupt = Some(error);
                genga::Error::clip("interrupted by Ctrl-C")
            })
        };
        let files = self.look(py, |breakdown| handed.files(breakdown, (&formats, &own), go_on));
        let (files, notes) = interrupt.map_or(files, Err)?;
        notes.iter().try_for_each(|note| warned(py, note))?;
        Ok(files)
    }

    fn dict<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        asked: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let files = PyDict::new(py);
        for (name, bytes) in self.files_of(py, &[format.to_owned()], asked)? {
            files.set_item(name, PyBytes::new(py, &bytes))?;
        }
        Ok(files)
    }

    fn matrix<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Breakdown<'_>) -> Signals + Send + Sync,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let signals = self.look(py, |breakdown| Ok(of(breakdown)))?;
        let (frames, joints) = (signals.frames(), signals.joints());
        // A single copy of the run's data. Each joint is contiguous, so the array is in Fortran order.
        let flat: Vec<f64> = signals.values.data.into();
        PyArray1::from_vec(py, flat).reshape([joints, frames])?.transpose()
    }
}

macro_rules! hand_over {
    ($($name:ident $format:literal $what:literal,)*) => {
        #[pymethods]
        impl Result {$(
            #[doc = $what]
            #[doc = " Returns a dict from file names to bytes; settings are those of the program's `--with`."]
            #[pyo3(signature = (**settings))]
            fn $name<'py>(&self, py: Python<'py>, settings: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyDict>> {
                self.dict(py, $format, settings)
            }
        )*}
    };
}

hand_over! {
    to_json "json" "The sheet as JSON, which can be edited and read again.",
    to_csv "csv" "Tables of keys, drawings and koma.",
    to_remap "remap" "The timing only, for a rig that plays the same take.",
    to_bvh "bvh" "The stepped motion: one row per koma, holds repeated.",
    to_bvh_keys "bvh-keys" "The key drawings as poses: one row per genga.",
    to_xdts "xdts" "Timesheets for drawing programs.",
    to_tdts "tdts" "Both timesheets in one file.",
    to_sts "sts" "The timesheet for older programs.",
    to_columns "columns" "The timesheet as a table: one column per layer, one row per koma.",
    to_ae "ae" "Time remapping to paste into After Effects.",
    to_xsheet "xsheet" "The timesheet on paper: HTML, and each page as SVG.",
    to_vmd "vmd" "The motion for MikuMikuDance, and a list of joints and bones.",
    to_glb "glb" "The stepped motion as GLB, with visible bones and each drawing's role.",
    to_vrma "vrma" "The stepped motion for VRM avatars.",
    to_bars "bars" "Picture: one bar per drawing, over koma.",
    to_poses "poses" "Picture: the poses of genga and ends in a row.",
    to_strip "strip" "Picture: source above result, koma by koma.",
    to_contact "contact" "Picture: contact sheet of the genga.",
    to_onion "onion" "Picture: the drawings from each genga to the next, overlaid.",
    to_flipbook "flipbook" "A page to play and step through in any browser.",
    to_preview "preview" "Animated GIF: source beside result.",
    to_images "images" "One PNG per drawing, numbered as on the sheet, to draw over.",
    to_cut "cut" "A cut folder: timesheets, and each column's pictures named by cel number.",
}

#[pymethods]
impl Result {
    /// The timesheet.
    #[getter]
    fn sheet(&self, py: Python<'_>) -> PyResult<Sheet> {
        let sheet = self.look(py, |breakdown| Ok(breakdown.sheet.clone()))?;
        Ok(Sheet {
            rate: sheet.clock.koma_rate,
            koma: sheet.length(),
            drawings: drawings(py, &sheet.layers)?.unbind(),
            exposures: exposures(py, &sheet.layers)?.unbind(),
        })
    }

    /// The keys, one row each: `layer`, `frame`, `strength` (0 to 1), `price` (the error without the key, in % of body
    /// height; infinite for a key that always stays), `reason`, `name`, `joints`.
    #[getter]
    fn keys<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = self.look(py, |breakdown| Ok(key_rows(breakdown)))?;
        let of_key = || rows.iter().map(|row| &row.key);
        table(
            py,
            [
                ("layer", Column::words(rows.iter().map(|row| &*row.layer))),
                ("frame", Column::counts(of_key().map(|key| key.frame.0))),
                ("strength", Column::numbers(of_key().map(|key| key.strength))),
                ("price", Column::numbers(of_key().map(|key| key.price))),
                ("reason", Column::words(of_key().map(|key| key.origin.reason().word()))),
                ("name", Column::words(of_key().map(|key| key.name.clone().unwrap_or_default()))),
                ("joints", Column::words(rows.iter().map(|row| &*row.joints))),
            ],
        )
    }

    /// Turns of single joints, one row each: `joint` (index), `frame`, `kind` (key, wall), `confirmed_for` (frames).
    #[getter]
    fn turns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let turns = self.look(py, |breakdown| Ok(breakdown.turns.to_vec()))?;
        let each = || turns.iter().flatten();
        let kind = |turn: &Turn| if turn.kind == TurnKind::Key { "key" } else { "wall" };
        let joints =
            turns.iter().enumerate().flat_map(|(joint, turns)| turns.iter().map(move |_| joint));
        table(
            py,
            [
                ("joint", Column::counts(joints)),
                ("frame", Column::counts(each().map(|turn| turn.frame.0))),
                ("kind", Column::words(each().map(kind))),
                ("confirmed_for", Column::counts(each().map(|turn| turn.confirmed_for))),
            ],
        )
    }

    /// Speed of each joint: float64 (F, J), radians per second, or units per second if displacement is measured.
    #[getter]
    fn speeds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.matrix(py, |breakdown| breakdown.speed.clone())
    }

    /// The smoothed speeds: float64 (F, J), in the unit of `speeds`.
    #[getter]
    fn filtered<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.matrix(py, |breakdown| breakdown.filtered.clone())
    }

    /// The stepped motion, as a clip at the sheet's rate: one frame per koma, so its arrays are (K, J, …). It equals
    /// `limited.bvh`.
    #[getter]
    fn limited(&self, py: Python<'_>) -> PyResult<Clip> {
        let motion = self.look(py, |breakdown| limited(breakdown.clip, breakdown.sheet))?;
        Ok(Clip::new(Arc::new(motion), format!("{}_limited.bvh", self.cut), Vec::new()))
    }

    /// The reason for each drawing, as text: a list in the order of `sheet.drawings`.
    #[getter]
    fn why(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let of_all = |breakdown: &Breakdown<'_>| {
            let drawings = breakdown.sheet.layers.iter().flat_map(|layer| &layer.drawings);
            Ok(drawings.map(|drawing| drawing.why.to_string()).collect())
        };
        self.look(py, of_all)
    }

    /// The figures of `report.json`.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let report = self.look(py, |breakdown| Ok(Report::new(breakdown, Vec::new())))?;
        plain(py, &report)
    }

    /// The settings and corrections of the run.
    #[getter]
    fn recipe(&self) -> Recipe {
        self.settings.clone()
    }

    /// The outcome of each target: dicts with `target`, `asked`, `reached`, `why` (None if it was met) and `words`, a
    /// sentence.
    #[getter]
    fn outcomes<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        self.outcomes.iter().map(|outcome| told(py, outcome)).collect()
    }

    /// Runs the clip again, beginning with the first stage that changes. `recipe` replaces this run's settings and
    /// corrections; `settings` are then applied to it.
    #[pyo3(signature = (recipe=None, *, targets=None, **settings))]
    fn again(
        &self,
        py: Python<'_>,
        recipe: Option<Recipe>,
        targets: Option<&Bound<'_, PyDict>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let asked = recipe.unwrap_or_else(|| self.settings.clone()).with(py, settings)?;
        let engine = py.detach(|| self.engine.lock().map(|engine| engine.clone()).ok());
        let engine = engine.ok_or_else(|| PyRuntimeError::new_err("an earlier access failed"))?;
        let (cut, file) = (self.cut.clone(), self.file.clone());
        let targets = targets_of(py, targets)?;
        Begun { engine, settings: asked, targets, cut, file }.done(py)
    }

    /// Writes files of the given formats into a folder, which it creates. Returns their paths.
    #[pyo3(signature = (folder, *formats, **settings))]
    fn write(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        formats: Vec<String>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Vec<PathBuf>> {
        let mut written = Vec::new();
        for (name, bytes) in self.files_of(py, &formats, settings)? {
            let path = folder.join(name);
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::write(&path, bytes)?;
            written.push(path);
        }
        Ok(written)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (koma, drawings) = self.look(py, |breakdown| {
            let shown = breakdown.sheet.layers.iter().map(|layer| layer.shown().count());
            Ok((breakdown.sheet.length(), shown.sum::<usize>()))
        })?;
        Ok(format!("<genga.Result {}: {koma} koma, {drawings} drawings>", self.cut))
    }
}

/// A key and the texts that need the clip.
struct KeyRow {
    layer: String,
    key: Key,
    joints: String,
}

fn key_rows(breakdown: &Breakdown<'_>) -> Vec<KeyRow> {
    let joints = &breakdown.clip.skeleton().joints;
    let row = |of: &LayerBreakdown<'_>, key: &Key| KeyRow {
        layer: of.layer.name.clone(),
        key: key.clone(),
        joints: key.voters.iter().map(|voter| &*joints[voter.0].name).collect::<Vec<_>>().join(" "),
    };
    let of_layer =
        |of: LayerBreakdown<'_>| of.keys.keys.iter().map(|key| row(&of, key)).collect::<Vec<_>>();
    breakdown.layers().flat_map(of_layer).collect()
}

fn drawings<'py>(py: Python<'py>, layers: &[Layer]) -> PyResult<Bound<'py, PyDict>> {
    let rows: Vec<(&Layer, usize, &Drawing)> = layers
        .iter()
        .flat_map(|layer| {
            layer.drawings.iter().enumerate().map(move |(at, drawing)| (layer, at, drawing))
        })
        .collect();
    let of_each = || rows.iter().map(|(_, _, drawing)| *drawing);
    let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
    table(
        py,
        [
            ("layer", Column::words(rows.iter().map(|(layer, _, _)| &*layer.name))),
            ("drawing", Column::counts(rows.iter().map(|(_, at, _)| *at))),
            ("place", Column::numbers(of_each().map(|drawing| drawing.source.place()))),
            ("role", Column::words(of_each().map(|drawing| drawing.role.word()))),
            (
                "reason",
                Column::words(
                    of_each().map(|drawing| drawing.why.reason.map_or("", |reason| reason.word())),
                ),
            ),
            ("strength", Column::numbers(of_each().map(|drawing| number(drawing.why.strength)))),
            ("price", Column::numbers(of_each().map(|drawing| number(drawing.why.price)))),
            ("why", Column::words(of_each().map(|drawing| drawing.why.to_string()))),
        ],
    )
}

fn exposures<'py>(py: Python<'py>, layers: &[Layer]) -> PyResult<Bound<'py, PyDict>> {
    let timed = |layer: &'_ Layer| -> Vec<(String, usize, usize, usize)> {
        let row = |(begin, exposure): (usize, genga::sheet::Exposure)| {
            (layer.name.clone(), begin, exposure.koma, exposure.drawing)
        };
        layer.timed().map(row).collect()
    };
    let rows: Vec<_> = layers.iter().flat_map(timed).collect();
    table(
        py,
        [
            ("layer", Column::words(rows.iter().map(|row| &*row.0))),
            ("begin", Column::counts(rows.iter().map(|row| row.1))),
            ("koma", Column::counts(rows.iter().map(|row| row.2))),
            ("drawing", Column::counts(rows.iter().map(|row| row.3))),
        ],
    )
}
