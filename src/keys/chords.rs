//! Chords (弦): the loss if the body goes straight from one posture to another.

use std::array;
use std::iter::once;

use crate::keys::Reference;
use crate::keys::acting::Acting;
use crate::keys::postures::Postures;
use crate::motion::lanes::{LANES, Lanes, pieces, wide};
use crate::motion::{Build, Clip};
use crate::time::{Clock, Frame};

/// Most pairs of koma whose chord is stored, eight megabytes, unless `LEAST_REACH` needs more.
const PAIRS: usize = 1 << 21;

/// Postures per koma: chords go from koma to koma, but rests begin and end between them.
pub(super) const INSTANTS: usize = 2;

/// Most koma sampled on a chord that is not stored, so that a longer one is not slower.
const LOOKS: usize = 512;

/// Scalar products computed side by side.
const TOGETHER: usize = 4;

/// Length in seconds up to which all chords are stored, however long the clip.
const LEAST_REACH: f64 = 2.0;

/// The loss of every chord up to some length.
///
/// The loss between two koma is the squared distance of the postures between them from the straight line, summed over
/// koma: %² of body height times koma. Given a·b for each pair, all of it comes from running sums, so that a pair costs
/// one scalar product whatever its length.
#[derive(Debug, Clone, PartialEq)]
pub struct Chords {
    postures: Postures,
    /// Times of the instants in the clip.
    clock: Clock,
    koma: usize,
    /// Most koma from one end of a stored chord to the other.
    pub(super) reach: usize,
    /// Koma × (reach + 1): the loss from each koma to itself and to the first, second … after it. Single precision
    /// halves the memory, and its seven digits are more than any motion has.
    losses: Vec<f32>,
}

impl Chords {
    /// Computes the chords of a clip between the koma of its reference, on the reference's screen. Chords up to
    /// `seconds` long are stored: 2 or more, or infinite for as many as memory allows. `own` is the weight of each
    /// joint on top of its bones: 0 or more, at least one above 0.
    pub fn new(clip: &Clip, reference: &Reference, own: &[f64], seconds: f64) -> Self {
        Self::of_layer(clip, &Build::new(clip), reference, own, seconds)
    }

    /// Computes the [chords](Self::new) of a part of the body, which alone moves in `part`. `build` is that of the whole
    /// body.
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
        let postures = Postures::new(part, build, clock, look, own);
        let koma = postures.len().div_ceil(INSTANTS);
        let [least, most] = [LEAST_REACH, seconds].map(|s| (s * koma_rate).ceil() as usize);
        let reach = (PAIRS / koma.max(1)).min(most).max(least).min(koma.saturating_sub(1));
        let losses = vec![0.0; koma * (reach + 1)];
        let mut chords = Self { postures, clock, koma, reach, losses };
        chords.sum_up();
        chords
    }

    /// Returns the koma nearest to a frame.
    pub(super) fn koma_of(&self, frame: Frame) -> usize {
        let clock = Clock { koma_rate: self.koma_rate(), ..self.clock };
        clock.koma_from_frame(frame).min(self.koma.saturating_sub(1))
    }

    /// Returns the frame nearest to an instant.
    pub(super) fn frame(&self, instant: usize) -> Frame {
        self.clock.frame_from_koma(instant)
    }

    /// Returns the times of the instants in the clip.
    pub(super) fn clock(&self) -> Clock {
        self.clock
    }

    /// Koma a second.
    pub(super) fn koma_rate(&self) -> f64 {
        self.clock.koma_rate / INSTANTS as f64
    }

    /// Returns the body at each instant.
    pub(super) fn postures(&self) -> &Postures {
        &self.postures
    }

    /// Returns the parts that act while the whole body is quiet.
    pub(crate) fn acting(&self) -> &Acting {
        self.postures.acting()
    }

    /// Returns how far parts that act while the body is quiet turn from one koma to another, in % of body height: see
    /// [`Postures`].
    pub(crate) fn acted(&self, a: usize, b: usize) -> f64 {
        let last = self.koma.saturating_sub(1);
        self.postures.acted(INSTANTS * a.min(last), INSTANTS * b.min(last))
    }

    /// Number of instants.
    pub(super) fn len(&self) -> usize {
        self.postures.len()
    }

    /// Returns the body at a koma.
    #[inline(always)]
    fn row(&self, koma: usize) -> &[f64] {
        self.postures.row(INSTANTS * koma)
    }

    /// Returns the stored losses from one koma to itself and to each later one within reach.
    #[inline]
    pub(super) fn known(&self, from: usize) -> &[f32] {
        let row = self.reach + 1;
        &self.losses[from * row..(from + 1) * row]
    }

    /// Returns the loss from one koma to a later one, however far.
    #[inline]
    pub(super) fn loss(&self, from: usize, to: usize) -> f64 {
        match self.known(from).get(to - from) {
            Some(loss) => f64::from(*loss),
            None => self.far(from, to),
        }
    }

    /// Computes a loss directly, koma by koma; on a long chord at every second, third … koma.
    fn far(&self, from: usize, to: usize) -> f64 {
        let step = (to - from).div_ceil(LOOKS);
        let squares = (from + step..to).step_by(step).map(|koma| self.off(from, koma, to));
        step as f64 * squares.sum::<f64>()
    }

    /// Returns the squared distance of a posture from the straight line between two others, in %².
    fn off(&self, from: usize, koma: usize, to: usize) -> f64 {
        let share = (koma - from) as f64 / (to - from) as f64;
        let square = |own: f64, from: f64, to: f64| (own - (from + share * (to - from))).powi(2);
        let ends = self.row(from).iter().zip(self.row(to));
        self.row(koma).iter().zip(ends).map(|(own, (from, to))| square(*own, *from, *to)).sum()
    }

    /// Computes every loss within reach. For a chord from a to b, it needs the sums of a·p over the postures p inside,
    /// plain and times the distance from a, and likewise b·p seen from b. The former grow with each end, the latter
    /// with each begin.
    fn sum_up(&mut self) {
        let (len, reach) = (self.koma, self.reach);
        let rows = self.packed();
        let width = rows.len() / len.max(1);
        let row = |koma: usize| &rows[koma * width..(koma + 1) * width];
        let squares: Vec<f64> = (0..len).map(|koma| dots([row(koma)], row(koma))[0]).collect();
        let mut sums = Sums::new(&squares, reach);
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

    /// Returns the body at each koma, each row padded with zeros to whole registers.
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

/// Running sums that the chords from one koma need besides their scalar products, and factors that depend on length
/// only.
struct Sums {
    /// Sum of the squares of all koma before each.
    until: Vec<f64>,
    /// Factors by length n in koma, from 1 on: 1/n, Σ s² (`of_ends`) and 2·Σ s·(1 − s) (`of_both`) over the shares s
    /// inside.
    per_length: Vec<f64>,
    of_ends: Vec<f64>,
    of_both: Vec<f64>,
    /// Σ a·p, and Σ a·p times the distance from a, over the inside p of each chord from the current koma.
    from_begin: [Vec<f64>; 2],
    /// Σ b·p, and Σ b·p times the distance from b, over the inside p of each chord, by the koma of its end b.
    from_end: [Vec<f64>; 2],
}

impl Sums {
    fn new(squares: &[f64], reach: usize) -> Self {
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

    /// Computes the losses of the chords from a koma, the shortest first, from the products of its posture with their
    /// ends.
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

/// Computes the scalar products of a row with the rows ahead of it.
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

/// Computes the scalar products of several rows with another, each row and sum in its own registers.
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
