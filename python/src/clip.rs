//! Motion: read from a file, or built from arrays.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use genga::Warning;
use genga::motion::clean::Cleaning;
use genga::motion::{Axis, Clip as Motion, bvh};
use genga::time::FrameRate;
use genga_read as file;
use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArrayDyn,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyDict, PyType};

use crate::arrays::{self, Arrays, Places};
use crate::error::{asked_wrongly, in_python, raised, raised_of, warned};
use crate::pickle::{Head, Reduced};
use crate::words::{unexpected, whole};
use crate::work;

/// A motion clip of F frames and J joints.
///
/// From arrays: `names` of the joints; `parents`, -1 for a root, parents first; `offsets` (J, 3) from the parent at
/// rest; `rotations` (F, J, 4) relative to the parent, as unit quaternions x, y, z, w; `root` (F, 3), the positions of
/// the roots; `rate` in frames per second. `translations` (F, J, 3) replaces `root`: it holds the position of every
/// joint relative to its parent, for rigs whose hips move relative to a root on the floor. `tips` (J, 3) holds the end
/// of each joint's bone, NaN if unknown; soles and hands are found from it. (J, T, 3) holds up to T ends of each.
/// `first` is the number of the first frame. `up` ("x", "y", "z") and `metres` per unit of length are found in the
/// motion if they are not given. Float64 arrays in C order are read in place; NumPy copies all others first. The
/// attributes of a clip, given again, make a clip with the same keys. Channels and angles are made anew, so that the
/// motion differs by rounding and `evaluate` warns of sheets of the other clip; a pickled copy is exact.
#[pyclass(frozen, module = "genga")]
pub struct Clip {
    pub motion: Arc<Motion>,
    /// The name of the file, without folders.
    pub file: String,
    warnings: Vec<Told>,
    rotations: PyOnceLock<Py<PyArray3<f64>>>,
    translations: PyOnceLock<Py<PyArray3<f64>>>,
    positions: PyOnceLock<Py<PyArray3<f64>>>,
}

/// A warning about a clip: code, message, line and column.
type Told = (String, String, Option<(usize, usize)>);

impl Clip {
    /// Wraps the motion of a file.
    pub fn new(motion: Arc<Motion>, file: String, warnings: Vec<Warning>) -> Self {
        let told =
            |Warning { code, message, place }| (String::from(code), in_python(&message), place);
        Self::with_told(motion, file, warnings.into_iter().map(told).collect())
    }

    fn with_told(motion: Arc<Motion>, file: String, warnings: Vec<Told>) -> Self {
        Self {
            motion,
            file,
            warnings,
            rotations: PyOnceLock::new(),
            translations: PyOnceLock::new(),
            positions: PyOnceLock::new(),
        }
    }

    /// The name of the clip's cut: its file name without the extension.
    pub fn cut(&self) -> String {
        let stem = Path::new(&self.file).file_stem();
        stem.map_or("cut".into(), |stem| stem.to_string_lossy().into_owned())
    }

    /// The warnings as the program writes them, with arguments of `read` for its options.
    pub fn notes(&self) -> Vec<String> {
        let of_one = |(code, message, place): &Told| {
            let place = place.map(|(line, column)| format!("{line}:{column}: "));
            format!("{}{message} [{code}]", place.unwrap_or_default())
        };
        self.warnings.iter().map(of_one).collect()
    }

    /// Issues the warnings as Python's; `path` is that of the file.
    fn warn(&self, py: Python<'_>, path: Option<&Path>) -> PyResult<()> {
        let told = |((_, _, place), note): (&Told, String)| match path {
            Some(path) => {
                let between = if place.is_some() { ":" } else { ": " };
                format!("{}{between}{note}", path.display())
            }
            None => note,
        };
        self.warnings.iter().zip(self.notes()).try_for_each(|note| warned(py, told(note)))
    }

    /// The names of the joints.
    pub fn joints(&self) -> Vec<String> {
        self.motion.skeleton().joints.iter().map(|joint| joint.name.clone()).collect()
    }

