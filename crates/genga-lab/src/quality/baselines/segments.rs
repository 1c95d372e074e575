//! The error of slerping between any two frames of a list.

use rayon::prelude::*;

use crate::quality::KomaFrames;
use genga::error::Error;
use genga::keys::Bridge;
use genga::pipeline::Stop;

/// The error between every two frames if those two alone are keys: the sum over the koma and the worst koma (区間の誤差), as
/// a root mean square over the body's points in % of body height.
#[derive(Debug, Clone, PartialEq)]
pub struct Segments {
    /// For each later frame, the sums by earlier frame.
    sums: Vec<Vec<f64>>,
    /// For each later frame, the errors of the worst koma by earlier frame.
    worsts: Vec<Vec<f64>>,
}

impl Segments {
    /// Measures every segment on all cores; the work is cubic in the length.
    pub fn new(grid: &KomaFrames) -> Self {
        Self::until(grid, &Stop::default()).expect("no one asks to stop")
    }

    /// Like [`Segments::new`], until `stop` is asked.
    ///
    /// # Errors
    /// [`Error::Stopped`].
    pub fn until(grid: &KomaFrames, stop: &Stop) -> Result<Self, Error> {
        let bridge = Bridge::new(&grid.clip, &grid.reference, &grid.frames);
        // The longest first, so that no thread is left with them at the end.
        let columns = (0..grid.frames.len()).into_par_iter().rev();
        let column = |bridge: &mut Bridge<'_>, to: usize| {
            let segment = |from| {
                let (mut sum, mut worst) = (0.0, 0f64);
                bridge.errors(from, to, |_, error| {
                    sum += error;
                    worst = worst.max(error);
                });
                (sum, worst)
            };
            stop.check().map(|()| (0..to).map(segment).unzip())
        };
        let columns = columns.map_init(|| bridge.clone(), column).collect::<Result<Vec<_>, _>>();
        let (sums, worsts): (Vec<_>, Vec<_>) = columns?.into_iter().rev().unzip();
        Ok(Self { sums, worsts })
    }

    /// Returns the number of frames.
    pub fn len(&self) -> usize {
        self.sums.len()
    }

    /// Whether there is no frame.
    pub fn is_empty(&self) -> bool {
        self.sums.is_empty()
    }

    /// Returns the sums of the segments that end at a frame, by the frame they begin at.
    pub(super) fn sums(&self, to: usize) -> &[f64] {
        &self.sums[to]
    }

    /// Returns the worst errors of the segments that end at a frame, by the frame they begin at.
    pub(super) fn worsts(&self, to: usize) -> &[f64] {
        &self.worsts[to]
    }
}
