//! Smooths speeds, zero-phase, over all joints [KT11 §3.2]: `box` as a running sum, the others in the frequency domain.

mod fourier;
mod moving;
mod portable_float;
mod response;
mod spectrum;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::motion::lanes::wide;
use crate::signal::Signals;
use crate::time::{FrameRate, Span};

use moving::Window;
pub use spectrum::Spectrum;

/// The kinds of low-pass filter. The paper names none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FilterKind {
    /// Moving average over a window W frames wide. Its edges let as much noise into the acceleration at an odd width as
    /// at an even one.
    #[default]
    Box,
    /// Gaussian whose standard deviation is W/6, so that W spans ±3σ.
    Gaussian,
    /// Every component with a period shorter than W frames removed. Rings beside sharp changes.
    Ideal,
    /// Butterworth of second order run forward and back, with a cut-off period of W frames. Rings a
    /// little.
    Butterworth,
}

choices!(FilterKind {
    Box: "box",
    Gaussian: "gaussian",
    Ideal: "ideal",
    Butterworth: "butterworth"
});

/// Low-pass filter (ローパスフィルタ) of speeds [KT11 §3.2]: no shift in time, gain 1 for steady speeds, as many frames out as
/// in; beyond its ends the clip is mirrored (… c b a | a b c …).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LowPass {
    /// The kind; `box` by default.
    pub kind: FilterKind,
    /// Width of the filter: the paper's filter range W, in source frames or seconds, 0 or more; 0.15 s by default. A
    /// width of 0 does not filter (nor up to 1 frame for `gaussian`, up to 2 for `ideal` and `butterworth`, as no
    /// sampled motion has a shorter period). Raised, it removes short movements and the accents of fast ones.
    pub width: Span,
}

impl Default for LowPass {
    fn default() -> Self {
        Self { kind: FilterKind::Box, width: Span::Seconds(0.15) }
    }
}

knobs!(filter::LowPass {
    kind: knob(
        "ローパスフィルタ",
        "Kind of low-pass filter that smooths the speeds.",
        "速さをならすローパスフィルタの種類。",
    )
    .for_studies(),
    width: knob(
        "フィルタの適用範囲",
        "Width of the smoothing filter. Higher values find fewer turns as a rule, and blur \
         quick double actions.",
        "速さをならすフィルタの幅。広いほど原画は減り、素早い二段の動きはぼやける。",
    ),
});

impl LowPass {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] named `filter.width` unless the width is finite and not below 0.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Returns the filtered signals, or the unfiltered ones if the width does not filter.
    ///
    /// ```
    /// use genga::signal::{LowPass, Spectrum, Speed};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let spectrum = Spectrum::new(&Speed::default().measure(&clip)?);
    /// let smooth = LowPass::default().apply(&spectrum);
    /// assert_eq!(smooth.frames(), clip.len());
    /// assert!(smooth.values.max() < spectrum.unfiltered().values.max());
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn apply(&self, spectrum: &Spectrum) -> Signals {
        let frames = spectrum.frames();
        match self.filtering_width(spectrum.rate()) {
            Some(width) if frames > 1 => match self.window(width, frames) {
                Some(window) => window.means(spectrum.unfiltered()),
                None => spectrum.times(&self.kind.response(width, frames)),
            },
            _ => spectrum.unfiltered().clone(),
        }
    }

    /// Passes on the filtered columns, `COLUMNS` at a time, one behind the other. Their number must be a multiple of
    /// `COLUMNS`.
    pub(crate) fn each<const COLUMNS: usize>(
        &self,
        spectrum: &Spectrum,
        mut each: impl FnMut(&[f64]),
    ) {
        let frames = spectrum.frames();
        let width = self.filtering_width(spectrum.rate()).filter(|_| frames > 1);
        if let Some(window) = width.and_then(|width| self.window(width, frames)) {
            let mut means = vec![0.0; COLUMNS * frames];
            for columns in spectrum.unfiltered().values.as_slice().chunks_exact(means.len()) {
                wide(
                    #[inline(always)]
                    || window.slide::<COLUMNS>(columns, &mut means),
                );
                each(&means);
            }
        } else {
            let filtered = self.apply(spectrum);
            filtered.values.as_slice().chunks_exact((COLUMNS * frames).max(1)).for_each(each);
        }
    }

    /// Returns the window of a moving average, if it is narrower than the clip.
    fn window(&self, width: f64, frames: usize) -> Option<Window> {
        (self.kind == FilterKind::Box).then(|| Window::within(width, frames))?
    }

    /// Returns how much of a steady stretch the filter consumes at each end, in frames: W/2 for `box`, W/3 for the
    /// other kinds, 0 if the width does not filter.
    ///
    /// The box reaches W/2 to each side; a dead band gives some of that back. Measured at 120 frames a
    /// second on stops from 100, 200 and 400 °/s within 0.1, 0.2 and 0.4 s, straight and eased, with a
    /// band of 100 °/s² and W of 6 to 36 frames, as a share of W: median 0.33 to 0.39 for `box`, 0.17
    /// to 0.22 for `gaussian` and for `butterworth`; at sharp stops up to 0.50, 0.33 and 0.71. `ideal`
    /// gave 0.17 to 0.58 and, where it rings above the band, up to 5: no number undoes that.
    pub fn delay(&self, rate: FrameRate) -> f64 {
        let share = match self.kind {
            FilterKind::Box => 1.0 / 2.0,
            FilterKind::Gaussian | FilterKind::Ideal | FilterKind::Butterworth => 1.0 / 3.0,
        };
        self.filtering_width(rate).map_or(0.0, |width| share * width)
    }

    /// Returns the width in frames, if it filters.
    fn filtering_width(&self, rate: FrameRate) -> Option<f64> {
        let narrowest = match self.kind {
            FilterKind::Box => 0.0,
            FilterKind::Gaussian => 1.0,
            FilterKind::Ideal | FilterKind::Butterworth => 2.0,
        };
        Some(self.width.frames(rate)).filter(|width| width.is_finite() && *width > narrowest)
    }
}

#[cfg(test)]
mod tests;
