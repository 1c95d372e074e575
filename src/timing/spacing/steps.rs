//! The koma of a gait's drawings (歩き). Every step, left or right, has the same rhythm.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;

use super::Spacing;
use crate::keys::{Phase, Taken, Walk, WalkStep};
use crate::maths::median;
use crate::time::Frame;
use crate::timing::ByPassage;
use crate::timing::koma_per_drawing::{Pace, STAY};

/// Instants closer than this, in koma, are equal.
const HAIR: f64 = 1e-6;

/// Koma that a contact may stand from its place, so that its step is as long as the others.
const ONE: f64 = 1.0 - HAIR;

/// The drawings of gaits on a sheet.
#[derive(Debug, Default)]
pub(super) struct Steps {
    /// The koma of each genga, by the frame that it shows.
    koma: BTreeMap<Frame, usize>,
    /// The koma of each inbetween, with the number of koma that it stays.
    inbetweens: BTreeMap<usize, usize>,
    /// Gapless rows of steps, from the first contact to the last.
    rows: Vec<Steady>,
}

/// A gapless row of steps.
#[derive(Debug, Clone, PartialEq)]
struct Steady {
    koma: Range<usize>,
    /// Fewest koma that a drawing stays next to a drawing that is not a step.
    least: usize,
}

impl Steps {
    /// Lays out the drawings of gaits on a sheet of `length` koma. A step is spaced as at its contact.
    pub(super) fn new(
        walks: &[Walk],
        length: usize,
        spacing: &ByPassage<Spacing>,
        pace: &Pace<'_>,
    ) -> Self {
        let mut steps = Self::default();
        // The last contact on the sheet: a gait that begins with it begins there.
        let mut before = None;
        for walk in walks {
            let placing = spacing.map(|own| Placing::new(walk, own, pace));
            for step in &walk.steps {
                let own = placing.at(nearest(step.contact));
                let koma = own.koma_of_step(step, nearest(walk.koma), &mut before);
                let is_one = |koma: &Range<usize>| spacing.is_one(koma.start, koma.end);
                own.put((step, koma), (length, is_one), &mut steps);
            }
        }
        steps
    }

    /// Returns the koma of the genga of a step that shows a frame.
    pub(super) fn koma(&self, frame: Frame) -> Option<usize> {
        self.koma.get(&frame).copied()
    }

    /// Returns the fewest koma that the drawing of a koma stays; `None` outside gaits.
    pub(super) fn least(&self, koma: usize) -> Option<usize> {
        self.rows.iter().find(|row| row.koma.contains(&koma)).map(|row| row.least)
    }

    /// Returns the inbetweens between two koma of one gait; `None` for other koma.
    pub(super) fn between(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let is_row = |row: &&Steady| row.koma.start <= from && from < to && to <= row.koma.end;
        self.rows.iter().find(is_row)?;
        let fits = |(koma, stay): &(&usize, &usize)| {
            let least = **stay.min(&&STAY);
            from + least <= **koma && **koma + least <= to
        };
        Some(self.inbetweens.range(from..to).filter(fits).map(|(koma, _)| *koma).collect())
    }

    /// Returns the koma of each row of steps, from the first contact to the last.
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

/// The rules for putting the steps of a gait on a sheet.
struct Placing {
    exposures: Exposures,
    /// Whether a genga goes on the earlier of the two nearest koma.
    comes_early: bool,
}

impl Placing {
    fn new(walk: &Walk, spacing: &Spacing, pace: &Pace<'_>) -> Self {
        let comes_early = spacing.on.stay() >= STAY;
        let rhythm =
            Rhythm { on: on(walk, comes_early, spacing, pace), inbetweens: spacing.inbetweens };
        Self { exposures: Exposures::new(&walk.shares, walk.koma, rhythm), comes_early }
    }

    /// Returns the koma of a step. As long as a contact stays within a koma of its place, all steps are `usual` koma
    /// long: rounded one by one, steps of 12.4 and 13.3 koma would become 12 and 14.
    ///
    /// `before` is the contact before the step, and becomes its last: its time and its koma.
    fn koma_of_step(
        &self,
        step: &WalkStep,
        usual: usize,
        before: &mut Option<(f64, isize)>,
    ) -> Range<isize> {
        let begin = match *before {
            Some((next, end)) if (next - step.contact).abs() < HAIR => end,
            _ => koma(step.contact, self.comes_early),
        };
        let centre = if self.comes_early { 0.5 } else { 0.0 };
        let usual = begin + usual as isize;
        let is_near = (usual as f64 + centre - step.next).abs() < ONE;
        let end = if is_near { usual } else { koma(step.next, self.comes_early) };
        *before = Some((step.next, end));
        begin..end
    }

