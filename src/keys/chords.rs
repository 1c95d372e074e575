//! Chords (弦): what is lost when the body goes straight from one posture to another.

use crate::keys::Reference;
use crate::keys::postures::Postures;
use crate::motion::Clip;
use crate::motion::lanes::wide;
use crate::time::{Clock, Frame};

/// Pairs of instants that are kept of any clip at the most, unless its instants alone are too many: eight
/// megabytes.
const PAIRS: usize = 1 << 21;

/// Koma from one instant to the next.
pub(super) const STEP: f64 = 0.5;

/// Instants that are looked at of a chord that is not known, at the most: a longer one is not slower.
const LOOKS: usize = 512;

/// Seconds from one end of a chord to the other up to which all are known, however long the clip.
const LEAST_REACH: f64 = 2.0;

/// The loss of every chord up to some length.
///
/// What is lost between two instants is the squared distance of the postures between them from the
/// straight way, summed over koma: %² of the body's height times koma. With a·b known for each pair, all
/// of it comes from running sums, so that a pair costs one scalar product however long it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Chords {
    postures: Postures,
    /// Where the instants stand in the clip.
    clock: Clock,
    /// The most instants from one end of a known chord to the other.
    pub(super) reach: usize,
    /// Instants × (reach + 1): the loss from each instant to itself and to the first, second … after it. Seven
    /// digits of a sum of squares are more than any motion has, and half the memory.
    losses: Vec<f32>,
}

impl Chords {
    /// The chords of a clip between instants half a koma of its reference apart, seen from where that is, each
    /// known that is no longer than `seconds`, 2 or more; infinite for as many as there is memory for. `own`
    /// is how much each joint counts beside its bones: 0 or more, one of them above.
    pub fn of(clip: &Clip, reference: &Reference, own: &[f64], seconds: f64) -> Self {
        Self::of_part(clip, clip, reference, own, seconds)
    }

    /// The same of a part of the body, which alone moves in `part`; what the body is like is seen in the
    /// whole clip.
    pub(crate) fn of_part(
        part: &Clip,
        whole: &Clip,
        reference: &Reference,
        own: &[f64],
        seconds: f64,
    ) -> Self {
        let clock = part.clock(reference.clock().koma_rate / STEP);
        let look = (reference.screen(), reference.height());
        let postures = Postures::of(part, whole, clock, look, own);
        let len = postures.len();
        let [least, most] = [LEAST_REACH, seconds].map(|s| (s * clock.koma_rate).ceil() as usize);
        let reach = (PAIRS / len.max(1)).min(most).max(least).min(len.saturating_sub(1));
        let mut chords = Self { postures, clock, reach, losses: vec![0.0; len * (reach + 1)] };
        wide(
            #[inline(always)]
            || chords.sum_up(),
        );
        chords
    }

    /// The instant nearest to a frame.
    pub(super) fn instant(&self, frame: Frame) -> usize {
        self.clock.koma_from_place(frame.0 as f64).min(self.len().saturating_sub(1))
    }

    /// The frame nearest to an instant.
    pub(super) fn frame(&self, instant: usize) -> Frame {
        Frame(self.clock.place_from_koma(instant).round() as usize)
    }

    /// Where the instants stand in the clip.
    pub(super) fn clock(&self) -> Clock {
        self.clock
    }

    /// The body at each instant.
    pub(super) fn postures(&self) -> &Postures {
        &self.postures
    }

    /// Number of instants.
    pub(super) fn len(&self) -> usize {
        self.postures.len()
    }

    /// What is lost from one instant to itself and to each later one within reach.
    #[inline]
    pub(super) fn known(&self, from: usize) -> &[f32] {
        let row = self.reach + 1;
        &self.losses[from * row..(from + 1) * row]
    }

    /// What is lost from one instant to a later one, however far.
    #[inline]
    pub(super) fn loss(&self, from: usize, to: usize) -> f64 {
        match self.known(from).get(to - from) {
            Some(loss) => f64::from(*loss),
            None => self.far(from, to),
        }
    }