    fn cube<'py>(
        &self,
        py: Python<'py>,
        flat: Vec<f64>,
        width: usize,
    ) -> PyResult<Py<PyArray3<f64>>> {
        let shape = [self.motion.len(), self.motion.skeleton().len(), width];
        // NumPy takes ownership of the vector.
        let cube: Bound<'py, PyArray3<f64>> = PyArray1::from_vec(py, flat).reshape(shape)?;
        read_only(py, cube.as_any())?;
        Ok(cube.unbind())
    }
}

/// Builds the cleaning that Python's arguments describe.
pub fn cleaning(
    keep_lead_in: bool,
    keep_glitches: bool,
    trim: Option<&Bound<'_, PyAny>>,
) -> PyResult<Cleaning> {
    let range = |trim: &Bound<'_, PyAny>| match trim.extract::<[usize; 2]>() {
        Ok([begin, end]) => Ok(begin..end),
        Err(_) => {
            let message = format!(
                "expected two frames, the second left out, as in (10, 50), found {}",
                trim.repr()?
            );
            Err(raised(trim.py(), genga::Error::setting("trim", message)))
        }
    };
    Ok(Cleaning { keep_lead_in, keep_glitches, trim: trim.map(range).transpose()? })
}

/// Returns the array as C-ordered float64: itself if it already is, else a copy.
pub fn floats<'py>(array: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    let numpy = array.py().import("numpy")?;
    numpy.call_method1("ascontiguousarray", (array, "float64"))?.extract()
}

/// Makes an array that is kept for later calls read-only.
fn read_only(py: Python<'_>, array: &Bound<'_, PyAny>) -> PyResult<()> {
    let flags = PyDict::new(py);
    flags.set_item("write", false)?;
    array.call_method("setflags", (), Some(&flags)).map(|_| ())
}

