//! The row of drawings on a sheet while it is laid out: stations, and the inbetweens between them.

use std::sync::Arc;

use super::interval::Interval;
use super::station::Station;
use super::steps::Steps;
use super::still::Still;
use super::timed::Timed;
use super::{Spaced, Spacing};
use crate::keys::Wall;
use crate::sheet::{Drawing, Exposure, Layer};
use crate::timing::ByPassage;
use crate::timing::koma_per_drawing::{Pace, STAY};

/// The rules by which a row is laid out.
pub(super) struct Rules<'a> {
    pub(super) spacing: &'a ByPassage<Spacing>,
    pub(super) timed: Timed<'a>,
    pub(super) walls: &'a [Wall],
    /// Whether the last drawing before the end may hold up to the sheet's end.
    pub(super) holds_end: bool,
    pub(super) pace: &'a Pace<'a>,
    pub(super) still: Still<'a>,
    pub(super) steps: Steps,
}

/// The drawings, the koma on which they begin, and the number of requested inbetweens that did not fit.
#[derive(Default)]
pub(super) struct Row {
    pub(super) drawings: Vec<Drawing>,
    pub(super) begins: Vec<usize>,
    /// The koma whose poses the last two drawings show; a genga may be placed before its own koma.
    shown: [usize; 2],
    pub(super) did_not_fit: usize,
}

