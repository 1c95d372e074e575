//! Counts for how many frames in a row a joint stays faster, or slower, than at a given frame.

use super::{Side, TurnKind};
use crate::motion::lanes::{LANES, Lanes};

/// Entries of one line that are summed up by one entry of the line above.
const SPAN: usize = 16;

/// Counts of frames after a row, and before it, that are all faster (which confirms a key) or all slower (a wall) by
/// more than the floor. Few rows are asked for, so counts are looked up instead of computed for all.
pub(super) struct Persistence {
    valleys: Minima,
    /// Minima of the negated speeds, in which a wall is a key.
    hills: Minima,
    floor: f64,
    /// Counts after each row with `rising`, for both kinds.
    rising: [Vec<usize>; 2],
    side: Side,
}

impl Persistence {
    pub(super) fn new() -> Self {
        Self {
            valleys: Minima::default(),
            hills: Minima::default(),
            floor: 0.0,
            rising: [Vec::new(), Vec::new()],
            side: Side::After,
        }
    }

    /// Reads another joint. With `rising` each frame after must be faster than the one before it.
    #[inline(always)]
    pub(super) fn read(&mut self, speeds: &[f64], floor: f64, side: Side) {
        (self.floor, self.side) = (floor, side);
        self.valleys.read(speeds.iter().copied());
        self.hills.read(speeds.iter().map(|speed| -speed));
        if side == Side::Rising {
            let [keys, walls] = &mut self.rising;
            count_rising(self.valleys.values(), floor, keys);
            count_rising(self.hills.values(), floor, walls);
        }
    }

    /// Counts the consecutive frames after a row that confirm it as a turn of that kind.
    #[inline(always)]
    pub(super) fn after(&self, kind: TurnKind, row: usize) -> usize {
        match self.side {
            Side::Rising => self.rising[kind as usize][row],
            Side::After | Side::Both => self.minima(kind).higher_after(row, self.floor),
        }
    }

    /// Counts the consecutive frames before a row that confirm it as a turn of that kind.
    #[inline(always)]
    pub(super) fn before(&self, kind: TurnKind, row: usize) -> usize {
        self.minima(kind).higher_before(row, self.floor)
    }

    fn minima(&self, kind: TurnKind) -> &Minima {
        match kind {
            TurnKind::Key => &self.valleys,
            TurnKind::Wall => &self.hills,
        }
    }
}

/// Values, and above them lines with the least of each [`SPAN`] entries of the line below. A search for the next low
/// value skips high ones by whole spans of spans.
#[derive(Default)]
struct Minima {
    /// Number of values.
    rows: usize,
    /// Filled up to whole spans with infinity, which is never low.
    lines: Vec<Vec<f64>>,
}

impl Minima {
    #[inline(always)]
    fn read(&mut self, values: impl Iterator<Item = f64>) {
        if self.lines.is_empty() {
            self.lines.push(Vec::new());
        }
        self.lines[0].clear();
        self.lines[0].extend(values);
        self.rows = self.lines[0].len();
        fill_up(&mut self.lines[0]);
        let mut level = 0;
        while self.lines[level].len() > SPAN {
            if self.lines.len() == level + 1 {
                self.lines.push(Vec::new());
            }
            let (below, above) = self.lines.split_at_mut(level + 1);
            above[0].clear();
            above[0].extend(spans(&below[level]).iter().map(least));
            fill_up(&mut above[0]);
            level += 1;
        }
    }

    fn values(&self) -> &[f64] {
        &self.lines[0][..self.rows]
    }

    /// Counts the rows after `row` up to the first that is not higher by more than `floor`.
    #[inline(always)]
    fn higher_after(&self, row: usize, floor: f64) -> usize {
        let bottom = self.lines[0][row];
        let (mut level, mut at) = (0, row + 1);
        let mut low = loop {
            let (spans, span) = (spans(&self.lines[level]), at / SPAN);
            // No span follows a full last span, nor the only span of the topmost line.
            let Some(values) = spans.get(span) else { return self.rows - row - 1 };
            let lows = lows(values, bottom, floor) >> (at % SPAN);
            if lows != 0 {
                break at + lows.trailing_zeros() as usize;
            }
            if span + 1 == spans.len() {
                return self.rows - row - 1;
            }
            (level, at) = (level + 1, span + 1);
        };
        for line in self.lines[..level].iter().rev() {
            let lows = lows(&spans(line)[low], bottom, floor);
            low = low * SPAN + lows.trailing_zeros() as usize;
        }
        low - row - 1
    }

