//! The readings of the paper that its wording leaves open, and their counts on a clip.

use genga::motion::Clip;
use genga::signal::{
    FilterKind, LowPass, Measure, Reading, Side, Signals, Spectrum, Speed, Steady, TurnFinder,
};
use genga::time::Span;
use genga_lab::study;

use super::table_1::PAPER;
use crate::Outcome;

/// Frames per second of the paper's capture, the unit of its widths. At another rate they are converted to keep their
/// length in seconds.
const RATE: f64 = 100.0;

/// The meaning of a filter range W.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Width {
    /// A window of W frames.
    Whole,
    /// A window of W frames on each side: 2W.
    EachSide,
}

/// One reading of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Way {
    pub(super) measure: Measure,
    pub(super) kind: FilterKind,
    pub(super) width: Width,
    /// Dead band in ° per frame², at the paper's rate.
    pub(super) band: f64,
    pub(super) side: Side,
}

/// The reading of `genga study`.
pub(super) const STUDY: Way = Way {
    measure: Measure::Rotation,
    kind: FilterKind::Box,
    width: Width::Whole,
    band: 0.03,
    side: Side::After,
};

/// All readings; those with the same filter are adjacent.
pub(super) fn all() -> Vec<Way> {
    let mut all = vec![STUDY];
    all = each(all, [Measure::Rotation, Measure::Angle], |way, measure| Way { measure, ..way });
    let kinds = [FilterKind::Box, FilterKind::Gaussian, FilterKind::Ideal, FilterKind::Butterworth];
    all = each(all, kinds, |way, kind| Way { kind, ..way });
    all = each(all, [Width::Whole, Width::EachSide], |way, width| Way { width, ..way });
    all = each(all, [0.0, 0.01, 0.03, 0.05, 0.1], |way, band| Way { band, ..way });
    each(all, [Side::After, Side::Both, Side::Rising], |way, side| Way { side, ..way })
}

/// Combines each of the ways with each of the choices.
fn each<T: Copy, const N: usize>(
    ways: Vec<Way>,
    choices: [T; N],
    with: impl Fn(Way, T) -> Way,
) -> Vec<Way> {
    ways.iter().flat_map(|way| choices.map(|choice| with(*way, choice))).collect()
}

/// The six counts of the table, in the order of [`PAPER`].
pub(super) type Six = [usize; PAPER.len()];

/// The counts of one reading on a clip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counts {
    /// Number of distinct frames over all joints.
    pub(super) union: Six,
    /// Sum over the joints.
    pub(super) total: Six,
}

/// Counts the keys of a clip with each of the ways.
pub(super) fn count(clip: &Clip, ways: &[Way]) -> Outcome<Vec<Counts>> {
    let mut counts = Vec::with_capacity(ways.len());
    for of_measure in ways.chunk_by(|a, b| a.measure == b.measure) {
        let measure = of_measure[0].measure;
        let spectrum = Spectrum::from(Speed { measure }.measure(clip)?);
        for of_filter in of_measure.chunk_by(|a, b| (a.kind, a.width) == (b.kind, b.width)) {
            let filtered = FRAMES.map(|frames| of_filter[0].filter(frames).apply(&spectrum));
            counts.extend(of_filter.iter().map(|way| way.counts(&filtered)));
        }
    }
    Ok(counts)
}

/// The table's filter ranges, and the persistences of each.
const FRAMES: [f64; 3] = [10.0, 20.0, 30.0];
const PERSISTENCES: [f64; 2] = [5.0, 10.0];

impl Way {
    /// Describes how this reading differs from the study's.
    pub(super) fn words(&self) -> String {
        let mut words = Vec::new();
        if self.measure != STUDY.measure {
            words.push("signed change of the angle".into());
        }
        let kind = match self.kind {
            FilterKind::Box => "box",
            FilterKind::Gaussian => "Gaussian",
            FilterKind::Ideal => "ideal",
            FilterKind::Butterworth => "Butterworth",
        };
        match self.width {
            Width::Whole if self.kind == STUDY.kind => {}
            Width::Whole => words.push(kind.into()),
            Width::EachSide => words.push(format!("{kind} of 2W")),
        }
        if self.band != STUDY.band {
            words.push(match self.band {
                0.0 => "no band".into(),
                band => format!("band {band}"),
            });
        }
        match self.side {
            Side::After => {}
            Side::Both => words.push("M on both sides".into()),
            Side::Rising => words.push("M rising".into()),
        }
        if words.is_empty() { "the words of §3.3".into() } else { words.join(", ") }
    }

    /// The low-pass filter of a range W.
    pub(super) fn filter(&self, range: f64) -> LowPass {
        let frames = match self.width {
            Width::Whole => range,
            Width::EachSide => 2.0 * range,
        };
        LowPass { kind: self.kind, width: Span::Seconds(frames / RATE) }
    }

    /// The turn finder of a persistence M.
    pub(super) fn finder(&self, persistence: f64) -> TurnFinder {
        TurnFinder {
            reading: Reading::Literal,
            steady: Steady::Acceleration(self.band * RATE * RATE),
            persistence: Span::Seconds(persistence / RATE),
            side: self.side,
            ..TurnFinder::default()
        }
    }

    fn counts(&self, filtered: &[Signals; 3]) -> Counts {
        let mut counts = Counts { union: Six::default(), total: Six::default() };
        for (at, signals) in filtered.iter().enumerate() {
            let candidates = self.finder(0.0).candidates(signals, 0.0);
            for (of, frames) in PERSISTENCES.into_iter().enumerate() {
                let turns = self.finder(frames).confirmed(&candidates, signals);
                let cell = at * PERSISTENCES.len() + of;
                counts.union[cell] = study::union(&turns);
                counts.total[cell] = study::total(&turns);
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn the_way_of_the_study_counts_as_the_study_does() {
        let clip = samples::clip("kuroda-pitch").unwrap();
        let ways = all();
        let at = ways.iter().position(|way| *way == STUDY).unwrap();
        let counts = count(&clip, &ways).unwrap();
        assert_eq!(counts.len(), ways.len());
        let grid = super::super::table_1::study().unwrap().run(clip, || ()).unwrap();
        for (cell, counted) in grid.cells.iter().enumerate() {
            let counts = [counts[at].union[cell], counts[at].total[cell]];
            assert_eq!(counts.map(|count| count as f64), counted.values[..2], "cell {cell}");
        }
    }

    #[test]
    fn every_way_is_there_once() {
        let ways = all();
        assert_eq!(ways.len(), 2 * 4 * 2 * 5 * 3);
        for (at, way) in ways.iter().enumerate() {
            assert!(!ways[..at].contains(way), "{way:?}");
        }
    }
}