#[pymethods]
impl Clip {
    #[new]
    #[pyo3(signature = (*, names, parents, offsets, rotations, rate, root=None, translations=None, tips=None, first=0, up=None, metres=None, name="clip"))]
    #[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
    fn from_arrays(
        py: Python<'_>,
        names: Vec<String>,
        #[pyo3(from_py_with = parents_of)] parents: Vec<i64>,
        offsets: &Bound<'_, PyAny>,
        rotations: &Bound<'_, PyAny>,
        rate: f64,
        root: Option<&Bound<'_, PyAny>>,
        translations: Option<&Bound<'_, PyAny>>,
        tips: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = first_of)] first: usize,
        up: Option<&str>,
        metres: Option<f64>,
        name: &str,
    ) -> PyResult<Self> {
        named(py, name)?;
        let places = match (root, translations) {
            (Some(places), None) | (None, Some(places)) => places,
            (Some(_), Some(_)) => {
                let message = "root and translations both set the positions: give one of them";
                return Err(asked_wrongly(py, message));
            }
            (None, None) => {
                let message = "neither root nor translations set the positions: give one of them";
                return Err(asked_wrongly(py, message));
            }
        };
        let [offsets, rotations, places] = [floats(offsets)?, floats(rotations)?, floats(places)?];
        let tips = tips.map(floats).transpose()?;
        let (joints, frames) = (names.len(), rotations.shape().first().copied().unwrap_or(0));
        let shapes = [
            ("parents", vec![parents.len()], vec![joints]),
            ("offsets", offsets.shape().to_vec(), vec![joints, 3]),
            ("rotations", rotations.shape().to_vec(), vec![frames, joints, 4]),
            match root {
                Some(_) => ("root", places.shape().to_vec(), vec![frames, 3]),
                None => ("translations", places.shape().to_vec(), vec![frames, joints, 3]),
            },
            match tips.as_ref().map(|tips| tips.shape().to_vec()) {
                Some(is) if is.len() == 3 => ("tips", is.clone(), vec![joints, is[1], 3]),
                Some(is) => ("tips", is, vec![joints, 3]),
                None => ("tips", vec![], vec![]),
            },
        ];
        if let Some((what, is, asked)) = shapes.into_iter().find(|(_, is, asked)| is != asked) {
            let message = format!(
                "{what} has the shape {is:?}; {joints} names and {frames} frames of rotations need {asked:?}"
            );
            return Err(asked_wrongly(py, message));
        }
        if let Some(parent) = parents.iter().find(|parent| **parent < -1) {
            let message = format!("{parent} is no parent: list parents first, and give a root -1");
            return Err(asked_wrongly(py, message));
        }
        let made = Arrays {
            names,
            parents: parents.iter().map(|parent| usize::try_from(*parent).ok()).collect(),
            offsets: offsets.as_slice()?,
            rotations: rotations.as_slice()?,
            places: match root {
                Some(_) => Places::Root(places.as_slice()?),
                None => Places::Each(places.as_slice()?),
            },
            tips: tips.as_ref().map(|tips| tips.as_slice()).transpose()?,
            frames,
            first,
            rate,
            up: up.map(|name| axis(py, name)).transpose()?,
            metres,
        };
        let motion = py.detach(|| made.clip()).map_err(|error| raised(py, error))?;
        Ok(Self::new(Arc::new(motion), format!("{name}.bvh"), Vec::new()))
    }

    /// Name of the clip: the one that was given, else that of its file without the extension.
    #[getter]
    fn name(&self) -> String {
        self.cut()
    }

    /// Names of the J joints, parents first.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.joints()
    }

    /// Index of each joint's parent, -1 for a root: int64 (J,).
    #[getter]
    fn parents<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let joints = self.motion.skeleton().joints.iter();
        PyArray1::from_iter(
            py,
            joints.map(|joint| joint.parent.map_or(-1, |parent| parent.0 as i64)),
        )
    }

    /// Rest position of each joint relative to its parent, in the unit of the file: float64 (J, 3).
    #[getter]
    fn offsets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let joints = &self.motion.skeleton().joints;
        let flat = joints.iter().flat_map(|joint| joint.offset.to_array()).collect();
        PyArray1::from_vec(py, flat).reshape([joints.len(), 3])
    }

    /// Rotation of each joint relative to its parent: float64 (F, J, 4), unit quaternions x, y, z, w. Computed on first
    /// access, then cached and read-only.
    #[getter]
    fn rotations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let make = || self.cube(py, py.detach(|| arrays::rotations(&self.motion)), 4);
        Ok(self.rotations.get_or_try_init(py, make)?.bind(py).clone())
    }

    /// Position of each joint relative to its parent, in the unit of the file: float64 (F, J, 3). Computed on first
    /// access, then cached and read-only.
    #[getter]
    fn translations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let make = || self.cube(py, py.detach(|| arrays::translations(&self.motion)), 3);
        Ok(self.translations.get_or_try_init(py, make)?.bind(py).clone())
    }

    /// End of each joint's bone, relative to the joint, NaN if it has none: float64 (J, 3); (J, T, 3) if a joint has T
    /// ends.
    #[getter]
    fn tips<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (flat, most) = arrays::tips(&self.motion);
        let (flat, joints) = (PyArray1::from_vec(py, flat), self.motion.skeleton().len());
        Ok(match most {
            1 => flat.reshape([joints, 3])?.into_any(),
            _ => flat.reshape([joints, most, 3])?.into_any(),
        })
    }

    /// The axis that points up ("x", "y" or "z"), if the file or a person says so; else None.
    #[getter]
    fn up(&self) -> Option<&'static str> {
        self.motion.declared().up.map(|(axis, _)| AXES[axis as usize])
    }

    /// Metres per unit of length, if the file or a person says so; else None.
    #[getter]
    fn metres(&self) -> Option<f64> {
        self.motion.declared().metres
    }

    /// World position of each joint, in the unit of the file: float64 (F, J, 3). Computed on first access, then cached
    /// and read-only.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let make = || self.cube(py, py.detach(|| arrays::positions(&self.motion)), 3);
        Ok(self.positions.get_or_try_init(py, make)?.bind(py).clone())
    }

    /// Frames per second.
    #[getter]
    fn rate(&self) -> f64 {
        self.motion.rate().fps()
    }

    /// Number of the clip's first frame in the file. It is above 0 if a T-pose before the motion was removed.
    #[getter]
    fn first(&self) -> usize {
        self.motion.first().0
    }

    /// Warnings about the clip: dicts with `code`, `message`, `line` and `column`.
    #[getter]
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let of_one = |(code, message, place): &Told| {
            let told = PyDict::new(py);
            told.set_item("code", code)?;
            told.set_item("message", message)?;
            told.set_item("line", place.map(|(line, _)| line))?;
            told.set_item("column", place.map(|(_, column)| column))?;
            Ok(told)
        };
        self.warnings.iter().map(of_one).collect()
    }

    /// The clip as BVH.
    fn to_bvh(&self) -> String {
        bvh::write(&self.motion)
    }

    /// For pickle: the values as an array, the rest as MessagePack.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let head = rmp_serde::to_vec(&Head::of(&self.motion));
        let head = PyBytes::new(py, &head.map_err(|error| unpickled(&error))?);
        let values = PyArray1::from_iter(py, self.motion.rows().flatten().copied());
        let made = py.get_type::<Self>().getattr("_from_parts")?;
        let parts = (head, values, &self.file, self.warnings.clone());
        Ok((made, parts.into_pyobject(py)?.into_any()))
    }

    #[classmethod]
    fn _from_parts(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        head: &[u8],
        values: PyReadonlyArray1<'_, f64>,
        file: String,
        warnings: Vec<Told>,
    ) -> PyResult<Self> {
        let head: Head = rmp_serde::from_slice(head).map_err(|error| unpickled(&error))?;
        let motion = head.motion(values.as_slice()?.to_vec());
        let motion = Arc::new(motion.map_err(|error| raised(py, error))?);
        Ok(Self::with_told(motion, file, warnings))
    }

    /// Number of frames, F.
    fn __len__(&self) -> usize {
        self.motion.len()
    }

    fn __repr__(&self) -> String {
        let (frames, joints) = (self.motion.len(), self.motion.skeleton().len());
        format!(
            "<genga.Clip {}: {frames} frames at {} a second, {joints} joints>",
            self.cut(),
            self.rate()
        )
    }
}

