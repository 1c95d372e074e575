//! A run: the sheet and all intermediate results.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use genga::Error;
use genga::keys::{BodyTurns, Key};
use genga::motion::{Description, Joint};
use genga::pipeline::{Breakdown, Engine, LayerBreakdown, Stop};
use genga::sheet::{Drawing, Layer, Role};
use genga::signal::{Signals, Turn, TurnKind};
use genga::target::{Outcome, Target, meet};
use genga_files::{Format, Report, Settings, limited, run_notes};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyType};

use crate::clip::{Clip, taken};
use crate::corrections::{self, Corrections};
use crate::error::{in_python, raised, warned};
use crate::files::{Files, Handed};
use crate::pickle::Reduced;
use crate::recipe::Recipe;
use crate::table::{Column, plain, table};
use crate::targets::{Plain, outcome_of, plain_of, targets as targets_of, told};
use crate::words::settings;
use crate::work;

/// The result of a run. Each attribute is computed on access.
#[pyclass(frozen, module = "genga")]
pub struct Result {
    /// The source motion.
    #[pyo3(get)]
    clip: Py<Clip>,
    /// The cached stages: running again with the same settings computes nothing.
    engine: Arc<Mutex<Engine>>,
    settings: Recipe,
    outcomes: Vec<Outcome>,
    cut: String,
}

/// The timesheet (タイムシート): which drawing is shown on which koma.
#[pyclass(frozen, get_all, module = "genga")]
pub struct Sheet {
    /// Koma per second.
    rate: f64,
    /// Length of the sheet in koma, K.
    koma: usize,
    /// One row per drawing: `layer`, `drawing` (its number in the layer, from 0), `place` (source frame, fractional),
    /// `role` (genga, inbetween, end), `reason`, `strength`, `price` (% of body height, as in `Result.keys`; infinite
    /// for a drawing that always stays, NaN for an inbetween), `why`.
    drawings: Py<PyDict>,
    /// One row per exposure: `layer`, `begin` (koma from 0), `koma` (length), `drawing`.
    exposures: Py<PyDict>,
}

/// The input of a run.
struct Begun {
    clip: Py<Clip>,
    engine: Engine,
    settings: Recipe,
    targets: Vec<Target>,
    cut: String,
}

impl Begun {
    /// Finds the settings that meet the targets, and runs the clip with them.
    fn done(self, py: Python<'_>) -> PyResult<Result> {
        let Self { clip, mut engine, settings, targets, cut } = self;
        let made = work::done(py, move |stop| {
            engine.stop_with(stop.clone());
            let Recipe { mut recipe, edits } = settings;
            let mut outcomes = Vec::new();
            if !targets.is_empty() {
                let met = meet(&mut engine, &recipe, &edits, &targets)?;
                (recipe, outcomes) = (met.recipe, met.outcomes);
            }
            engine.run(&recipe, &edits)?;
            Ok((engine, Recipe { recipe, edits }, outcomes))
        })?;
        let (engine, settings, outcomes) = made.map_err(|error| raised(py, error))?;
        Ok(Result { clip, engine: Arc::new(Mutex::new(engine)), settings, outcomes, cut })
    }
}

