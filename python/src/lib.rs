//! The Python package of genga: its library, with NumPy arrays at both ends.
//!
//! The binding is thin: each file adapts one part of the library to Python's conventions, and makes no decisions of its
//! own.

mod arrays;
mod clean;
mod clip;
mod corrections;
mod curves;
mod cycles;
mod error;
mod files;
mod judge;
mod knobs;
mod omit;
mod pickle;
mod recipe;
mod reference;
mod result;
mod table;
mod targets;
mod words;
mod work;

use pyo3::prelude::*;

/// The native module that `genga/__init__.py` re-exports.
#[pymodule]
fn _genga(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("Error", module.py().get_type::<error::Error>())?;
    module.add_class::<clip::Clip>()?;
    module.add_class::<recipe::Recipe>()?;
    module.add_class::<result::Result>()?;
    module.add_class::<result::Sheet>()?;
    module.add_class::<omit::Omitted>()?;
    module.add_function(wrap_pyfunction!(clip::read, module)?)?;
    module.add_function(wrap_pyfunction!(result::run, module)?)?;
    module.add_function(wrap_pyfunction!(knobs::knobs, module)?)?;
    module.add_function(wrap_pyfunction!(curves::tangents, module)?)?;
    module.add_function(wrap_pyfunction!(files::formats, module)?)?;
    module.add_function(wrap_pyfunction!(omit::omit, module)?)?;
    module.add_function(wrap_pyfunction!(judge::study, module)?)?;
    module.add_function(wrap_pyfunction!(judge::evaluate, module)?)?;
    module.add_function(wrap_pyfunction!(judge::compare, module)?)
}