impl Rules<'_> {
    /// Lays out stations; `names` are the names of all joints.
    pub(super) fn lay_out(self, stations: &[Station<'_>], names: &[Arc<str>]) -> Spaced {
        let mut row = Row::default();
        let drawn = self.drawn(stations);
        let mut begin = 0;
        for (at, station) in stations.iter().enumerate() {
            let is_new = !(self.is_end_of_rest(station) && row.holds_up_to(station, &self.still));
            if drawn[at] && is_new {
                row.put(begin, station.koma, station.drawing(names));
            }
            if let Some(next) = stations.get(at + 1) {
                begin = self.go(&mut row, station, next, drawn[at + 1]);
            }
        }
        let spaced = self.timed.beside_source(row).into_spaced(self.timed.length);
        Spaced { gaits: self.steps.into_koma(), source: self.timed.source_koma(), ..spaced }
    }

    /// Returns which stations are drawn: all but the ends of rests and of the sheet up to which the drawing before
    /// holds. Chosen keys are always drawn.
    fn drawn(&self, stations: &[Station<'_>]) -> Vec<bool> {
        let mut drawn = vec![true; stations.len()];
        let mut shown = 0;
        for (at, station) in stations.iter().enumerate().skip(1) {
            let before = &stations[shown];
            let is_time = station.is_rest() || (self.holds_end && station.is_free_end());
            drawn[at] = !(is_time && self.still.holds(before.koma, station.koma));
            if drawn[at] {
                shown = at;
            }
        }
        drawn
    }

    /// Puts the inbetweens between two stations into a row and returns the koma from which the second is shown.
    fn go(&self, row: &mut Row, from: &Station<'_>, to: &Station<'_>, is_drawn: bool) -> usize {
        if let Some(koma) = self.steps.between(from.koma, to.koma) {
            return self.step(row, from, to, &koma);
        }
        let [_, shown] = row.shown;
        let all = self.inbetweens(shown, from, to.koma);
        row.did_not_fit += self.asked(from).map_or(0, |asked| asked - all.len());
        let holds = self.still.holds(shown, to.koma);
        if !is_drawn && holds {
            return to.koma;
        }
        let mut koma = self.still.what_moves(row.shown, all);
        let end = match self.still.is_rest(from.koma, to.koma) {
            _ if !is_drawn || holds => to.koma,
            true if self.is_end_of_rest(to) => to.koma,
            true => self.displace(&mut koma, to),
            false => self.arrive(row, &mut koma, [from, to]),
        };
        self.put(row, [from, to], &koma, end);
        end
    }

    /// Puts the inbetweens of a step, the same in every step, between two stations. Nothing holds there.
    fn step(&self, row: &mut Row, from: &Station<'_>, to: &Station<'_>, koma: &[usize]) -> usize {
        row.did_not_fit += self.asked(from).map_or(0, |asked| asked.saturating_sub(koma.len()));
        self.put(row, [from, to], koma, to.koma);
        to.koma
    }

    /// Puts inbetweens on some koma into a row; the last stays up to `end`.
    fn put(&self, row: &mut Row, [from, to]: [&Station<'_>; 2], koma: &[usize], end: usize) {
        let interval = Interval::new(self.spacing, from, to, self.walls, self.timed.clock);
        let ends = koma.iter().skip(1).copied().chain([end]);
        for (koma, end) in koma.iter().zip(ends) {
            row.put(*koma, *koma, interval.inbetween(*koma, end - koma));
        }
    }

    /// Returns the koma of the inbetweens between two koma. The first comes no earlier than the body sets out from the
    /// drawing on screen, and each stays as long as a drawing must.
    fn inbetweens(&self, shown: usize, from: &Station<'_>, to: usize) -> Vec<usize> {
        if let Some(asked) = self.asked(from) {
            return self.spacing.evenly(asked, from.koma..to, self.pace);
        }
        let from = from.koma;
        let step = |koma: usize| self.spacing.stay(koma, self.pace);
        let stays = |koma: &usize| koma + step(*koma).min(STAY) <= to;
        // The drawing on screen stays as long as any other.
        let first = from.max(shown + step(shown));
        let first = match self.still.is_rest(from, to) {
            true => first,
            false => first.max(self.still.departure(shown, from, to)),
        };
        let next = |koma: &usize| Some(koma + step(*koma));
        std::iter::successors(Some(first), next).take_while(stays).collect()
    }

    /// Returns the fixed number of inbetweens after a key, if there is one.
    fn asked(&self, from: &Station<'_>) -> Option<usize> {
        self.spacing.at(from.koma).inbetweens
    }

    /// Whether a station is the end of a rest, and so marks a time rather than a pose.
    fn is_end_of_rest(&self, station: &Station<'_>) -> bool {
        station.is_rest() && self.still.ends_rest(station.koma)
    }

    /// Returns the koma of a station within a rest: its own, or that of the first inbetween that looks like it, which
    /// it replaces.
    fn displace(&self, koma: &mut Vec<usize>, to: &Station<'_>) -> usize {
        let is_like = |koma: &usize| self.still.leads_to(*koma, to.koma);
        match koma.iter().position(is_like).filter(|_| !to.is_fixed()) {
            Some(at) => koma.drain(at..).next().unwrap_or(to.koma),
            None => to.koma,
        }
    }

    /// Returns the koma of a station: its own, or the one at which the body arrives, if the drawing before has stayed
    /// long enough by then. Inbetweens after that koma are removed.
    fn arrive(&self, row: &Row, koma: &mut Vec<usize>, [from, to]: [&Station<'_>; 2]) -> usize {
        let stays_two = self.spacing.stay(to.koma, self.pace) >= STAY;
        if to.is_fixed() || self.asked(from).is_some() || !stays_two {
            return to.koma;
        }
        let [_, shown] = row.shown;
        let there = self.still.arrival(shown, to.koma);
        koma.retain(|koma| *koma < there);
        let before = koma.last().copied().unwrap_or(shown);
        there.max(before + self.spacing.stay(before, self.pace)).min(to.koma)
    }
}

impl Row {
    /// Whether the drawing on screen holds up to a station.
    fn holds_up_to(&self, station: &Station<'_>, still: &Still<'_>) -> bool {
        let is_any = !self.drawings.is_empty();
        is_any && !station.is_set() && still.holds(self.shown[1], station.koma)
    }

    /// Puts a drawing on a koma; `shown` is the koma whose pose it shows.
    pub(super) fn put(&mut self, koma: usize, shown: usize, drawing: Drawing) {
        self.drawings.push(drawing);
        self.begins.push(koma);
        self.shown = [self.shown[1], shown];
    }

    /// Converts the row into a layer of `koma` koma, each drawing lasting up to the next.
    fn into_spaced(self, koma: usize) -> Spaced {
        let Self { drawings, begins, did_not_fit, .. } = self;
        let ends = begins.iter().skip(1).copied().chain([koma]);
        let exposures = begins
            .iter()
            .zip(ends)
            .enumerate()
            .map(|(drawing, (begin, end))| Exposure { drawing, koma: end - begin })
            .collect();
        Spaced {
            layer: Layer { name: "A".into(), joints: vec![], drawings, exposures, gone: vec![] },
            did_not_fit,
            gaits: Vec::new(),
            source: Vec::new(),
        }
    }
}