    /// The same from the words, instant by instant; of a long chord every second, third … instant.
    fn far(&self, from: usize, to: usize) -> f64 {
        let step = (to - from).div_ceil(LOOKS);
        let squares = (from + step..to).step_by(step).map(|instant| self.off(from, instant, to));
        STEP * step as f64 * squares.sum::<f64>()
    }

    /// How far off the body is in all from one instant to a later one, in % of its height times koma. Where
    /// the way has a corner this is least with a key on it, and near it is not nearly as small: squares
    /// would rather be a little off everywhere.
    pub(super) fn way_off(&self, from: usize, to: usize) -> f64 {
        wide(
            #[inline(always)]
            || STEP * (from + 1..to).map(|instant| self.off(from, instant, to).sqrt()).sum::<f64>(),
        )
    }

    /// The squared distance of a posture from the straight way between two others, in %².
    #[inline(always)]
    fn off(&self, from: usize, instant: usize, to: usize) -> f64 {
        let share = (instant - from) as f64 / (to - from) as f64;
        let row = |at| self.postures.row(at);
        square_off(row(instant), row(from), row(to), share)
    }

    /// Finds every loss within reach. Seen from its begin a chord needs the sums of a·p and of those
    /// times the distance from a over the postures p inside, and the same seen from its end: the
    /// former grow with each end, the latter with each begin.
    #[inline(always)]
    fn sum_up(&mut self) {
        let len = self.len();
        let squares: Vec<f64> =
            (0..len).map(|at| self.postures.row(at)).map(|row| dot(row, row)).collect();
        let until: Vec<f64> = std::iter::once(0.0)
            .chain(squares.iter().scan(0.0, |sum, square| {
                *sum += square;
                Some(*sum)
            }))
            .collect();
        let mut from_end = vec![(0.0, 0.0); len];
        for from in (0..len).rev() {
            let mut from_begin = (0.0, 0.0);
            let own = self.postures.row(from);
            let row = &mut self.losses[from * (self.reach + 1)..][1..=self.reach];
            for (loss, to) in row.iter_mut().zip(from + 1..len) {
                let (product, n) = (dot(own, self.postures.row(to)), (to - from) as f64);
                let inside = until[to] - until[from + 1];
                let (begin, end) = (from_begin, from_end[to]);
                let cross = begin.0 - begin.1 / n + end.0 - end.1 / n;
                let of_ends =
                    (squares[from] + squares[to]) * (n - 1.0) * (2.0 * n - 1.0) / (6.0 * n);
                let both = product * (n * n - 1.0) / (3.0 * n);
                *loss = (STEP * (inside - 2.0 * cross + of_ends + both).max(0.0)) as f32;
                from_begin.0 += product;
                from_begin.1 += n * product;
                from_end[to].0 += product;
                from_end[to].1 += n * product;
            }
        }
    }
}

/// The squared distance of a row from the place between two others; four sums side by side, so that the compiler
/// keeps them in one register.
#[inline(always)]
fn square_off(own: &[f64], from: &[f64], to: &[f64], share: f64) -> f64 {
    let square = |own: f64, from: f64, to: f64| (own - (from + share * (to - from))).powi(2);
    let mut sums = [0.0; 4];
    let (own, from, to) = (own.chunks_exact(4), from.chunks_exact(4), to.chunks_exact(4));
    let ends = from.remainder().iter().zip(to.remainder());
    let rest = own.remainder().iter().zip(ends).map(|(own, (from, to))| square(*own, *from, *to));
    let rest: f64 = rest.sum();
    for (own, (from, to)) in own.zip(from.zip(to)) {
        for lane in 0..4 {
            sums[lane] += square(own[lane], from[lane], to[lane]);
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// The scalar product, in the same way.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for lane in 0..4 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests;