    /// Puts the drawings of a step on a sheet of `length` koma; `koma` are those of the step. In a step with other
    /// settings in its midst (not `is_one`), only the genga are those of all steps.
    fn put(
        &self,
        (step, Range { start: begin, end }): (&WalkStep, Range<isize>),
        (length, is_one): (usize, impl Fn(&Range<usize>) -> bool),
        steps: &mut Steps,
    ) {
        if step.has_no_phase {
            return;
        }
        let on_sheet = |koma: isize| usize::try_from(koma).ok().filter(|koma| *koma < length);
        let inside = |koma: isize| (koma.max(0) as usize).min(length);
        let whole = inside(begin)..inside(end);
        let is_steady = is_one(&whole);
        let mut at = begin;
        let mut begins = Vec::new();
        let exposures = self.exposures.of_step((end - begin).max(0) as usize);
        debug_assert!(exposures.len() < step.taken.len() && step.taken.len() == step.frames.len());
        for (exposure, taken) in exposures.into_iter().zip(&step.taken) {
            begins.push(at);
            // An inbetween takes the place of a genga that is taken away.
            for (from, to) in exposure.cuts().skip(usize::from(*taken != Some(Taken::Gone))) {
                if let Some(koma) = on_sheet(at + from as isize) {
                    steps.inbetweens.insert(koma, to - from);
                }
            }
            at += exposure.koma as isize;
        }
        let shown = step.frames.iter().zip(&step.taken).map(|(frame, taken)| match taken {
            Some(Taken::By(set)) => Some(*set),
            _ => *frame,
        });
        for (frame, begin) in shown.zip(begins.into_iter().chain([end])) {
            if let (Some(frame), Some(koma)) = (frame, on_sheet(begin)) {
                steps.koma.insert(frame, koma);
            }
        }
        if is_steady {
            steps.add(whole, self.exposures.rhythm.least());
        }
    }
}

/// Returns the koma of an instant; negative if the clip begins in the middle of a step.
fn koma(instant: f64, comes_early: bool) -> isize {
    let half = if comes_early { 0.0 } else { 0.5 };
    (instant + half + HAIR).floor() as isize
}

/// Rounds to the nearest whole number of koma, up on a tie.
fn nearest(koma: f64) -> usize {
    (koma + 0.5 + HAIR).floor().max(0.0) as usize
}

/// Returns how many koma a drawing of a gait stays: the median over all its koma. If a step has room for *down* or *up*,
/// that is at least two, as its genga show the pace.
fn on(walk: &Walk, comes_early: bool, spacing: &Spacing, pace: &Pace<'_>) -> usize {
    let all = walk
        .steps
        .iter()
        .flat_map(|step| koma(step.contact, comes_early)..koma(step.next, comes_early));
    let all = all.filter_map(|koma| usize::try_from(koma).ok());
    let on =
        median(all.map(|koma| spacing.stay(koma, pace) as f64)).unwrap_or(0.0).floor() as usize;
    let shows_pace = [Phase::Down, Phase::Up].iter().any(|phase| walk.phases.contains(phase));
    let least = if shows_pace { spacing.on.stay() } else { 1 };
    on.max(least)
}

/// The rule for the number of drawings in a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rhythm {
    /// Number of koma that each drawing stays. It grows by one koma if the last would otherwise stay for less than two.
    pub(super) on: usize,
    /// A fixed number of inbetweens instead.
    pub(super) inbetweens: Option<usize>,
}

impl Rhythm {
    /// Returns the fewest koma that a drawing stays.
    fn least(self) -> usize {
        self.on.min(STAY)
    }

    /// Returns the number of drawings in `koma` koma.
    fn drawings(self, koma: usize) -> usize {
        let drawings = match (self.inbetweens, self.on) {
            (Some(asked), _) => (asked + 1).min(koma / self.least()),
            (None, 1) => koma,
            (None, on) => koma.saturating_sub(1).div_ceil(on),
        };
        drawings.max(1)
    }

    /// Returns the number of drawings in `koma` koma if similar phases have `usual`: the same number if there is room;
    /// on ones, one per koma.
    fn like(self, usual: usize, koma: usize) -> usize {
        match self {
            Self { on: 1, inbetweens: None } => self.drawings(koma),
            _ => usual.min(koma / self.least()).max(1),
        }
    }
}

/// The length of a phase and its number of drawings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Exposed {
    koma: usize,
    drawings: usize,
}

impl Exposed {
    /// Returns the begin and end of each drawing in koma from the first, as evenly as possible.
    fn cuts(self) -> impl Iterator<Item = (usize, usize)> {
        let cut = move |at: usize| (at * self.koma).div_ceil(self.drawings);
        (0..self.drawings).map(move |at| (cut(at), cut(at + 1)))
    }
}

/// The length of each phase of a step, which depends only on the length of the step.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Exposures {
    /// The exposures of the median step.
    usual: Vec<Exposed>,
    /// The phases in the order of their deficit: how much shorter they are than their share of the step, largest first.
    order: Vec<usize>,
    rhythm: Rhythm,
}

impl Exposures {
    /// Computes the exposures of a gait whose phases begin at `shares` of a step of `koma` koma. Each phase stays for
    /// at least two koma if there is room.
    pub(super) fn new(shares: &[f64], koma: f64, rhythm: Rhythm) -> Self {
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
        // If a phase is half-way between others, two have the same deficit, and rounding errors must not decide between
        // them.
        let hairs = |phase: &usize| (lacks(phase) / HAIR).round() as i64;
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|phase| Reverse(hairs(phase)));
        Self { usual, order, rhythm }
    }

    /// Returns the exposures of a step of `koma` koma. Koma beyond or short of the usual length go to one phase each:
    /// phases with the shortest drawings take first, and phases of two koma give last.
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

    /// Returns the phase that takes an extra koma first: one whose drawings are the shortest.
    fn first_to_take(&self, step: &[Exposed]) -> usize {
        let stays = |phase: usize| step[phase].koma as f64 / step[phase].drawings as f64;
        let shorter = |a: &&usize, b: &&usize| stays(**a).total_cmp(&stays(**b));
        self.order.iter().min_by(shorter).copied().unwrap_or_default()
    }

    /// Returns the phase that gives up a koma first.
    fn first_to_give(&self, step: &[Exposed]) -> usize {
        let rank = |phase: &&usize| {
            let Exposed { koma, drawings } = step[**phase];
            let spares = koma > drawings * self.rhythm.least();
            (!spares, koma <= STAY, STAY - koma.min(STAY), self.usual[**phase].koma - koma)
        };
        self.order.iter().rev().min_by_key(rank).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests;
