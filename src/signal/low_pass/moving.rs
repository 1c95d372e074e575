//! Computes the moving average as a running sum: one addition and one subtraction a frame, whatever the width.
//!
//! The spectrum gives the same result, but needs three times as long and more memory. The tests compare both.

use nalgebra::DMatrix;

use crate::signal::Signals;

/// Columns summed side by side.
const TOGETHER: usize = 4;

/// Frames after which the sum is computed anew, so that rounding does not grow with the clip.
const FRESH: usize = 1024;

/// A window of any width: the `2 · reach + 1` frames in the middle weigh the same, and two more on each side weigh
/// less.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    reach: usize,
    taps: Taps,
}

/// The weights of a window's frames, which add up to 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Taps {
    /// Weight of each frame in the middle.
    pub(super) middle: f64,
    /// Weight of the next frame on either side.
    pub(super) inner: f64,
    /// Weight of the outermost frame on either side.
    pub(super) outer: f64,
}

/// Returns how far the middle frames reach to either side, and all weights, for a width in frames above 0.
///
/// Each edge falls in three steps, between the frames about W/2 from the middle. The steps sum to 1, their mean lies at
/// W/2, and their squares sum to 1/2, like those of the two equal steps of an even width. So as much noise of the
/// frames gets into the acceleration at an odd width as at an even one.
pub(super) fn taps(width: f64) -> (f64, Taps) {
    let half = width / 2.0;
    let whole = half.floor();
    // Distance of the middle step beyond W/2. The other two steps follow from the three conditions.
    let beyond = whole + 0.5 - half;
    let last = (2.0 - 3.0 * beyond - (1.0 - 3.0 * beyond * beyond).sqrt()) / 6.0;
    let first = last + beyond;
    let (reach, [middle, inner, outer]) = match whole {
        // Both edges fall beside the one frame in the middle.
        0.0 => (0.0, [1.0 - 2.0 * first, last, 0.0]),
        _ => (whole - 1.0, [1.0, 1.0 - first, last]),
    };
    (reach, Taps { middle: middle / width, inner: inner / width, outer: outer / width })
}

impl Window {
    /// Returns the window of a width in frames above 0; `None` if it reaches beyond the clip mirrored once.
    pub(super) fn within(width: f64, frames: usize) -> Option<Self> {
        let (reach, taps) = taps(width);
        (reach + 2.0 <= frames as f64).then_some(Self { reach: reach as usize, taps })
    }

    /// Computes the means of every joint by itself.
    pub(super) fn means(self, signals: &Signals) -> Signals {
        let (frames, joints) = signals.values.shape();
        let mut values = vec![0.0; frames * joints];
        let columns = signals.values.as_slice().chunks(TOGETHER * frames);
        for (columns, means) in columns.zip(values.chunks_mut(TOGETHER * frames)) {
            if columns.len() == TOGETHER * frames {
                self.slide::<TOGETHER>(columns, means);
            } else {
                let each = columns.chunks_exact(frames).zip(means.chunks_exact_mut(frames));
                each.for_each(|(column, means)| self.slide::<1>(column, means));
            }
        }
        Signals { values: DMatrix::from_vec(frames, joints, values), ..*signals }
    }

    /// Computes the mean around each frame of `COLUMNS` columns, one behind the other. They run side by side, because
    /// each sum waits for the one before it.
    #[inline(always)]
    pub(super) fn slide<const COLUMNS: usize>(self, columns: &[f64], means: &mut [f64]) {
        let frames = columns.len() / COLUMNS;
        let part = FRESH.max(2 * self.reach + 1);
        for begin in (0..frames).step_by(part) {
            let mut sums = [0.0; COLUMNS];
            for (sum, column) in sums.iter_mut().zip(columns.chunks_exact(frames)) {
                let round = begin as isize - self.reach as isize..=(begin + self.reach) as isize;
                *sum = round.map(|frame| column[mirrored(frame, frames)]).sum();
            }
            let end = frames.min(begin + part);
            // If the whole window lies within the clip, no frame is mirrored.
            let inner = (begin.max(self.reach + 2), end.min(frames.saturating_sub(self.reach + 2)));
            let inner = if inner.0 < inner.1 { inner.0..inner.1 } else { end..end };
            let at = |frame: isize| mirrored(frame, frames);
            let outer = |frame: usize| {
                let (frame, reach) = (frame as isize, self.reach as isize);
                let (before, after) = (frame - reach, frame + reach);
                [at(before - 2), at(before - 1), at(before), at(after + 1), at(after + 2)]
            };
            for frame in begin..inner.start {
                self.step::<COLUMNS>((columns, frames), &mut sums, frame, outer(frame), means);
            }
            for frame in inner.clone() {
                let (before, after) = (frame - self.reach, frame + self.reach);
                let round = [before - 2, before - 1, before, after + 1, after + 2];
                self.step::<COLUMNS>((columns, frames), &mut sums, frame, round, means);
            }
            for frame in inner.end..end {
                self.step::<COLUMNS>((columns, frames), &mut sums, frame, outer(frame), means);
            }
        }
    }

    /// Writes the means of a frame and moves the sums on to the next frame. The frames are, in order: the two before
    /// the middle of the window, the first of the middle, and the two after it.
    #[inline(always)]
    fn step<const COLUMNS: usize>(
        self,
        (columns, frames): (&[f64], usize),
        sums: &mut [f64; COLUMNS],
        frame: usize,
        [outer, inner, first, next, last]: [usize; 5],
        means: &mut [f64],
    ) {
        let taps = self.taps;
        for (column, sum) in sums.iter_mut().enumerate() {
            let own = &columns[column * frames..(column + 1) * frames];
            means[column * frames + frame] = taps.middle * *sum
                + taps.inner * (own[inner] + own[next])
                + taps.outer * (own[outer] + own[last]);
            *sum += own[next] - own[first];
        }
    }
}

/// Returns the frame at a place of the mirrored clip: c b a | a b c … x y z | z y x.
#[inline(always)]
fn mirrored(place: isize, frames: usize) -> usize {
    let last = frames as isize - 1;
    let place = if place < 0 { -1 - place } else { place };
    (if place > last { 2 * last + 1 - place } else { place }) as usize
}
