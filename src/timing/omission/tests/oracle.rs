//! A slow and obvious oracle: the stages as printed, with everything recomputed in every round.

use crate::timing::{Amount, Omission, Order, Stills};

/// A frame of the list that Algorithms 1 and 2 work on, or a drawing with its exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    pub(super) drawing: usize,
    pub(super) koma: usize,
    pub(super) kept: bool,
    /// Whether a movement begins and ends there: kept, and not a fill.
    pub(super) opens: bool,
}

/// The remaining (drawing, koma), the removed drawings in order, and the number of rounds done.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Outcome {
    pub(super) left: Vec<(usize, usize)>,
    pub(super) omitted: Vec<usize>,
    pub(super) taken: usize,
    pub(super) replaced: Vec<usize>,
}

/// The number asked of each stage, and the limits.
pub(super) struct Rules<'a> {
    pub(super) stills: &'a Stills,
    pub(super) naka_nashi: usize,
    pub(super) koma_dori: usize,
    pub(super) bound: usize,
    pub(super) keep_length: bool,
    pub(super) all_at_once: bool,
    pub(super) order: Order,
    pub(super) fast: f64,
    pub(super) small: f64,
}

impl<'a> Rules<'a> {
    pub(super) fn new(settings: &Omission, stills: &'a Stills, on: usize) -> Self {
        let count = |amount| match amount {
            Amount::Count(count) => count,
            Amount::Share(_) => panic!("the oracle wants counts"),
        };
        Self {
            stills,
            naka_nashi: count(settings.naka_nashi),
            koma_dori: count(settings.koma_dori),
            bound: settings.max_hold.max(2 * on),
            keep_length: settings.keep_length,
            all_at_once: settings.all_at_once,
            order: settings.order,
            fast: settings.fast,
            small: settings.small,
        }
    }

    pub(super) fn by_koma(&self, rows: &[Row]) -> Outcome {
        let frames = rows.iter().flat_map(|row| std::iter::repeat_n(row.drawing, row.koma));
        let counts = vec![0; rows.len()];
        let mut list = Frames {
            rules: self,
            frames: frames.collect(),
            last: rows.len().saturating_sub(1),
            duplicated: counts.clone(),
            copied: counts,
            outcome: Outcome::default(),
        };
        match self.order {
            Order::NakaNashiFirst => (list.algorithm_1(), list.algorithm_2()),
            Order::KomaDoriFirst => (list.algorithm_2(), list.algorithm_1()),
        };
        list.outcome()
    }

    pub(super) fn by_drawing(&self, rows: &[Row]) -> Outcome {
        let mut keyed = Keyed {
            rules: self,
            rows: rows.to_vec(),
            lengthened: vec![0; rows.len()],
            held: vec![0; rows.len()],
            fast: 0.0,
            slow: Vec::new(),
            outcome: Outcome::default(),
        };
        match self.order {
            Order::NakaNashiFirst => (keyed.naka_nashi(), keyed.koma_dori()),
            Order::KomaDoriFirst => (keyed.koma_dori(), keyed.naka_nashi()),
        };
        keyed.outcome.left = keyed.rows.iter().map(|row| (row.drawing, row.koma)).collect();
        keyed.outcome
    }
}

fn first_max(values: impl Iterator<Item = (usize, f64)>) -> Option<(usize, f64)> {
    values.fold(None, |best, (at, value)| match best {
        Some((_, most)) if value <= most => best,
        _ => Some((at, value)),
    })
}

fn first_min(values: impl Iterator<Item = (usize, f64)>) -> Option<usize> {
    first_max(values.map(|(at, value)| (at, -value))).map(|(at, _)| at)
}

/// A list of frames, each the number of its drawing: Algorithms 1 and 2 to the letter, except that the first and the
/// last drawing stay and a held drawing is never copied over.
struct Frames<'a> {
    rules: &'a Rules<'a>,
    frames: Vec<usize>,
    last: usize,
    duplicated: Vec<usize>,
    copied: Vec<usize>,
    outcome: Outcome,
}

