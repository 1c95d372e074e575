//! Smooth curves through few keys, for the channels of a rig.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::clip::{Clip, floats};
use crate::error::{asked_wrongly, raised};
use crate::work;

#[pymethods]
impl Clip {
    /// Measures how far another motion of the same body is off this one: float64 (F,), on each frame the largest distance
    /// of a joint, a tip or the skin about a joint, as a share of body height.
    fn distances<'py>(
        &self,
        py: Python<'py>,
        other: &Bound<'py, Self>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (own, other) = (Arc::clone(&self.motion), Arc::clone(&other.get().motion));
        let found = work::done(py, move |_| genga_files::distances(&own, &other))?;
        Ok(PyArray1::from_vec(py, found.map_err(|error| raised(py, error))?))
    }
}

/// Finds the tangents of cubic curves through channels that bring the curves closest to samples of them: float64 (K, C),
/// the change per frame. `keys` are K frames from 0, two or more in order of time; `samples` are (F, C).
#[pyfunction]
pub fn tangents<'py>(
    py: Python<'py>,
    keys: Vec<usize>,
    samples: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let samples = floats(samples)?;
    let [frames, channels] = *samples.shape() else {
        return Err(asked_wrongly(py, "samples has the shape (frames, channels)"));
    };
    let are_in_order = keys.windows(2).all(|pair| pair[0] < pair[1]);
    if keys.len() < 2 || !are_in_order || keys[keys.len() - 1] >= frames {
        let message = format!("keys are two or more of the {frames} frames, in order of time");
        return Err(asked_wrongly(py, message));
    }
    let places: Vec<f64> = keys.iter().map(|key| *key as f64).collect();
    let found = genga_files::tangents(&places, samples.as_slice()?, channels);
    PyArray1::from_vec(py, found).reshape([keys.len(), channels])
}