/// Finds the key drawings of a clip, or of a motion file, and times them. Settings have the recipe's names: `keys={"min_price": 15}`,
/// `keys__min_price=15` and `**{"keys.min_price": 15}` are the same. `pins` are frames that are always keys (42,
/// (42, "contact"), (42, "contact", 0.5) with a spacing weight, "42:contact@0.5"); `forbid` are frames without a key nearby (42, "120..140"); `moves` are pairs
/// (from, to), `holds` pairs (frame, koma). `targets` are wanted properties of the sheet, `{"keys": 9}`,
/// `{"drawings_per_second": 6}` or `{"max_error": 8}` (% of body height), for which genga searches settings. `name` is
/// the name of the cut.
#[pyfunction]
#[pyo3(signature = (clip, recipe=None, *, pins=vec![], forbid=vec![], moves=vec![], holds=vec![], only_pins=false, targets=None, name=None, **settings))]
#[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
pub fn run<'py>(
    py: Python<'py>,
    clip: &Bound<'py, PyAny>,
    recipe: Option<Recipe>,
    #[pyo3(from_py_with = corrections::pins)] pins: Vec<Bound<'py, PyAny>>,
    #[pyo3(from_py_with = corrections::forbid)] forbid: Vec<Bound<'py, PyAny>>,
    #[pyo3(from_py_with = corrections::moves)] moves: Vec<Bound<'py, PyAny>>,
    #[pyo3(from_py_with = corrections::holds)] holds: Vec<Bound<'py, PyAny>>,
    only_pins: bool,
    targets: Option<&Bound<'py, PyAny>>,
    name: Option<String>,
    settings: Option<&Bound<'py, PyDict>>,
) -> PyResult<Result> {
    let mut asked = recipe.unwrap_or_default().with_of(py, settings, "run")?;
    Corrections { pins, forbid, moves, holds, only_pins }.add_to(&mut asked.edits)?;
    let targets = targets_of(py, targets)?;
    let clip = taken(clip)?;
    let own = clip.get();
    let begun = Begun {
        engine: Engine::new(own.motion.clone()).map_err(|error| raised(py, error))?,
        settings: asked,
        targets,
        cut: name.unwrap_or_else(|| own.cut()),
        clip: clip.unbind(),
    };
    begun.done(py)
}

impl Result {
    /// Passes the breakdown to `at`, with Python's lock released.
    fn look<T: Send + 'static>(
        &self,
        py: Python<'_>,
        at: impl FnOnce(&Breakdown<'_>) -> std::result::Result<T, genga::Error> + Send + 'static,
    ) -> PyResult<T> {
        self.look_until(py, |breakdown, _| at(breakdown))
    }

    /// Like [`Self::look`], for long work, which ends once the [`Stop`] is asked.
    fn look_until<T: Send + 'static>(
        &self,
        py: Python<'_>,
        at: impl FnOnce(&Breakdown<'_>, &Stop) -> std::result::Result<T, genga::Error> + Send + 'static,
    ) -> PyResult<T> {
        let Recipe { recipe, edits } = self.settings.clone();
        let looked = work::done_with(py, &self.engine, move |engine: &mut Engine, stop| {
            engine.stop_with(stop.clone());
            engine.run(&recipe, &edits).and_then(|breakdown| at(&breakdown, stop))
        })?;
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
        let Recipe { recipe, edits } = self.settings.clone();
        let (cut, file) = (self.cut.clone(), self.clip.get().file.clone());
        let (files, notes) = self.look_until(py, move |breakdown, stop| {
            let handed = Handed { cut: &cut, file: &file, recipe: &recipe, edits: &edits };
            handed.files(breakdown, (&formats, &own), || stop.check())
        })?;
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

    /// Builds an array with a row per layer.
    fn of_layers<'py>(
        &self,
        py: Python<'py>,
        of: fn(&BodyTurns) -> &[f64],
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = self.look(py, move |breakdown| {
            Ok(breakdown.layers().map(|layer| of(layer.body).to_vec()).collect::<Vec<_>>())
        })?;
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    fn matrix<'py>(
        &self,
        py: Python<'py>,
        of: fn(&Breakdown<'_>) -> Signals,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let signals = self.look(py, move |breakdown| Ok(of(breakdown)))?;
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
            #[doc = " Returns a dict from file names to bytes. Settings of formats are as in `csv={\"bom\": True}`; a wrong name lists all."]
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
    to_keys_glb "keys-glb" "Few keys, at the genga, with smooth curves between them, as GLB.",
    to_keys_vmd "keys-vmd" "Few keys for MikuMikuDance, at the genga, with its curves between them.",
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
        Sheet::new(py, &self.look(py, |breakdown| Ok(breakdown.sheet.clone()))?)
    }

    /// The keys, one row each, as `report` counts them: the first and the last drawing too, whose reason is `end`.
    /// `layer`, `frame`, `strength` (0 to 1), `price` (the error without the key, in % of body height; infinite for a
    /// key that always stays), `reason`, `name`, `joints`. `to_csv()["keys.csv"]` has the koma of each, as the program
    /// writes them.
    #[getter]
    fn keys<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = self.look(py, |breakdown| Ok(key_rows(breakdown)))?;
        let each = || rows.iter();
        table(
            py,
            [
                ("layer", Column::words(each().map(|row| &*row.layer))),
                ("frame", Column::counts(each().map(|row| row.frame))),
                ("strength", Column::numbers(each().map(|row| row.strength))),
                ("price", Column::numbers(each().map(|row| row.price))),
                ("reason", Column::words(each().map(|row| row.reason))),
                ("name", Column::words(each().map(|row| &*row.name))),
                ("joints", Column::words(each().map(|row| &*row.joints))),
            ],
        )
    }

