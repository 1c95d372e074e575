//! For how many frames in a row a joint stays faster, or slower, than at a given frame.

use super::{Side, TurnKind};

/// Four counts a row: how many frames after it, and before it, are all faster (which confirms a key)
/// or all slower (a wall), by more than the floor.
pub(super) struct Persistence {
    after: [Vec<usize>; 2],
    before: [Vec<usize>; 2],
    stack: Vec<usize>,
}

impl Persistence {
    pub(super) fn new(frames: usize) -> Self {
        let counts = || vec![0; frames];
        Self {
            after: [counts(), counts()],
            before: [counts(), counts()],
            stack: Vec::with_capacity(frames),
        }
    }

    /// Counts anew for another joint. With `rising` each frame after must be faster than the one
    /// before it; the frames before are counted for `both` alone.
    pub(super) fn read(&mut self, speeds: &[f64], floor: f64, side: Side) {
        for kind in [TurnKind::Key, TurnKind::Wall] {
            let gain = |from: usize, to: usize| match kind {
                TurnKind::Key => speeds[to] - speeds[from],
                TurnKind::Wall => speeds[from] - speeds[to],
            };
            let after = &mut self.after[kind as usize];
            if side == Side::Rising {
                count_rising(gain, floor, after);
            } else {
                count_faster(gain, floor, &mut self.stack, after);
            }
            if side == Side::Both {
                let last = speeds.len() - 1;
                let before = &mut self.before[kind as usize];
                count_faster(
                    |from, to| gain(last - from, last - to),
                    floor,
                    &mut self.stack,
                    before,
                );
                before.reverse();
            }
        }
    }

    /// How many frames after a row in a row confirm it as such a turn.
    pub(super) fn after(&self, kind: TurnKind, row: usize) -> usize {
        self.after[kind as usize][row]
    }

    /// How many frames before a row in a row confirm it as such a turn.
    pub(super) fn before(&self, kind: TurnKind, row: usize) -> usize {
        self.before[kind as usize][row]
    }
}

/// Of each row, the number of rows after it up to the first that does not gain more than `floor` on
/// it, or up to the end.
///
/// The stack holds the rows ahead that are lower than all rows between: the next one that does not
/// gain is always one of them. A row that does gain on this one is higher than it and so leaves the
/// stack for good, which keeps the whole search linear.
fn count_faster(
    gain: impl Fn(usize, usize) -> f64,
    floor: f64,
    stack: &mut Vec<usize>,
    counts: &mut [usize],
) {
    stack.clear();
    for row in (0..counts.len()).rev() {
        while stack.pop_if(|ahead| gain(row, *ahead) > floor).is_some() {}
        let next = stack.last().copied().unwrap_or(counts.len());
        counts[row] = next - row - 1;
        while stack.pop_if(|ahead| gain(row, *ahead) >= 0.0).is_some() {}
        stack.push(row);
    }
}

/// Of each row, the number of steps from it that each gain more than `floor`.
fn count_rising(gain: impl Fn(usize, usize) -> f64, floor: f64, counts: &mut [usize]) {
    let mut rising = 0;
    for row in (0..counts.len()).rev() {
        let goes_on = row + 1 < counts.len() && gain(row, row + 1) > floor;
        rising = if goes_on { rising + 1 } else { 0 };
        counts[row] = rising;
    }
}
