//! Naka-nashi (中無し): leaving out the inbetweens of the fastest movement (KKMFT §3.2, Algorithm 1).

use std::ops::Range;

use crate::timing::drawing_list::{Strip, room_of};
use crate::timing::report::Shortfall;
use crate::timing::tournament::{OUT, Tournament};

/// The rules of the stage.
pub(super) struct NakaNashi {
    /// How much to leave out of each action.
    pub(super) quotas: Vec<Quota>,
}

/// How much to leave out of an action, or of its part that has settings of its own.
pub(super) struct Quota {
    /// The drawings of the part.
    pub(super) drawings: Vec<Range<usize>>,
    /// Number of drawings to leave out; of koma, on a sheet on ones without genga.
    pub(super) count: usize,
    /// Whether that number was asked for. A share is an upper bound.
    pub(super) is_count: bool,
    /// The median step of the action's drawings.
    pub(super) usual: f64,
    /// The SSD from which on a movement is markedly fast.
    pub(super) fast: f64,
    /// Whether the freed koma are given to other drawings.
    pub(super) keep_length: bool,
    /// Whether all drawings are chosen by the initial distances.
    pub(super) all_at_once: bool,
}

/// The result of the stage.
#[derive(Default)]
pub(super) struct Taken {
    pub(super) done: usize,
    /// The removed drawings, in the order they went.
    pub(super) gone: Vec<usize>,
    /// Number of koma given to other drawings.
    pub(super) given: usize,
    pub(super) shortfall: Option<Shortfall>,
}

impl NakaNashi {
    /// Returns the number of drawings to leave out of all actions together.
    pub(super) fn count(&self) -> usize {
        self.quotas.iter().fold(0, |sum, quota| sum.saturating_add(quota.count))
    }

    /// Leaves drawings out, the fastest of each action first, and gives their koma to those of the interval that have
    /// [room](Strip::room), the slowest first.
    pub(super) fn run(&self, strip: &mut Strip<'_>) -> Taken {
        if self.count() == 0 {
            return Taken::default();
        }
        let mut stage = Stage::new(strip);
        for quota in &self.quotas {
            stage.fill(quota);
        }
        for interval in 0..stage.owed.len() {
            stage.settle(interval);
        }
        stage.taken
    }
}

struct Stage<'a, 'b> {
    strip: &'a mut Strip<'b>,
    /// Inbetweens that may go, by −SSD to the one before.
    fastest: Tournament,
    /// Drawings that may be lengthened, by SSD to the one after.
    slowest: Tournament,
    /// Number of koma that the drawings of each interval can still take.
    room: Vec<usize>,
    /// Number of koma freed in each interval and not given away yet.
    owed: Vec<usize>,
    /// Inbetweens that did not fit. They never will, as the room of an interval only shrinks.
    barred: Vec<bool>,
    taken: Taken,
}

impl<'a, 'b> Stage<'a, 'b> {
    fn new(strip: &'a mut Strip<'b>) -> Self {
        let count = strip.links.len();
        let live = |drawing: &usize| strip.links[*drawing].koma > 0;
        let room = |range: &Range<usize>| {
            range.clone().filter(live).map(|drawing| strip.room(drawing)).sum()
        };
        let speed = |drawing: usize| match &strip.links[drawing] {
            link if link.kept || link.koma == 0 => OUT,
            link => -link.step,
        };
        let slowness = |drawing| if live(&drawing) { slowness(strip, drawing) } else { OUT };
        Self {
            fastest: Tournament::new((0..count).map(speed)),
            slowest: Tournament::new((0..count).map(slowness)),
            room: strip.intervals.iter().map(room).collect(),
            owed: vec![0; strip.intervals.len()],
            barred: vec![false; count],
            taken: Taken::default(),
            strip,
        }
    }

    /// Leaves out what is asked of an action, or as much as can go.
    fn fill(&mut self, quota: &Quota) {
        let enough = self.taken.done.saturating_add(quota.count);
        while self.taken.done < enough {
            let shortfall = match best(&self.fastest, &quota.drawings) {
                None => self.nothing_left(&quota.drawings),
                Some((_, 0.0)) => Shortfall::NoMotion,
                Some((_, speed)) if -speed < quota.fast => self.none_fast(&quota.drawings),
                Some((drawing, _)) => {
                    self.take_if_it_fits(drawing, quota);
                    continue;
                }
            };
            // Of several actions, the first with inbetweens gives the reason.
            if quota.is_count {
                self.taken.shortfall = Some(shortfall.after(self.taken.shortfall));
            }
            break;
        }
    }