    /// Turns of single joints, one row each, as `genga keys --per-joint` writes them: `joint` (index in `Clip.names`),
    /// `frame`, `kind` (key, wall), `speed_deg_s` (the filtered speed there, °/s, or in the unit of the measure),
    /// `confirmed_for` (frames).
    #[getter]
    fn turns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (turns, speeds) = self.look(py, |breakdown| {
            let Breakdown { filtered, turns, clip, .. } = breakdown;
            let of_joint = |((joint, _), turns): (_, &Vec<Turn>)| {
                let own = filtered.joint(joint);
                let at = |turn: &Turn| own[turn.frame.0 - filtered.first.0];
                turns.iter().map(|turn| at(turn) * filtered.unit.for_people()).collect::<Vec<_>>()
            };
            let speeds = clip.skeleton().iter().zip(*turns).flat_map(of_joint);
            Ok((turns.to_vec(), speeds.collect::<Vec<f64>>()))
        })?;
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
                ("speed_deg_s", Column::numbers(speeds)),
                ("confirmed_for", Column::counts(each().map(|turn| turn.confirmed_for))),
            ],
        )
    }

    /// Turns of the body as a whole, of which a study's measure `turns` is the number, and its walls, one row each:
    /// `layer`, `frame`, `kind` (turn, wall), `strength` (of a turn 0 to 1, as in `evidence`; of a wall in % of body
    /// height a second).
    #[getter]
    fn body_turns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = self.look(py, |breakdown| Ok(body_rows(breakdown)))?;
        let each = || rows.iter();
        table(
            py,
            [
                ("layer", Column::words(each().map(|(layer, ..)| &**layer))),
                ("frame", Column::counts(each().map(|(_, frame, ..)| *frame))),
                ("kind", Column::words(each().map(|(_, _, kind, _)| *kind))),
                ("strength", Column::numbers(each().map(|(.., strength)| *strength))),
            ],
        )
    }

    /// How much slower the body is at each frame than before and after it, J of the method, in % of body height a
    /// second: float64 (L, F), a row per layer, as there are on the sheet. Turns are its peaks. A loop has the frames of
    /// its round.
    #[getter]
    fn dips<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.of_layers(py, |body| &body.dips)
    }

    /// How much of a turn each frame is, 0 to 1, by which keys are strong: float64 (L, F), as `dips`.
    #[getter]
    fn evidence<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.of_layers(py, |body| &body.evidence)
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

    /// The figures of `report.json`, as nested dicts and lists. `notes` are sentences about the clip, the targets and
    /// the corrections, as the program writes them. What the program notes of files it reads or writes is not in it.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let mut notes = self.clip.get().notes();
        let motion = Arc::clone(&self.clip.get().motion);
        let is_loop = self.settings.recipe.r#loop;
        let short = self.outcomes.iter().filter(|outcome| outcome.shortfall.is_some());
        let short: Vec<String> = short.map(ToString::to_string).collect();
        let edits = self.settings.edits.clone();
        let report = self.look(py, move |breakdown| {
            let of_body = Description::notes(&motion);
            notes.extend(of_body.iter().map(|note| in_python(&note.to_string())));
            notes.extend(run_notes::of_cycle(&motion, is_loop));
            notes.extend(short);
            notes.extend(run_notes::of_held_inbetween(breakdown));
            notes.extend(run_notes::of_corrections(&edits, breakdown));
            Ok(Report::new(breakdown, notes))
        })?;
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
        targets: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let asked = recipe.unwrap_or_else(|| self.settings.clone()).with_of(
            py,
            settings,
            "Result.again",
        )?;
        let targets = targets_of(py, targets)?;
        let engine = work::done_with(py, &self.engine, |engine: &mut Engine, _| engine.clone())?;
        let (clip, cut) = (self.clip.clone_ref(py), self.cut.clone());
        Begun { clip, engine, settings: asked, targets, cut }.done(py)
    }

    /// Writes files of the given formats (`genga.formats()` lists them) into a folder, which it creates. Returns their
    /// paths. Settings of formats are as in `csv={"bom": True}`; a wrong name lists all.
    #[pyo3(signature = (folder, *formats, **settings))]
    fn write(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        formats: Vec<String>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Vec<PathBuf>> {
        if formats.is_empty() {
            let message = "no format is named; genga.formats() lists them, as in write(\"out\", \"json\", \"csv\")";
            return Err(raised(py, Error::setting("write", message)));
        }
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |source| raised(py, Error::Io { path, source })
        };
        let mut written = Vec::new();
        for (name, bytes) in self.files_of(py, &formats, settings)? {
            let path = folder.join(name);
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent).map_err(failed(parent))?;
            }
            fs::write(&path, bytes).map_err(failed(&path))?;
            written.push(path);
        }
        Ok(written)
    }

    /// For pickle: the clip and what was asked of it. What was found is computed again on first access.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let outcomes: Vec<Plain> = self.outcomes.iter().map(plain_of).collect();
        let made = py.get_type::<Self>().getattr("_from_parts")?;
        let clip = self.clip.bind(py);
        Ok((made, (clip, self.settings.clone(), outcomes, &self.cut).into_pyobject(py)?.into_any()))
    }

    #[classmethod]
    fn _from_parts(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        clip: Py<Clip>,
        settings: Recipe,
        outcomes: Vec<Plain>,
        cut: String,
    ) -> PyResult<Self> {
        let engine = Engine::new(clip.get().motion.clone()).map_err(|error| raised(py, error))?;
        let outcomes = outcomes.into_iter().map(|plain| outcome_of(py, plain));
        Ok(Self {
            clip,
            engine: Arc::new(Mutex::new(engine)),
            settings,
            outcomes: outcomes.collect::<PyResult<_>>()?,
            cut,
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (koma, drawings) = self.look(py, |breakdown| {
            let shown = breakdown.sheet.layers.iter().map(|layer| layer.shown().count());
            Ok((breakdown.sheet.length(), shown.sum::<usize>()))
        })?;
        Ok(format!("<genga.Result {}: {koma} koma, {drawings} drawings>", self.cut))
    }
}

#[pymethods]
impl Sheet {
    /// For pickle.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let made = py.get_type::<Self>().getattr("_from_parts")?;
        let parts = (self.rate, self.koma, self.drawings.bind(py), self.exposures.bind(py));
        Ok((made, parts.into_pyobject(py)?.into_any()))
    }

    #[classmethod]
    fn _from_parts(
        _class: &Bound<'_, PyType>,
        rate: f64,
        koma: usize,
        drawings: Py<PyDict>,
        exposures: Py<PyDict>,
    ) -> Self {
        Self { rate, koma, drawings, exposures }
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let column = |name| -> PyResult<_> { self.exposures.bind(py).as_any().get_item(name) };
        let layers: Vec<String> = column("layer")?.call_method0("tolist")?.extract()?;
        let numbers: Vec<usize> = column("drawing")?.call_method0("tolist")?.extract()?;
        let shown: HashSet<_> = layers.iter().zip(numbers).collect();
        Ok(format!("<genga.Sheet: {} koma, {} drawings>", self.koma, shown.len()))
    }
}