    /// Counts the rows before `row` down to the first that is not higher by more than `floor`.
    #[inline(always)]
    fn higher_before(&self, row: usize, floor: f64) -> usize {
        let bottom = self.lines[0][row];
        let (mut level, mut past) = (0, row);
        let mut low = loop {
            let Some(before) = past.checked_sub(1) else { return row };
            let span = before / SPAN;
            let lows =
                lows(&spans(&self.lines[level])[span], bottom, floor) << (SPAN - 1 - before % SPAN);
            if let Some(last) = (lows as u16).checked_ilog2() {
                break before - (SPAN - 1 - last as usize);
            }
            (level, past) = (level + 1, span);
        };
        for line in self.lines[..level].iter().rev() {
            let lows = lows(&spans(line)[low], bottom, floor);
            low = low * SPAN + lows.ilog2() as usize;
        }
        row - low - 1
    }
}

fn fill_up(line: &mut Vec<f64>) {
    line.resize(line.len().next_multiple_of(SPAN), f64::INFINITY);
}

fn spans(line: &[f64]) -> &[[f64; SPAN]] {
    line.as_chunks().0
}

/// Returns a bit for each value of a span that is not higher than `bottom` by more than `floor`. It looks at all of
/// them, because a processor cannot predict where the first one is.
#[inline(always)]
fn lows(values: &[f64; SPAN], bottom: f64, floor: f64) -> u32 {
    let bit = |at: usize| u32::from(values[at] - bottom <= floor) << at;
    (0..SPAN).fold(0, |bits, at| bits | bit(at))
}

/// Returns the least of some values. Lanes run side by side: in sequence each value would wait for the last.
#[inline(always)]
fn least(values: &[f64; SPAN]) -> f64 {
    let chunks = values.as_chunks::<LANES>().0;
    let low = chunks.iter().fold(Lanes::splat(f64::INFINITY), |low, next| low.min(Lanes(*next)));
    low.0.into_iter().fold(f64::INFINITY, f64::min)
}

/// Counts, for each row, the consecutive steps from it that each gain more than `floor`.
fn count_rising(values: &[f64], floor: f64, counts: &mut Vec<usize>) {
    counts.clear();
    counts.resize(values.len(), 0);
    let mut rising = 0;
    for row in (0..values.len().saturating_sub(1)).rev() {
        rising = if values[row + 1] - values[row] > floor { rising + 1 } else { 0 };
        counts[row] = rising;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn spans_find_what_counting_frame_by_frame_finds(
            speeds in prop_oneof![
                prop::collection::vec((0u8..6).prop_map(f64::from), 1..600),
                prop::collection::vec(0.0..9.0, 1..600),
                (1usize..600).prop_map(|n| (0..n).map(|at| at as f64).collect()),
            ],
            floor in prop_oneof![Just(0.0), Just(1.0), 0.0..3.0],
        ) {
            let mut persistence = Persistence::new();
            persistence.read(&[5.0; 700], 0.0, Side::Both);
            persistence.read(&speeds, floor, Side::Both);
            for (kind, sign) in [(TurnKind::Key, 1.0), (TurnKind::Wall, -1.0)] {
                for row in 0..speeds.len() {
                    let higher = |at: &usize| sign * speeds[*at] - sign * speeds[row] > floor;
                    let after = (row + 1..speeds.len()).take_while(higher).count();
                    let before = (0..row).rev().take_while(higher).count();
                    prop_assert_eq!(persistence.after(kind, row), after);
                    prop_assert_eq!(persistence.before(kind, row), before);
                }
            }
        }
    }
}
