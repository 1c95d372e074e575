//! Removes or mends capture artefacts.

use std::sync::Arc;

use pyo3::prelude::*;

use crate::clip::{Clip, cleaning};
use crate::error::raised;
use crate::work;

#[pymethods]
impl Clip {
    /// Returns the clip without inserted poses at its ends, and with single-frame glitches mended, as `genga.read` does
    /// with a file. Frames keep their numbers; `first` is that of the motion. The warnings say what was changed.
    #[pyo3(signature = (*, keep_lead_in=false, keep_glitches=false, trim=None))]
    fn cleaned(
        &self,
        py: Python<'_>,
        keep_lead_in: bool,
        keep_glitches: bool,
        trim: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let cleaning = cleaning(keep_lead_in, keep_glitches, trim)?;
        let motion = Arc::clone(&self.motion);
        let made = work::done(py, move |_| cleaning.apply((*motion).clone()))?;
        let (motion, notes) = made.map_err(|error| raised(py, error))?;
        Ok(Self::new(Arc::new(motion), self.file.clone(), notes))
    }
}