impl Sheet {
    /// Builds the tables of a sheet.
    pub fn new(py: Python<'_>, sheet: &genga::sheet::Sheet) -> PyResult<Self> {
        Ok(Self {
            rate: sheet.clock.koma_rate,
            koma: sheet.length(),
            drawings: drawings(py, &sheet.layers)?.unbind(),
            exposures: exposures(py, &sheet.layers)?.unbind(),
        })
    }
}

/// A row of the keys.
struct KeyRow {
    layer: String,
    frame: usize,
    strength: f64,
    price: f64,
    reason: &'static str,
    name: String,
    joints: String,
}

impl KeyRow {
    /// Builds the row of a drawing, of the key that it shows if it is no end.
    fn new(layer: &str, drawing: &Drawing, keys: &[Key], joints: &[Joint]) -> Self {
        let frame = drawing.source.place().round() as usize;
        let key =
            keys.iter().find(|key| key.frame.0 == frame).filter(|_| drawing.role != Role::End);
        let voters = key.iter().flat_map(|key| &key.voters);
        Self {
            layer: layer.into(),
            frame,
            strength: key.map_or(1.0, |key| key.strength),
            price: key.map_or(f64::INFINITY, |key| key.price),
            reason: key.map_or(drawing.role.word(), |key| key.origin.reason().word()),
            name: key.and_then(|key| key.name.clone()).unwrap_or_default(),
            joints: voters.map(|voter| &*joints[voter.0].name).collect::<Vec<_>>().join(" "),
        }
    }
}

