//! The second paper's omission alone.

use std::sync::Arc;
use std::time::Instant;

use genga::Error;
use genga::motion::Screen;
use genga::pipeline::Budget;
use genga::sheet::Sheet as Timed;
use genga::time::KOMA_RATE;
use genga::timing::{Omission, Omitted as Left, Order, Stills};
use genga_files::limited;
use pyo3::prelude::*;
use pyo3::types::{PyString, PyType};

use crate::clip::{Clip, taken};
use crate::error::{raised, warned};
use crate::pickle::Reduced;
use crate::result::Sheet;
use crate::words::{unexpected, whole, word};
use crate::work;

/// What `naka_nashi` and `koma_dori` accept, for messages.
const AMOUNT: &str = "a whole number, as in 4, or a share as text, as in \"35%\" or \"1/3\"";

/// The result of `omit`: a row of the second paper's Table 1, and what it counts.
#[pyclass(frozen, get_all, module = "genga")]
pub struct Omitted {
    /// Length of the clip in frames at 24 per second.
    frames: usize,
    /// Number of koma that naka-nashi cut, N_io: as many as it was asked for, if they could be. Each lengthens another
    /// drawing by a koma, and with many the koma so given are cut again, so that n_io can be more than the drawings that
    /// are gone, and than frames.
    n_io: usize,
    /// Number of frames that koma-dori replaced by the one before, N_hf.
    n_hf: usize,
    /// Seconds that both stages took, positions of the joints included.
    seconds: f64,
    /// The timesheet.
    sheet: Py<Sheet>,
    /// The stepped motion at 24 frames per second.
    limited: Py<Clip>,
}

/// Applies only naka-nashi and koma-dori, as `genga omit` does: to the clip, or motion file, at 24 drawings per second.
/// `naka_nashi` is a count (4) or a share of the koma ("4%"), `koma_dori` a count (33) or a share of the inbetweens
/// ("1/3"), `max_hold` the longest hold in koma. By None, the default, `naka_nashi` is 4 and `koma_dori` "1/3"; 0 leaves
/// out or holds none. A share for `naka_nashi` leaves out 6 at most, with a warning if it is more; a count is not
/// limited. Shares are text, and floats are refused. `keep_length=False` lets naka-nashi shorten the motion.
#[pyfunction]
#[pyo3(signature = (clip, *, naka_nashi=None, koma_dori=None, max_hold=4, all_at_once=false, koma_dori_first=false, keep_length=true))]
#[expect(clippy::too_many_arguments, reason = "each has a name in Python")]
pub fn omit(
    py: Python<'_>,
    clip: &Bound<'_, PyAny>,
    naka_nashi: Option<&Bound<'_, PyAny>>,
    koma_dori: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = max_hold_of)] max_hold: usize,
    all_at_once: bool,
    koma_dori_first: bool,
    keep_length: bool,
) -> PyResult<Omitted> {
    let amount = |name, given: Option<&Bound<'_, PyAny>>, usual: &str| {
        // 1 is a drawing and 1.0 would be all of them.
        if let Some(given) = given
            && !given.is_instance_of::<PyString>()
            && !given.hasattr("__index__")?
        {
            return Err(unexpected(name, AMOUNT, given));
        }
        let text = given.map_or_else(|| Ok(usual.to_owned()), word)?;
        text.parse().map_err(|error: String| raised(py, Error::setting(name, error)))
    };
    let omission = Omission {
        naka_nashi: amount("naka_nashi", naka_nashi, "4")?,
        koma_dori: amount("koma_dori", koma_dori, "1/3")?,
        max_hold,
        keep_length,
        all_at_once,
        order: if koma_dori_first { Order::KomaDoriFirst } else { Order::NakaNashiFirst },
        ..Omission::default()
    };
    let clip = taken(clip)?;
    let koma = clip.get().motion.rate().koma_from_frames(clip.get().motion.len(), KOMA_RATE);
    let motion = Arc::clone(&clip.get().motion);
    let made = work::done(py, move |_| {
        Budget::default().check(&motion, KOMA_RATE)?;
        let ones = Timed::on_ones(motion.clock(KOMA_RATE), koma);
        let began = Instant::now();
        let stills = Stills::on(&motion, &ones.layers[0], &Screen::WORLD);
        let Left { layer, report } = omission.apply(&ones.layers[0], &stills, 1)?;
        let seconds = began.elapsed().as_secs_f64();
        let sheet = Timed::new(ones.clock, vec![layer]);
        Ok((limited(&motion, &sheet)?, sheet, report, seconds))
    })?;
    let (stepped, sheet, report, seconds) = made.map_err(|error| raised(py, error))?;
    report.shortfalls().chain(omission.capped(koma)).try_for_each(|reason| warned(py, reason))?;
    let file = format!("{}_limited.bvh", clip.get().cut());
    Ok(Omitted {
        frames: koma,
        n_io: report.naka_nashi.done,
        n_hf: report.koma_dori.done,
        seconds,
        sheet: Py::new(py, Sheet::new(py, &sheet)?)?,
        limited: Py::new(py, Clip::new(Arc::new(stepped), file, Vec::new()))?,
    })
}

fn max_hold_of(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    whole("max_hold", given)
}

#[pymethods]
impl Omitted {
    /// For pickle.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let made = py.get_type::<Self>().getattr("_from_parts")?;
        let Self { frames, n_io, n_hf, seconds, sheet, limited } = self;
        let parts = (*frames, *n_io, *n_hf, *seconds, sheet.bind(py), limited.bind(py));
        Ok((made, parts.into_pyobject(py)?.into_any()))
    }

    #[classmethod]
    fn _from_parts(
        _class: &Bound<'_, PyType>,
        frames: usize,
        n_io: usize,
        n_hf: usize,
        seconds: f64,
        sheet: Py<Sheet>,
        limited: Py<Clip>,
    ) -> Self {
        Self { frames, n_io, n_hf, seconds, sheet, limited }
    }

    fn __repr__(&self) -> String {
        let Self { frames, n_io, n_hf, .. } = self;
        format!(
            "<genga.Omitted: {frames} frames, koma cut {n_io} times (n_io), {n_hf} frames held (n_hf)>"
        )
    }
}
