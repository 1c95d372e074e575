//! The koma of a gait's drawings (歩き). Every step has the same rhythm, left and right.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;

use super::Spacing;
use crate::keys::{Phase, Walk};
use crate::maths::median;
use crate::time::Frame;
use crate::timing::on::{Pace, STAY};

/// A hair of a koma: instants nearer than this are one.
const HAIR: f64 = 1e-6;

/// The drawings of gaits on a sheet.
#[derive(Debug, Default)]
pub(super) struct Steps {
    /// The koma of each genga by the frame that it shows.
    koma: BTreeMap<Frame, usize>,
    /// The koma of each inbetween, and for how many it stays.
    inbetweens: BTreeMap<usize, usize>,
    /// Rows of steps without a gap, from the first contact to the last.
    rows: Vec<Steady>,
}

/// A row of steps without a gap.
#[derive(Debug, Clone, PartialEq)]
struct Steady {
    koma: Range<usize>,
    /// For how many koma a drawing stays at the least beside what is no step.
    least: usize,
}

impl Steps {
    /// The drawings of gaits on a sheet of so many koma.
    pub(super) fn of(walks: &[Walk], length: usize, spacing: &Spacing, pace: &Pace<'_>) -> Self {
        let mut steps = Self::default();
        for walk in walks {
            Placing::of(walk, spacing, pace).put(walk, length, &mut steps);
        }
        steps
    }

    /// The koma of the genga of a step that shows a frame.
    pub(super) fn koma(&self, frame: Frame) -> Option<usize> {
        self.koma.get(&frame).copied()
    }

    /// For how many koma the drawing of a koma stays at the least; none outside of gaits.
    pub(super) fn least(&self, koma: usize) -> Option<usize> {
        self.rows.iter().find(|row| row.koma.contains(&koma)).map(|row| row.least)
    }

    /// The inbetweens between two koma of one gait. For other koma there is no answer.
    pub(super) fn between(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let is_row = |row: &&Steady| row.koma.start <= from && from < to && to <= row.koma.end;
        self.rows.iter().find(is_row)?;
        let fits = |(koma, stay): &(&usize, &usize)| {
            let least = **stay.min(&&STAY);
            from + least <= **koma && **koma + least <= to
        };
        Some(self.inbetweens.range(from..to).filter(fits).map(|(koma, _)| *koma).collect())
    }

    /// The koma from the first contact to the last of each row of steps.
    pub(super) fn into_koma(self) -> Vec<Range<usize>> {
        self.rows.into_iter().map(|row| row.koma).collect()
    }

    fn add(&mut self, koma: Range<usize>, least: usize) {
        match self.rows.last_mut() {
            Some(last) if last.koma.end == koma.start && last.least == least => {
                last.koma.end = koma.end;
            }
            _ if koma.is_empty() => {}
            _ => self.rows.push(Steady { koma, least }),
        }
    }
}

/// How the steps of a gait are put on a sheet.
struct Placing {
    exposures: Exposures,
    /// Whether a genga comes on the earlier of the two koma that are nearest.
    comes_early: bool,
}

impl Placing {
    fn of(walk: &Walk, spacing: &Spacing, pace: &Pace<'_>) -> Self {
        let comes_early = spacing.on.stay() >= STAY;
        let rhythm =
            Rhythm { on: on(walk, comes_early, spacing, pace), inbetweens: spacing.inbetweens };
        Self { exposures: Exposures::of(&walk.shares, walk.koma, rhythm), comes_early }
    }

    /// Puts a gait's drawings on a sheet of so many koma.
    fn put(&self, walk: &Walk, length: usize, steps: &mut Steps) {
        let on_sheet = |koma: isize| usize::try_from(koma).ok().filter(|koma| *koma < length);
        for step in &walk.steps {
            let [begin, end] = [step.contact, step.next].map(|at| koma(at, self.comes_early));
            let mut at = begin;
            let mut begins = Vec::new();
            for exposure in self.exposures.of_step((end - begin).max(0) as usize) {
                begins.push(at);
                for (from, to) in exposure.cuts().skip(1) {
                    if let Some(koma) = on_sheet(at + from as isize) {
                        steps.inbetweens.insert(koma, to - from);
                    }
                }
                at += exposure.koma as isize;
            }
            for (frame, begin) in step.frames.iter().zip(begins.into_iter().chain([end])) {
                if let (Some(frame), Some(koma)) = (frame, on_sheet(begin)) {
                    steps.koma.insert(*frame, koma);
                }
            }
            let inside = |koma: isize| (koma.max(0) as usize).min(length);
            steps.add(inside(begin)..inside(end), self.exposures.rhythm.least());
        }
    }
}

/// The koma of an instant, before the sheet's first where the clip begins in a step.
fn koma(instant: f64, comes_early: bool) -> isize {
    let half = if comes_early { 0.0 } else { 0.5 };
    (instant + half + HAIR).floor() as isize
}

/// The nearest whole number of koma, of two the later.
fn nearest(koma: f64) -> usize {
    (koma + 0.5 + HAIR).floor().max(0.0) as usize
}

