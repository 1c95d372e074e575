//! Finds valleys and hills of the speed: where a movement starts, ends, or only slows down.
//!
//! This is not the paper's rule: read to the letter, it loses most ends of movements (動き終わり), because no frame after an
//! end is faster.

use std::cmp::Ordering::{self, Greater, Less};

use super::{Scan, Turn, TurnKind};
use crate::time::KOMA_RATE;

/// Seconds below which a valley or hill is one turn: two drawings nearer than that would share a koma or stand side by
/// side.
const SHORT: f64 = 2.0 / KOMA_RATE;

/// Finds the turns of every valley (keys) and hill (walls), with the filter's delay undone.
#[inline(always)]
pub(super) fn turns(scan: &Scan, speeds: &[f64], turns: &mut Vec<Turn>) {
    let (mut begin, mut entry) = (0, None);
    for (step, &sign) in scan.signs.iter().enumerate().filter(|(_, sign)| sign.is_ne()) {
        // Otherwise it is a pause inside an acceleration, or just another step of it.
        if entry != Some(sign) {
            Run { begin, end: step }.read(entry, Some(sign), scan, speeds, turns);
        }
        (begin, entry) = (step + 1, Some(sign));
    }
    Run { begin, end: scan.frames - 1 }.read(entry, None, scan, speeds, turns);
}

/// The longest run of rows `begin..=end` with only steady steps between them.
#[derive(Clone, Copy)]
struct Run {
    begin: usize,
    end: usize,
}

impl Run {
    /// Finds turns from the steps into the run and out of it; `None` if the run touches the clip's edge there.
    #[inline(always)]
    fn read(
        self,
        entry: Option<Ordering>,
        exit: Option<Ordering>,
        scan: &Scan,
        speeds: &[f64],
        turns: &mut Vec<Turn>,
    ) {
        match (entry, exit) {
            (Some(Less), Some(Greater)) => self.between(scan, TurnKind::Key, speeds, turns),
            (Some(Greater), Some(Less)) => self.between(scan, TurnKind::Wall, speeds, turns),
            (None, Some(Greater)) => turns.extend(self.start(scan, TurnKind::Key)),
            (None, Some(Less)) => turns.extend(self.start(scan, TurnKind::Wall)),
            (Some(Less), None) => turns.extend(self.finish(scan, TurnKind::Key)),
            (Some(Greater), None) => turns.extend(self.finish(scan, TurnKind::Wall)),
            // The joint is steady throughout.
            _ => {}
        }
    }

    #[inline(always)]
    fn between(self, scan: &Scan, kind: TurnKind, speeds: &[f64], turns: &mut Vec<Turn>) {
        if (self.end - self.begin) as f64 / scan.fps < SHORT {
            let (first, last) = self.extreme(kind, speeds, scan.floor);
            let confirmed_for = before(scan, kind, first).min(after(scan, kind, last));
            turns.push(scan.turn(first, kind, confirmed_for));
        } else {
            turns.extend(self.finish(scan, kind));
            turns.extend(self.start(scan, kind));
        }
    }

    /// Returns the end of the movement before the run. The filter found it late, and its speed is that of the step into
    /// the frame. `None` on the clip's last frame.
    #[inline(always)]
    fn finish(self, scan: &Scan, kind: TurnKind) -> Option<Turn> {
        let moved = self.begin.saturating_sub(scan.delay + 1);
        let inside = self.begin < scan.frames - 1;
        inside.then(|| scan.turn(moved, kind, before(scan, kind, self.begin)))
    }

    /// Returns the start of the movement after the run, which the filter found early. `None` on the clip's first frame.
    #[inline(always)]
    fn start(self, scan: &Scan, kind: TurnKind) -> Option<Turn> {
        let moved = self.end + scan.delay;
        (self.end > 0).then(|| scan.turn(moved, kind, after(scan, kind, self.end)))
    }

    /// Returns the first and the last of the slowest rows for a key, of the fastest for a wall. A short hold has
    /// several, which differ only by rounding. If they counted against each other, no such hold would ever be
    /// confirmed.
    fn extreme(self, kind: TurnKind, speeds: &[f64], floor: f64) -> (usize, usize) {
        if self.begin == self.end {
            return (self.begin, self.end);
        }
        let height = |row: usize| match kind {
            TurnKind::Key => speeds[row],
            TurnKind::Wall => -speeds[row],
        };
        let lowest = (self.begin..=self.end).map(height).fold(f64::INFINITY, f64::min);
        let is_lowest = |row: &usize| height(*row) - lowest <= floor;
        let first = (self.begin..=self.end).find(is_lowest).unwrap_or(self.begin);
        let last = (self.begin..=self.end).rfind(is_lowest).unwrap_or(self.end);
        (first, last)
    }
}

/// Counts the frames after a row that confirm it; reaching the clip's end counts as the whole clip.
#[inline(always)]
fn after(scan: &Scan, kind: TurnKind, row: usize) -> usize {
    let frames = scan.persistence.after(kind, row);
    if frames == scan.frames - 1 - row { scan.frames } else { frames }
}

/// Counts the frames before a row that confirm it; reaching the clip's begin counts as the whole clip.
#[inline(always)]
fn before(scan: &Scan, kind: TurnKind, row: usize) -> usize {
    let frames = scan.persistence.before(kind, row);
    if frames == row { scan.frames } else { frames }
}