fn first_of(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    whole("first", given)
}

fn parents_of(given: &Bound<'_, PyAny>) -> PyResult<Vec<i64>> {
    let expected = "whole numbers, -1 for a root, as in [-1, 0, 1]; of an array of floats, parents.astype(int)";
    given.extract().map_err(|_| unexpected("parents", expected, given))
}

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

fn axis(py: Python<'_>, name: &str) -> PyResult<Axis> {
    let at = AXES.iter().position(|own| *own == name);
    let axis = at.map(|at| [Axis::X, Axis::Y, Axis::Z][at]);
    axis.ok_or_else(|| asked_wrongly(py, format!("up is x, y or z, not {name}")))
}

/// Refuses a name that is no file name on every system.
fn named(py: Python<'_>, name: &str) -> PyResult<()> {
    let is_file = Path::new(name).file_name().is_some_and(|file| file == name);
    match is_file && !name.contains('\\') {
        true => Ok(()),
        false => {
            let message =
                format!("expected a name without folders, as in \"kick\", found {name:?}");
            Err(raised(py, genga::Error::setting("name", message)))
        }
    }
}

fn unpickled(error: &dyn Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Returns a clip as it is, and reads one that is given as a path or as bytes.
pub fn taken<'py>(source: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Clip>> {
    if let Ok(clip) = source.cast::<Clip>() {
        return Ok(clip.clone());
    }
    let py = source.py();
    let read = source.extract().map_err(|_| {
        let kind = source.get_type();
        PyTypeError::new_err(format!("expected a genga.Clip, a path or bytes, not {kind}"))
    });
    Bound::new(
        py,
        self::read(
            py, read?, None, None, None, None, None, None, false, false, false, false, None,
        )?,
    )
}