/// For how many koma a drawing of a gait stays: the median of all its koma. Where a step has room for four phases they are
/// no less than two, as its genga show the pace.
fn on(walk: &Walk, comes_early: bool, spacing: &Spacing, pace: &Pace<'_>) -> usize {
    let all = walk
        .steps
        .iter()
        .flat_map(|step| koma(step.contact, comes_early)..koma(step.next, comes_early));
    let all = all.filter_map(|koma| usize::try_from(koma).ok());
    let on =
        median(all.map(|koma| spacing.stay(koma, pace) as f64)).unwrap_or(0.0).floor() as usize;
    let least = if walk.phases.len() == Phase::MOST { spacing.on.stay() } else { 1 };
    on.max(least)
}

/// How many drawings a phase has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rhythm {
    /// For how many koma each stays, or a koma longer rather than that one stays for less than two.
    pub(super) on: usize,
    /// Inbetweens that are asked for instead.
    pub(super) inbetweens: Option<usize>,
}

impl Rhythm {
    /// For how many koma a drawing stays at the least.
    fn least(self) -> usize {
        self.on.min(STAY)
    }

    /// Drawings of so many koma.
    fn drawings(self, koma: usize) -> usize {
        let drawings = match (self.inbetweens, self.on) {
            (Some(asked), _) => (asked + 1).min(koma / self.least()),
            (None, 1) => koma,
            (None, on) => koma.saturating_sub(1).div_ceil(on),
        };
        drawings.max(1)
    }

    /// Drawings of so many koma where others like it have some: as many, if there is room; on ones one a koma.
    fn like(self, usual: usize, koma: usize) -> usize {
        match self {
            Self { on: 1, inbetweens: None } => self.drawings(koma),
            _ => usual.min(koma / self.least()).max(1),
        }
    }
}

/// For how long a phase stays, and in how many drawings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Exposed {
    koma: usize,
    drawings: usize,
}

impl Exposed {
    /// From when until when each drawing stays, as evenly as it goes, in koma from the first.
    fn cuts(self) -> impl Iterator<Item = (usize, usize)> {
        let cut = move |at: usize| (at * self.koma).div_ceil(self.drawings);
        (0..self.drawings).map(move |at| (cut(at), cut(at + 1)))
    }
}

/// For how many koma each phase of a step stays: a function of the length of the step alone.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Exposures {
    /// The exposures of the median step.
    usual: Vec<Exposed>,
    /// Phases by how much more than they have is theirs by their share of the step, the most first.
    order: Vec<usize>,
    rhythm: Rhythm,
}

impl Exposures {
    /// The exposures of a gait whose phases begin at some shares of a step of so many koma. Each stays for two koma at the
    /// least, where there is room.
    pub(super) fn of(shares: &[f64], koma: f64, rhythm: Rhythm) -> Self {
        let count = shares.len();
        let length = nearest(koma).max(count);
        let least = (length / count.max(1)).min(STAY);
        let mut begins = vec![0];
        for (phase, share) in shares.iter().enumerate().skip(1) {
            let earliest = begins[phase - 1] + least;
            let latest = length - least * (count - phase);
            begins.push(nearest(share * length as f64).clamp(earliest, latest));
        }
        let ends = begins.iter().skip(1).copied().chain([length]);
        let exposed = |koma| Exposed { koma, drawings: rhythm.drawings(koma) };
        let usual: Vec<_> =
            begins.iter().zip(ends).map(|(begin, end)| exposed(end - begin)).collect();
        let lacks = |phase: &usize| {
            let end = shares.get(phase + 1).copied().unwrap_or(1.0);
            (end - shares[*phase]) * length as f64 - usual[*phase].koma as f64
        };
        // Where a phase is half-way between others, two lack the same, and it is no rounding that tells them apart.
        let hairs = |phase: &usize| (lacks(phase) / HAIR).round() as i64;
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|phase| Reverse(hairs(phase)));
        Self { usual, order, rhythm }
    }

    /// Those of a step of so many koma. A koma more or less than usual goes to one phase, the next to the next: drawings
    /// that stay for the shortest take first, and those that stay for two koma give last.
    pub(super) fn of_step(&self, koma: usize) -> Vec<Exposed> {
        let mut step = self.usual.clone();
        let usual: usize = step.iter().map(|phase| phase.koma).sum();
        for _ in usual..koma {
            let phase = self.first_to_take(&step);
            step[phase].koma += 1;
        }
        for _ in koma..usual {
            let phase = self.first_to_give(&step);
            step[phase].koma -= 1;
        }
        for phase in &mut step {
            phase.drawings = self.rhythm.like(phase.drawings, phase.koma);
        }
        step
    }

    /// The phase of a step that takes a koma more first: one whose drawings stay for the shortest.
    fn first_to_take(&self, step: &[Exposed]) -> usize {
        let stays = |phase: usize| step[phase].koma as f64 / step[phase].drawings as f64;
        let shorter = |a: &&usize, b: &&usize| stays(**a).total_cmp(&stays(**b));
        self.order.iter().min_by(shorter).copied().unwrap_or_default()
    }

    /// The phase of a step that gives a koma first.
    fn first_to_give(&self, step: &[Exposed]) -> usize {
        let rank = |phase: &&usize| {
            let Exposed { koma, drawings } = step[**phase];
            let spares = koma > drawings * self.rhythm.least();
            (!spares, koma <= STAY, self.usual[**phase].koma - koma)
        };
        self.order.iter().rev().min_by_key(rank).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests;