impl Frames<'_> {
    fn ssd(&self, k: usize) -> f64 {
        self.rules.stills.ssd(self.frames[k - 1], self.frames[k])
    }

    fn run(&self, drawing: usize) -> usize {
        self.frames.iter().filter(|&&frame| frame == drawing).count()
    }

    /// Whether k − 1 may be duplicated: fewer than 3 times so far, and the hold stays within the bound.
    fn may_grow(&self, drawing: usize) -> bool {
        drawing != self.last && self.duplicated[drawing] < 3 && self.run(drawing) < self.rules.bound
    }

    /// Returns the frames that may be deleted: all but those of the first and the last drawing.
    fn inner(&self) -> impl Iterator<Item = usize> + '_ {
        (1..self.frames.len())
            .filter(|&k| self.frames[k] != self.frames[0] && self.frames[k] != self.last)
    }

    fn duplicate_slowest(&mut self) -> bool {
        let growing = (1..self.frames.len()).filter(|&k| self.may_grow(self.frames[k - 1]));
        let Some(k_min) = first_min(growing.map(|k| (k, self.ssd(k)))) else { return false };
        let drawing = self.frames[k_min - 1];
        self.frames.insert(k_min, drawing);
        self.duplicated[drawing] += 1;
        true
    }

    fn algorithm_1(&mut self) {
        if self.rules.all_at_once {
            return self.all_at_once();
        }
        let mut no_candidate = vec![false; self.duplicated.len()];
        for _ in 0..self.rules.naka_nashi {
            loop {
                let free = self.inner().filter(|&k| !no_candidate[self.frames[k]]);
                let fastest = first_max(free.map(|k| (k, self.ssd(k))));
                let Some((k_max, _)) = fastest.filter(|(_, ssd)| *ssd > 0.0) else { return };
                let drawing = self.frames.remove(k_max);
                if self.rules.keep_length && !self.duplicate_slowest() {
                    self.frames.insert(k_max, drawing);
                    no_candidate[drawing] = true;
                    continue;
                }
                self.note_deletion(drawing);
                break;
            }
        }
    }

    fn note_deletion(&mut self, drawing: usize) {
        self.outcome.taken += 1;
        if self.run(drawing) == 0 {
            self.outcome.omitted.push(drawing);
        }
    }

    /// Deletes the frames with the largest initial distances, then duplicates (§3.4).
    fn all_at_once(&mut self) {
        let mut ranked: Vec<(usize, f64)> = self
            .inner()
            .map(|k| (self.frames[k], self.ssd(k)))
            .filter(|(_, ssd)| *ssd > 0.0)
            .collect();
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut owed = 0;
        for (drawing, _) in ranked {
            if self.outcome.taken == self.rules.naka_nashi {
                break;
            }
            let k = self.frames.iter().position(|&frame| frame == drawing).unwrap();
            self.frames.remove(k);
            if self.rules.keep_length && self.capacity() < owed + 1 {
                self.frames.insert(k, drawing);
                continue;
            }
            owed += 1;
            self.note_deletion(drawing);
        }
        for _ in 0..if self.rules.keep_length { owed } else { 0 } {
            assert!(self.duplicate_slowest());
        }
    }

    fn capacity(&self) -> usize {
        let drawings = (0..self.last).filter(|&drawing| self.run(drawing) > 0);
        let room = |drawing| {
            let to_bound = self.rules.bound.saturating_sub(self.run(drawing));
            usize::min(3 - self.duplicated[drawing], to_bound)
        };
        drawings.map(room).sum()
    }

    fn algorithm_2(&mut self) {
        for _ in 0..self.rules.koma_dori {
            let single = self.inner().filter(|&k| {
                let (before, own) = (self.frames[k - 1], self.frames[k]);
                before != own
                    && self.duplicated[own] == 0
                    && self.copied[own] == 0
                    && self.run(before) < self.rules.bound
            });
            let Some(k_min) = first_min(single.map(|k| (k, self.ssd(k)))) else { return };
            self.outcome.replaced.push(self.frames[k_min]);
            self.frames[k_min] = self.frames[k_min - 1];
            self.copied[self.frames[k_min]] += 1;
        }
    }

    fn outcome(mut self) -> Outcome {
        assert!(self.frames.is_sorted(), "a drawing's frames stand together");
        let runs = self.frames.chunk_by(|a, b| a == b).map(|run| (run[0], run.len()));
        self.outcome.left = runs.collect();
        self.outcome
    }
}

/// Drawings with longer exposures, which are removed as a whole and stay between their kept drawings.
struct Keyed<'a> {
    rules: &'a Rules<'a>,
    rows: Vec<Row>,
    lengthened: Vec<usize>,
    held: Vec<usize>,
    /// The SSD of markedly fast movement.
    fast: f64,
    /// Whether the body is slow at each drawing.
    slow: Vec<bool>,
    outcome: Outcome,
}