/// A turn or wall of a layer: layer, frame, kind and strength.
type BodyRow = (String, usize, &'static str, f64);

fn body_rows(breakdown: &Breakdown<'_>) -> Vec<BodyRow> {
    let of_layer = |(of, layer): (LayerBreakdown<'_>, &Layer)| {
        let BodyTurns { first, evidence, turns, walls, .. } = of.body;
        let turns = turns.iter().map(|turn| (turn.0, "turn", evidence[turn.0 - first.0]));
        let walls = walls.iter().map(|wall| (wall.frame.0, "wall", wall.strength));
        let row = |(frame, kind, strength)| (layer.name.clone(), frame, kind, strength);
        let mut rows: Vec<BodyRow> = turns.chain(walls).map(row).collect();
        rows.sort_by_key(|(_, frame, ..)| *frame);
        rows
    };
    breakdown.layers().zip(&breakdown.sheet.layers).flat_map(of_layer).collect()
}

fn key_rows(breakdown: &Breakdown<'_>) -> Vec<KeyRow> {
    let joints = &breakdown.clip.skeleton().joints;
    let of_layer = |(of, layer): (LayerBreakdown<'_>, &Layer)| {
        let kept = layer.drawings.iter().filter(|drawing| drawing.role.is_kept());
        let keys = &of.keys.keys;
        kept.map(|drawing| KeyRow::new(&layer.name, drawing, keys, joints)).collect::<Vec<_>>()
    };
    breakdown.layers().zip(&breakdown.sheet.layers).flat_map(of_layer).collect()
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
            ("price", Column::numbers(of_each().map(price_of))),
            ("why", Column::words(of_each().map(|drawing| drawing.why.to_string()))),
        ],
    )
}

/// The price of a drawing as its key has it: infinite for one that always stays, NaN for an inbetween.
fn price_of(drawing: &Drawing) -> f64 {
    match drawing.role {
        Role::Inbetween => f64::NAN,
        Role::Genga => drawing.why.price.unwrap_or(f64::INFINITY),
        Role::End => f64::INFINITY,
    }
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
