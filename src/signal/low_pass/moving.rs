//! The moving average as a running sum: one addition and one subtraction a frame, whatever the width.
//!
//! What the spectrum gives as well, for a third of the time and none of the memory; the spectrum is
//! its test.

use nalgebra::DMatrix;

use crate::signal::Signals;

/// Columns that are summed side by side.
const TOGETHER: usize = 4;

/// Frames after which the sum is taken anew, so that rounding does not grow with the clip.
const FRESH: usize = 1024;

/// A window of `2 · reach + 1` whole frames and a part of one more on each side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    per_width: f64,
    reach: usize,
    /// The weight of the outermost frames, 0 to 1.
    rest: f64,
}

impl Window {
    /// The window of a width in frames above 1; none where it reaches beyond the clip mirrored once.
    pub(super) fn within(width: f64, frames: usize) -> Option<Self> {
        let reach = ((width - 1.0) / 2.0).floor();
        let rest = (width - (2.0 * reach + 1.0)) / 2.0;
        (reach + 1.0 < frames as f64).then_some(Self {
            per_width: 1.0 / width,
            reach: reach as usize,
            rest,
        })
    }

    /// The means of every joint by itself.
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

    /// The mean round each frame of as many columns, one behind the other. Side by side, for each sum waits for the one
    /// before it.
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
            // Where the window and a frame to each side of it lie within the clip, no frame is mirrored.
            let inner = (begin.max(self.reach + 1), end.min(frames - self.reach - 1));
            let inner = if inner.0 < inner.1 { inner.0..inner.1 } else { end..end };
            let at = |frame: isize| mirrored(frame, frames);
            let outer = |frame: usize| {
                let (frame, reach) = (frame as isize, self.reach as isize);
                [at(frame - reach - 1), at(frame - reach), at(frame + reach + 1)]
            };
            for frame in begin..inner.start {
                self.step::<COLUMNS>((columns, frames), &mut sums, frame, outer(frame), means);
            }
            for frame in inner.clone() {
                let round = [frame - self.reach - 1, frame - self.reach, frame + self.reach + 1];
                self.step::<COLUMNS>((columns, frames), &mut sums, frame, round, means);
            }
            for frame in inner.end..end {
                self.step::<COLUMNS>((columns, frames), &mut sums, frame, outer(frame), means);
            }
        }
    }

    /// Writes the means of a frame and takes the sums on to the next; `round` are the frame before the window, the first
    /// of it and the frame after it.
    #[inline(always)]
    fn step<const COLUMNS: usize>(
        self,
        (columns, frames): (&[f64], usize),
        sums: &mut [f64; COLUMNS],
        frame: usize,
        [before, first, after]: [usize; 3],
        means: &mut [f64],
    ) {
        for (column, sum) in sums.iter_mut().enumerate() {
            let own = &columns[column * frames..(column + 1) * frames];
            let mean = (*sum + self.rest * (own[before] + own[after])) * self.per_width;
            means[column * frames + frame] = mean;
            *sum += own[after] - own[first];
        }
    }
}

/// The frame that stands at a place of the mirrored clip: c b a | a b c … x y z | z y x.
#[inline(always)]
fn mirrored(place: isize, frames: usize) -> usize {
    let last = frames as isize - 1;
    let place = if place < 0 { -1 - place } else { place };
    (if place > last { 2 * last + 1 - place } else { place }) as usize
}
