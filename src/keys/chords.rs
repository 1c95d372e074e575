//! Chords (弦): what is lost when the body goes straight from one posture to another.

use std::array;
use std::iter::once;

use crate::keys::Reference;
use crate::keys::acting::Acting;
use crate::keys::postures::Postures;
use crate::motion::lanes::{LANES, Lanes, pieces, wide};
use crate::motion::{Build, Clip};
use crate::time::{Clock, Frame};

/// Pairs of koma whose chord is kept of any clip at the most, unless its koma alone are too many: eight megabytes.
const PAIRS: usize = 1 << 21;

/// Instants at which the posture is known, in a koma: chords go from koma to koma, rests begin and end between them.
pub(super) const INSTANTS: usize = 2;

/// Koma that are looked at of a chord that is not known, at the most: a longer one is not slower.
const LOOKS: usize = 512;

/// Scalar products that are formed side by side.
const TOGETHER: usize = 4;

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
        Self::of_layer(clip, &Build::of(clip), reference, own, seconds)
    }

    /// The same of a part of the body, which alone moves in `part`; `build` is that of the whole.
    pub(crate) fn of_layer(
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
        chords.sum_up();
        chords
    }

    /// The koma nearest to a frame.
    pub(super) fn koma_of(&self, frame: Frame) -> usize {
        let clock = Clock { koma_rate: self.koma_rate(), ..self.clock };
        clock.koma_from_frame(frame).min(self.koma.saturating_sub(1))
    }

    /// The frame nearest to an instant.
    pub(super) fn frame(&self, instant: usize) -> Frame {
        self.clock.frame_from_koma(instant)
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

    /// What parts do while the body as a whole is quiet.
    pub(crate) fn acting(&self) -> &Acting {
        self.postures.acting()
    }

    /// How far parts that act while the body is quiet turn from one koma to another, in % of its height: see
    /// [`Postures`].
    pub(crate) fn acted(&self, a: usize, b: usize) -> f64 {
        let last = self.koma.saturating_sub(1);
        self.postures.acted(INSTANTS * a.min(last), INSTANTS * b.min(last))
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
    fn sum_up(&mut self) {
        let (len, reach) = (self.koma, self.reach);
        let rows = self.packed();
        let width = rows.len() / len.max(1);
        let row = |koma: usize| &rows[koma * width..(koma + 1) * width];
        let squares: Vec<f64> = (0..len).map(|koma| dots([row(koma)], row(koma))[0]).collect();
        let mut sums = Sums::of(&squares, reach);
        let mut products = vec![0.0; reach];
        for piece in pieces(len).rev() {
            wide(
                #[inline(always)]
                || {
                    for from in piece.rev() {
                        let products = &mut products[..reach.min(len - 1 - from)];
                        let losses = &mut self.losses[from * (reach + 1)..][1..=products.len()];
                        multiply(row(from), |ahead| row(from + 1 + ahead), products);
                        sums.close(from, &squares, products, losses);
                    }
                },
            );
        }
    }

    /// The body at each koma, its row filled up with zeros to whole registers.
    fn packed(&self) -> Vec<f64> {
        let width = self.row(0).len().next_multiple_of(LANES);
        let mut rows = vec![0.0; self.koma * width];
        for (koma, row) in rows.chunks_exact_mut(width).enumerate() {
            let own = self.row(koma);
            row[..own.len()].copy_from_slice(own);
        }
        rows
    }
}

/// What the chords from one koma need beside their scalar products: running sums, and what hangs on their length alone.
struct Sums {
    /// The squares of all koma before each.
    until: Vec<f64>,
    /// By how many koma n a chord is long, from 1 on: 1/n, and Σ s² and 2·Σ s·(1 − s) over the shares s of its inside.
    per_length: Vec<f64>,
    of_ends: Vec<f64>,
    of_both: Vec<f64>,
    /// Σ a·p, and Σ times the distance from a, over the inside p of each chord from the koma at hand.
    from_begin: [Vec<f64>; 2],
    /// The same seen from the end of each chord, by the koma of the end.
    from_end: [Vec<f64>; 2],
}

impl Sums {
    fn of(squares: &[f64], reach: usize) -> Self {
        let add = |sum: &mut f64, square: &f64| {
            *sum += square;
            Some(*sum)
        };
        let lengths = || (1..=reach).map(|n| n as f64);
        let of_ends = |n: f64| (n - 1.0) * (2.0 * n - 1.0) / (6.0 * n);
        let zeros = |count: usize| [vec![0.0; count], vec![0.0; count]];
        Self {
            until: once(0.0).chain(squares.iter().scan(0.0, add)).collect(),
            per_length: lengths().map(f64::recip).collect(),
            of_ends: lengths().map(of_ends).collect(),
            of_both: lengths().map(|n| (n * n - 1.0) / (3.0 * n)).collect(),
            from_begin: zeros(reach),
            from_end: zeros(squares.len()),
        }
    }

    /// The losses of the chords from a koma, the shortest first, by the products of its posture and those of their ends.
    #[inline(always)]
    fn close(&mut self, from: usize, squares: &[f64], products: &[f64], losses: &mut [f32]) {
        let count = products.len();
        let [begin, begin_far] = self.from_begin.each_mut().map(|sums| &mut sums[..count]);
        let (mut sum, mut sum_far) = (0.0, 0.0);
        for (at, product) in products.iter().enumerate() {
            (begin[at], begin_far[at]) = (sum, sum_far);
            sum += product;
            sum_far += (at + 1) as f64 * product;
        }
        let ends = from + 1..from + 1 + count;
        let [end, end_far] = self.from_end.each_mut().map(|sums| &mut sums[ends.clone()]);
        let (until, squares_of_ends) = (&self.until[ends.clone()], &squares[ends]);
        let (inside_from, square) = (self.until[from + 1], squares[from]);
        let [per_length, of_ends, of_both] =
            [&self.per_length, &self.of_ends, &self.of_both].map(|each| &each[..count]);
        for at in 0..count {
            let cross =
                begin[at] - begin_far[at] * per_length[at] + end[at] - end_far[at] * per_length[at];
            let inside = until[at] - inside_from;
            let ends = (square + squares_of_ends[at]) * of_ends[at] + products[at] * of_both[at];
            losses[at] = (inside - 2.0 * cross + ends).max(0.0) as f32;
            end[at] += products[at];
            end_far[at] += (at + 1) as f64 * products[at];
        }
    }
}

/// The scalar products of a row and those ahead of it.
#[inline(always)]
fn multiply<'a>(own: &[f64], ahead: impl Fn(usize) -> &'a [f64], products: &mut [f64]) {
    let mut blocks = products.chunks_exact_mut(TOGETHER);
    let mut at = 0;
    for block in &mut blocks {
        block.copy_from_slice(&dots::<TOGETHER>(array::from_fn(|lane| ahead(at + lane)), own));
        at += TOGETHER;
    }
    for product in blocks.into_remainder() {
        [*product] = dots([ahead(at)], own);
        at += 1;
    }
}

/// The scalar products of as many rows with another; each row and sum in registers of its own.
#[inline(always)]
fn dots<const ROWS: usize>(rows: [&[f64]; ROWS], other: &[f64]) -> [f64; ROWS] {
    let mut sums = [Lanes::ZERO; ROWS];
    let rows = rows.map(|row| row.as_chunks::<LANES>().0);
    for (at, other) in other.as_chunks::<LANES>().0.iter().enumerate() {
        for (sum, row) in sums.iter_mut().zip(rows) {
            *sum = *sum + Lanes(row[at]) * Lanes(*other);
        }
    }
    sums.map(|sum| sum.0.iter().sum())
}

#[cfg(test)]
mod tests;
