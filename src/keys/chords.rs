//! Chords (弦): what is lost when the body goes straight from one posture to another.

use crate::keys::Reference;
use crate::keys::postures::Postures;
use crate::motion::lanes::wide;
use crate::motion::{Build, Clip};
use crate::time::{Clock, Frame};

/// Pairs of koma whose chord is kept of any clip at the most, unless its koma alone are too many: eight megabytes.
const PAIRS: usize = 1 << 21;

/// Instants at which the posture is known, in a koma: chords go from koma to koma, rests begin and end between them.
pub(super) const INSTANTS: usize = 2;

/// Koma that are looked at of a chord that is not known, at the most: a longer one is not slower.
const LOOKS: usize = 512;

/// Seconds from one end of a chord to the other up to which all are known, however long the clip.
const LEAST_REACH: f64 = 2.0;

/// The loss of every chord up to some length.
///
/// What is lost between two koma is the squared distance of the postures between them from the straight way, summed
/// over koma: %² of the body's height times koma. With a·b known for each pair, all of it comes from running sums, so
/// that a pair costs one scalar product however long it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Chords {
    postures: Postures,
    /// Where the instants stand in the clip.
    clock: Clock,
    koma: usize,
    /// The most koma from one end of a known chord to the other.
    pub(super) reach: usize,
    /// Koma × (reach + 1): the loss from each koma to itself and to the first, second … after it. Seven digits of a
    /// sum of squares are more than any motion has, and half the memory.
    losses: Vec<f32>,
}

impl Chords {
    /// The chords of a clip between the koma of its reference, seen from where that is, each known that is no longer than
    /// `seconds`, 2 or more; infinite for as many as there is memory for. `own` is how much each joint counts beside its
    /// bones: 0 or more, one of them above.
    pub fn of(clip: &Clip, reference: &Reference, own: &[f64], seconds: f64) -> Self {
        Self::of_part(clip, &Build::of(clip), reference, own, seconds)
    }

    /// The same of a part of the body, which alone moves in `part`; `build` is that of the whole.
    pub(crate) fn of_part(
        part: &Clip,
        build: &Build,
        reference: &Reference,
        own: &[f64],
        seconds: f64,
    ) -> Self {
        let koma_rate = reference.clock().koma_rate;
        let clock = part.clock(INSTANTS as f64 * koma_rate);
        let look = (reference.screen(), reference.height());
        let postures = Postures::of(part, build, clock, look, own);
        let koma = postures.len().div_ceil(INSTANTS);
        let [least, most] = [LEAST_REACH, seconds].map(|s| (s * koma_rate).ceil() as usize);
        let reach = (PAIRS / koma.max(1)).min(most).max(least).min(koma.saturating_sub(1));
        let losses = vec![0.0; koma * (reach + 1)];
        let mut chords = Self { postures, clock, koma, reach, losses };
        wide(
            #[inline(always)]
            || chords.sum_up(),
        );
        chords
    }

    /// The koma nearest to a frame.
    pub(super) fn koma_of(&self, frame: Frame) -> usize {
        let clock = Clock { koma_rate: self.koma_rate(), ..self.clock };
        clock.koma_from_place(frame.0 as f64).min(self.koma.saturating_sub(1))
    }

    /// The frame nearest to an instant.
    pub(super) fn frame(&self, instant: usize) -> Frame {
        Frame(self.clock.place_from_koma(instant).round() as usize)
    }

    /// Where the instants of the postures stand in the clip.
    pub(super) fn clock(&self) -> Clock {
        self.clock
    }

    /// Koma a second.
    pub(super) fn koma_rate(&self) -> f64 {
        self.clock.koma_rate / INSTANTS as f64
    }

    /// The body at each instant.
    pub(super) fn postures(&self) -> &Postures {
        &self.postures
    }

    /// Number of instants.
    pub(super) fn len(&self) -> usize {
        self.postures.len()
    }

    /// The body at a koma.
    #[inline(always)]
    fn row(&self, koma: usize) -> &[f64] {
        self.postures.row(INSTANTS * koma)
    }

    /// What is lost from one koma to itself and to each later one within reach.
    #[inline]
    pub(super) fn known(&self, from: usize) -> &[f32] {
        let row = self.reach + 1;
        &self.losses[from * row..(from + 1) * row]
    }

    /// What is lost from one koma to a later one, however far.
    #[inline]
    pub(super) fn loss(&self, from: usize, to: usize) -> f64 {
        match self.known(from).get(to - from) {
            Some(loss) => f64::from(*loss),
            None => self.far(from, to),
        }
    }

    /// The same from the words, koma by koma; of a long chord every second, third … koma.
    fn far(&self, from: usize, to: usize) -> f64 {
        let step = (to - from).div_ceil(LOOKS);
        let squares = (from + step..to).step_by(step).map(|koma| self.off(from, koma, to));
        step as f64 * squares.sum::<f64>()
    }

    /// The squared distance of a posture from the straight way between two others, in %².
    fn off(&self, from: usize, koma: usize, to: usize) -> f64 {
        let share = (koma - from) as f64 / (to - from) as f64;
        let square = |own: f64, from: f64, to: f64| (own - (from + share * (to - from))).powi(2);
        let ends = self.row(from).iter().zip(self.row(to));
        self.row(koma).iter().zip(ends).map(|(own, (from, to))| square(*own, *from, *to)).sum()
    }

    /// Finds every loss within reach. Seen from its begin a chord needs the sums of a·p and of those
    /// times the distance from a over the postures p inside, and the same seen from its end: the
    /// former grow with each end, the latter with each begin.
    #[inline(always)]
    fn sum_up(&mut self) {
        let len = self.koma;
        let squares: Vec<f64> = (0..len).map(|at| dot(self.row(at), self.row(at))).collect();
        let until: Vec<f64> = std::iter::once(0.0)
            .chain(squares.iter().scan(0.0, |sum, square| {
                *sum += square;
                Some(*sum)
            }))
            .collect();
        let mut from_end = vec![(0.0, 0.0); len];
        for from in (0..len).rev() {
            let mut from_begin = (0.0, 0.0);
            let own = self.postures.row(INSTANTS * from);
            let row = &mut self.losses[from * (self.reach + 1)..][1..=self.reach];
            for (loss, to) in row.iter_mut().zip(from + 1..len) {
                let product = dot(own, self.postures.row(INSTANTS * to));
                let n = (to - from) as f64;
                let inside = until[to] - until[from + 1];
                let (begin, end) = (from_begin, from_end[to]);
                let cross = begin.0 - begin.1 / n + end.0 - end.1 / n;
                let of_ends =
                    (squares[from] + squares[to]) * (n - 1.0) * (2.0 * n - 1.0) / (6.0 * n);
                let both = product * (n * n - 1.0) / (3.0 * n);
                *loss = (inside - 2.0 * cross + of_ends + both).max(0.0) as f32;
                from_begin.0 += product;
                from_begin.1 += n * product;
                from_end[to].0 += product;
                from_end[to].1 += n * product;
            }
        }
    }
}

/// The scalar product; four sums side by side, so that the compiler keeps them in one register.
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