impl Keyed<'_> {
    fn ssd(&self, at: usize) -> f64 {
        self.rules.stills.ssd(self.rows[at - 1].drawing, self.rows[at].drawing)
    }

    /// Returns the drawing from which the movement at `at` starts.
    fn opener(&self, at: usize) -> usize {
        (0..=at).rev().find(|&at| self.rows[at].opens).unwrap()
    }

    fn fits(&self, at: usize, owed: usize) -> bool {
        let opener = self.rows[self.opener(at)].drawing;
        self.slow[opener] && self.lengthened[opener] + owed + self.rows[at].koma <= 3
    }

    fn give(&mut self, within: usize, koma: usize) {
        let opener = self.opener(within);
        self.rows[opener].koma += koma;
        self.lengthened[self.rows[opener].drawing] += koma;
    }

    /// Computes the median of the moving steps, before any omission.
    fn measure(&mut self) {
        let steps = (1..self.rows.len()).map(|at| self.ssd(at).sqrt());
        let mut steps: Vec<f64> = steps.filter(|step| *step > 0.0).collect();
        steps.sort_by(f64::total_cmp);
        let median = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
        self.fast = (self.rules.fast * median).powi(2);
        let count = self.rows.len();
        let step = |at: usize| if at == 0 || at == count { 0.0 } else { self.ssd(at) };
        let mut slow = vec![false; self.lengthened.len()];
        for at in 0..count {
            slow[self.rows[at].drawing] = step(at).min(step(at + 1)).sqrt() <= median;
        }
        self.slow = slow;
    }

    fn omit(&mut self, at: usize) -> usize {
        let row = self.rows.remove(at);
        self.outcome.taken += 1;
        self.outcome.omitted.push(row.drawing);
        row.koma
    }

    fn naka_nashi(&mut self) {
        self.measure();
        if self.rules.all_at_once {
            return self.all_at_once();
        }
        for _ in 0..self.rules.naka_nashi {
            let free = (0..self.rows.len())
                .filter(|&at| !self.rows[at].kept && (!self.rules.keep_length || self.fits(at, 0)));
            let fastest = first_max(free.map(|at| (at, self.ssd(at))));
            let is_fast = |(_, ssd): &(usize, f64)| *ssd > 0.0 && *ssd >= self.fast;
            let Some((at, _)) = fastest.filter(is_fast) else { return };
            let koma = self.omit(at);
            if self.rules.keep_length {
                self.give(at - 1, koma);
            }
        }
    }

    fn all_at_once(&mut self) {
        let free = (0..self.rows.len()).filter(|&at| !self.rows[at].kept);
        let mut ranked: Vec<(usize, f64)> =
            free.map(|at| (self.rows[at].drawing, self.ssd(at))).collect();
        ranked.retain(|(_, ssd)| *ssd > 0.0 && *ssd >= self.fast);
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        // The koma owed to the drawing that opens the interval.
        let mut owed = vec![0; self.lengthened.len()];
        for (drawing, _) in ranked {
            if self.outcome.taken == self.rules.naka_nashi {
                break;
            }
            let at = self.rows.iter().position(|row| row.drawing == drawing).unwrap();
            let opener = self.rows[self.opener(at)].drawing;
            if !self.rules.keep_length {
                self.omit(at);
            } else if self.fits(at, owed[opener]) {
                owed[opener] += self.omit(at);
            }
        }
        for (opener, koma) in owed.into_iter().enumerate().filter(|(_, koma)| *koma > 0) {
            let at = self.rows.iter().position(|row| row.drawing == opener).unwrap();
            self.give(at, koma);
        }
    }

    fn koma_dori(&mut self) {
        for _ in 0..self.rules.koma_dori {
            let free = (1..self.rows.len()).filter(|&at| {
                let Row { drawing, koma, kept, .. } = self.rows[at];
                !kept
                    && self.lengthened[drawing] == 0
                    && self.held[drawing] == 0
                    && self.rows[at - 1].koma + koma <= self.rules.bound
            });
            let Some(at) = first_min(free.map(|at| (at, self.ssd(at)))) else { return };
            // Two joints, and a body of height 100.
            if self.ssd(at) > 2.0 * self.rules.small.powi(2) {
                return;
            }
            let row = self.rows.remove(at);
            self.outcome.replaced.push(row.drawing);
            self.rows[at - 1].koma += row.koma;
            self.held[self.rows[at - 1].drawing] += 1;
        }
    }
}
