//! The error of slerping between any two frames of a list.

use rayon::prelude::*;

use crate::keys::Bridge;
use crate::quality::KomaFrames;

/// What is lost between every two frames when those two alone are keys: the sum over the koma and the
/// worst koma (区間の誤差), root mean square over the body's points in % of body height.
#[derive(Debug, Clone, PartialEq)]
pub struct Segments {
    /// One a later frame: the sums of all earlier ones as begins.
    sums: Vec<Vec<f64>>,
    /// The same of the worst koma.
    worsts: Vec<Vec<f64>>,
}

impl Segments {
    /// Measures every segment, on all cores: work grows with the third power of the length.
    pub fn of(grid: &KomaFrames) -> Self {
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
            (0..to).map(segment).unzip()
        };
        let mut columns: Vec<(Vec<f64>, Vec<f64>)> =
            columns.map_init(|| bridge.clone(), column).collect();
        columns.reverse();
        let (sums, worsts) = columns.into_iter().unzip();
        Self { sums, worsts }
    }

    /// Number of frames.
    pub fn len(&self) -> usize {
        self.sums.len()
    }

    /// Whether there is no frame.
    pub fn is_empty(&self) -> bool {
        self.sums.is_empty()
    }

    /// The sums of the segments that end at a frame, by the frame they begin at.
    pub(super) fn sums(&self, to: usize) -> &[f64] {
        &self.sums[to]
    }

    /// The worst koma of the segments that end at a frame, by the frame they begin at.
    pub(super) fn worsts(&self, to: usize) -> &[f64] {
        &self.worsts[to]
    }
}