/// The argument of `read`: a path or the file's bytes.
#[derive(FromPyObject)]
pub enum Given<'py> {
    Bytes(Bound<'py, PyBytes>),
    Path(PathBuf),
}

/// Whether what was given as a path is the text of a BVH.
fn is_bvh(path: &Path) -> bool {
    let text = path.to_str().unwrap_or_default().trim_start_matches('\u{feff}').trim_start();
    text.starts_with("HIERARCHY") && text.contains(['\n', '\r'])
}

/// Reads a motion file of any supported format, from a path or from its bytes, as the program does, and a BVH from its
/// text too. Removes a T-pose
/// before or after the motion unless `keep_lead_in`. Unless `keep_glitches`, replaces single frames that fly off, and
/// removes ends in which the tracker comes from the origin. `trim=(A, B)` keeps frames A to B, without B. `name` is the
/// clip's name. `fps` replaces the rate of the file. `root` is the root of the one tree of joints to read, `take` the
/// take of a file with several. `up` is the axis that points up ("x", "y", "z"). `skeleton` is the path of the model of
/// a VMD (PMX, PMD), or of the ASF of an AMC. `repair` replaces a value of a BVH that is no number by the one before
/// it. `strict` raises the first warning as an error; else they are Python warnings, and in `warnings` of the clip.
#[pyfunction]
#[pyo3(signature = (source, *, name=None, fps=None, root=None, take=None, up=None, skeleton=None, repair=false, strict=false, keep_lead_in=false, keep_glitches=false, trim=None))]
#[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
pub fn read(
    py: Python<'_>,
    source: Given<'_>,
    name: Option<String>,
    fps: Option<f64>,
    root: Option<String>,
    take: Option<String>,
    up: Option<&str>,
    skeleton: Option<PathBuf>,
    repair: bool,
    strict: bool,
    keep_lead_in: bool,
    keep_glitches: bool,
    trim: Option<&Bound<'_, PyAny>>,
) -> PyResult<Clip> {
    let cleaning = cleaning(keep_lead_in, keep_glitches, trim)?;
    name.as_deref().map_or(Ok(()), |name| named(py, name))?;
    let rate = |rate: Option<f64>| rate.map(FrameRate::new).transpose();
    let fps = rate(fps).map_err(|error| raised(py, error))?;
    let up = up.map(|name| axis(py, name)).transpose()?;
    let options =
        file::Options { strict, repair, fps, root, take, up, skeleton, ..file::Options::default() };
    let (path, bytes) = match source {
        Given::Path(path) if is_bvh(&path) => (None, path.into_os_string().into_encoded_bytes()),
        Given::Path(path) => (Some(path), Vec::new()),
        // The bytes are copied, because the work goes on without the lock that keeps them alive.
        Given::Bytes(bytes) => (None, bytes.as_bytes().to_vec()),
    };
    let file =
        path.as_deref().and_then(Path::file_name).map(|file| file.to_string_lossy().into_owned());
    let file = name.map(|name| format!("{name}.bvh")).or(file).unwrap_or("clip.bvh".into());
    let at = path.clone();
    let made = work::done(py, move |_| {
        let read = path.map_or_else(|| options.read(&bytes), |path| options.open(&path))?;
        let file::Read { clip, mut warnings, .. } = read;
        let (clip, notes) = cleaning.apply(clip)?;
        warnings.extend(notes);
        clip.check_size()?;
        Ok((clip, warnings))
    })?;
    let (motion, warnings) = made.map_err(|error| raised_of(py, error, at.as_deref()))?;
    let clip = Clip::new(Arc::new(motion), file, warnings);
    clip.warn(py, at.as_deref())?;
    Ok(clip)
}