    fn take_if_it_fits(&mut self, drawing: usize, rules: &Quota) {
        if rules.keep_length && !self.fits(drawing) {
            self.barred[drawing] = true;
            self.fastest.set(drawing, OUT);
            return;
        }
        let interval = self.strip.links[drawing].interval;
        let freed = match self.stays(drawing) {
            true => self.shorten(drawing, rules),
            false => self.omit(drawing, rules),
        };
        self.taken.done += 1;
        if rules.keep_length {
            self.owed[interval] += freed;
        }
        if !rules.all_at_once {
            self.settle(interval);
        }
    }

    /// Whether a drawing loses a koma and stays.
    fn stays(&self, drawing: usize) -> bool {
        self.strip.by_koma && self.strip.links[drawing].koma > 1
    }

    /// Whether the koma freed by a drawing find room in its interval.
    fn fits(&self, drawing: usize) -> bool {
        let link = &self.strip.links[drawing];
        let others = self.room[link.interval] - self.strip.room(drawing);
        let (freed, own) = if self.stays(drawing) {
            (1, room_of(link.given, link.koma - 1, link.bound))
        } else {
            (link.koma, 0)
        };
        others + own >= self.owed[link.interval] + freed
    }

    /// Takes one koma from a drawing, as Algorithm 1 does with the first of several equal frames.
    fn shorten(&mut self, drawing: usize, rules: &Quota) -> usize {
        let before = self.strip.room(drawing);
        let link = &mut self.strip.links[drawing];
        link.koma -= 1;
        link.taken += 1;
        let interval = link.interval;
        self.room[interval] = self.room[interval] - before + self.strip.room(drawing);
        self.slowest.set(drawing, slowness(self.strip, drawing));
        if rules.all_at_once {
            self.fastest.set(drawing, OUT);
        }
        1
    }

    /// Removes a whole drawing.
    fn omit(&mut self, drawing: usize, rules: &Quota) -> usize {
        let link = &self.strip.links[drawing];
        let (before, after) = (link.before, link.after);
        self.room[link.interval] -= self.strip.room(drawing);
        let freed = self.strip.remove(drawing);
        self.strip.links[after].omitted_before += 1;
        self.taken.gone.push(drawing);
        self.fastest.set(drawing, OUT);
        self.slowest.set(drawing, OUT);
        self.slowest.set(before, slowness(self.strip, before));
        let next = &self.strip.links[after];
        if !(rules.all_at_once || next.kept || self.barred[after]) {
            self.fastest.set(after, -next.step);
        }
        freed
    }

    /// Gives the koma owed to an interval to its slowest drawings, one by one.
    fn settle(&mut self, interval: usize) {
        while self.owed[interval] > 0 {
            let slowest = self.slowest.best_in(self.strip.intervals[interval].clone());
            let (drawing, _) = slowest.expect("what does not fit is not taken");
            let link = &mut self.strip.links[drawing];
            link.koma += 1;
            link.given += 1;
            self.room[interval] -= 1;
            self.owed[interval] -= 1;
            self.taken.given += 1;
            self.slowest.set(drawing, slowness(self.strip, drawing));
        }
    }

    fn nothing_left(&self, drawings: &[Range<usize>]) -> Shortfall {
        let has = |drawing: usize| drawings.iter().any(|range| range.contains(&drawing));
        if self.any_barred(drawings) { Shortfall::NoRoom } else { self.strip.none_left(has) }
    }

    fn none_fast(&self, drawings: &[Range<usize>]) -> Shortfall {
        if self.any_barred(drawings) { Shortfall::NoRoom } else { Shortfall::NoneFast }
    }

    fn any_barred(&self, drawings: &[Range<usize>]) -> bool {
        drawings.iter().any(|range| self.barred[range.clone()].contains(&true))
    }
}

/// Returns the drawing with the least value in some ranges; of equal ones, the earliest.
fn best(of: &Tournament, drawings: &[Range<usize>]) -> Option<(usize, f64)> {
    let best = drawings.iter().filter_map(|range| of.best_in(range.clone()));
    best.reduce(|a, b| if b.1 < a.1 { b } else { a })
}

/// Returns the SSD to the next drawing, by which the next koma is given; [`OUT`] if the drawing can take none.
fn slowness(strip: &Strip<'_>, drawing: usize) -> f64 {
    let link = &strip.links[drawing];
    if strip.room(drawing) == 0 {
        return OUT;
    }
    match strip.links.get(link.after) {
        None => OUT,
        // Koma by koma, the frame after a held one is its own copy.
        Some(_) if strip.by_koma && link.koma > 1 => 0.0,
        Some(next) => next.step,
    }
}
