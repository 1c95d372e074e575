//! Motion: read from a file, or built from arrays.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use genga::Warning;
use genga::motion::clean::Cleaning;
use genga::motion::{Clip as Motion, bvh};
use genga::time::FrameRate;
use genga_read as file;
use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyDict};

use crate::arrays::{self, Arrays, Places};
use crate::error::{asked_wrongly, raised, raised_of};
use crate::work;

/// A motion clip of F frames and J joints.
///
/// From arrays: `names` of the joints; `parents`, -1 for a root, parents first; `offsets` (J, 3) from the parent at
/// rest; `rotations` (F, J, 4) relative to the parent, as unit quaternions x, y, z, w; `root` (F, 3), the positions of
/// the roots; `rate` in frames per second. `translations` (F, J, 3) replaces `root`: it holds the position of every
/// joint relative to its parent, for rigs whose hips move relative to a root on the floor. `tips` (J, 3) holds the end
/// of each joint's bone, NaN if unknown; soles and hands are found from it. Float64 arrays in C order are read in
/// place; NumPy copies all others first.
#[pyclass(frozen, module = "genga")]
pub struct Clip {
    pub motion: Arc<Motion>,
    /// The name of the file, without folders.
    pub file: String,
    warnings: Vec<Warning>,
    rotations: PyOnceLock<Py<PyArray3<f64>>>,
    positions: PyOnceLock<Py<PyArray3<f64>>>,
}

impl Clip {
    /// Wraps the motion of a file.
    pub fn new(motion: Arc<Motion>, file: String, warnings: Vec<Warning>) -> Self {
        Self { motion, file, warnings, rotations: PyOnceLock::new(), positions: PyOnceLock::new() }
    }

    /// The name of the clip's cut: its file name without the extension.
    pub fn cut(&self) -> String {
        let stem = Path::new(&self.file).file_stem();
        stem.map_or("cut".into(), |stem| stem.to_string_lossy().into_owned())
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

/// Returns the array as C-ordered float64: itself if it already is, else a copy.
fn floats<'py>(array: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    let numpy = array.py().import("numpy")?;
    Ok(numpy.call_method1("ascontiguousarray", (array, "float64"))?.extract()?)
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
    #[pyo3(signature = (*, names, parents, offsets, rotations, rate, root=None, translations=None, tips=None, name="clip"))]
    #[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
    fn from_arrays(
        py: Python<'_>,
        names: Vec<String>,
        parents: Vec<i64>,
        offsets: &Bound<'_, PyAny>,
        rotations: &Bound<'_, PyAny>,
        rate: f64,
        root: Option<&Bound<'_, PyAny>>,
        translations: Option<&Bound<'_, PyAny>>,
        tips: Option<&Bound<'_, PyAny>>,
        name: &str,
    ) -> PyResult<Self> {
        let (Some(places), true) =
            (root.or(translations), root.is_none() || translations.is_none())
        else {
            let message = "root and translations both set the positions: give one of them";
            return Err(asked_wrongly(py, message));
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
            match &tips {
                Some(tips) => ("tips", tips.shape().to_vec(), vec![joints, 3]),
                None => ("tips", vec![], vec![]),
            },
        ];
        if let Some((what, is, asked)) = shapes.into_iter().find(|(_, is, asked)| is != asked) {
            let message = format!(
                "{what} has the shape {is:?}; {joints} names and {frames} frames of rotations need {asked:?}"
            );
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
            rate,
        };
        let motion = py.detach(|| made.clip()).map_err(|error| raised(py, error))?;
        Ok(Self::new(Arc::new(motion), format!("{name}.bvh"), Vec::new()))
    }

    /// Names of the J joints, parents first.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.motion.skeleton().joints.iter().map(|joint| joint.name.clone()).collect()
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
        let of_one = |warning: &Warning| {
            let told = PyDict::new(py);
            told.set_item("code", warning.code)?;
            told.set_item("message", &warning.message)?;
            told.set_item("line", warning.place.map(|(line, _)| line))?;
            told.set_item("column", warning.place.map(|(_, column)| column))?;
            Ok(told)
        };
        self.warnings.iter().map(of_one).collect()
    }

    /// The clip as BVH.
    fn to_bvh(&self) -> String {
        bvh::write(&self.motion)
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

/// The argument of `read`: a path or the file's bytes.
#[derive(FromPyObject)]
pub enum Given<'py> {
    Bytes(Bound<'py, PyBytes>),
    Path(PathBuf),
}

/// Reads a motion file of any supported format, from a path or from its bytes, as the program does. Removes a T-pose
/// before or after the motion unless `keep_lead_in`. Unless `keep_glitches`, replaces single frames that fly off, and
/// removes ends in which the tracker comes from the origin. `trim=(A, B)` keeps frames A to B, without B. `fps`,
/// `root`, `take`, `repair` and `strict` are the program's options.
#[pyfunction]
#[pyo3(signature = (source, *, name=None, fps=None, root=None, take=None, repair=false, strict=false, keep_lead_in=false, keep_glitches=false, trim=None))]
#[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
pub fn read(
    py: Python<'_>,
    source: Given<'_>,
    name: Option<String>,
    fps: Option<f64>,
    root: Option<String>,
    take: Option<String>,
    repair: bool,
    strict: bool,
    keep_lead_in: bool,
    keep_glitches: bool,
    trim: Option<(usize, usize)>,
) -> PyResult<Clip> {
    let rate = |rate: Option<f64>| rate.map(FrameRate::new).transpose();
    let fps = rate(fps).map_err(|error| raised(py, error))?;
    let options = file::Options { strict, repair, fps, root, take, ..file::Options::default() };
    let (path, bytes) = match source {
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
        part(read, (keep_lead_in, keep_glitches), trim)
    })?;
    let (motion, warnings) = made.map_err(|error| raised_of(py, error, at.as_deref()))?;
    Ok(Clip::new(Arc::new(motion), file, warnings))
}

/// Applies lead-in and glitch removal and the trim.
fn part(
    read: file::Read,
    (keep_lead_in, keep_glitches): (bool, bool),
    trim: Option<(usize, usize)>,
) -> Result<(Motion, Vec<Warning>), genga::Error> {
    let file::Read { clip, mut warnings, .. } = read;
    let trim = trim.map(|(begin, end)| begin..end);
    let (clip, notes) = Cleaning { keep_lead_in, keep_glitches, trim }.apply(clip)?;
    warnings.extend(notes);
    clip.check_size()?;
    Ok((clip, warnings))
}
