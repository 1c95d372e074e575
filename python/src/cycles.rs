//! Rounds of a motion that can be repeated.

use std::sync::Arc;

use genga::keys::Cycle;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::clip::Clip;
use crate::table::{Column, table};
use crate::work;

#[pymethods]
impl Clip {
    /// Finds the rounds of the motion that can be repeated, the closest first: `first` and `last` frame, and `pose`, how
    /// far apart the poses there are (% of body height).
    fn cycles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let motion = Arc::clone(&self.motion);
        let found = work::done(py, move |_| Cycle::find_all(&motion))?;
        let each = || found.iter();
        table(
            py,
            [
                ("first", Column::counts(each().map(|cycle| cycle.first.0))),
                ("last", Column::counts(each().map(|cycle| cycle.last.0))),
                ("pose", Column::numbers(each().map(|cycle| cycle.pose))),
            ],
        )
    }
}
