//! Prepares a layer for the sheet on paper, in one pass.

use crate::xsheet::half_page::Half;
use genga::sheet::{Exposure, Layer, Number};
use genga::timing::Gauge;

/// A layer with facts about its drawings.
pub(super) struct Leaf<'a> {
    pub(super) layer: &'a Layer,
    pub(super) gauges: &'a [Gauge],
    /// Number of each drawing.
    pub(super) numbers: Vec<Number>,
    /// Number of each drawing among the keys; `None` for an inbetween.
    pub(super) genga: Vec<Option<Number>>,
    /// Koma on which each exposure begins.
    pub(super) begins: Vec<usize>,
    /// Koma on which the highest drawing begins for the last time: END is written under it.
    pub(super) end: Option<usize>,
    /// Koma on which the second round of a loop begins, with the first drawing again; all later koma are one repeat.
    pub(super) repeat: Option<usize>,
}

impl<'a> Leaf<'a> {
    /// Prepares a layer whose first drawing enters after `before` blank koma. `repeat` is the koma of the layer on which
    /// the second round of a loop begins. Gauges of later rounds are left out.
    pub(super) fn new(
        layer: &'a Layer,
        gauges: &'a [Gauge],
        before: usize,
        repeat: Option<usize>,
    ) -> Self {
        let repeat = repeat.map(|repeat| before + repeat);
        let begins: Vec<usize> = layer.timed().map(|(begin, _)| before + begin).collect();
        let is_written = |begin: usize| repeat.is_none_or(|repeat| begin < repeat);
        let written = layer.timed().filter(|(begin, _)| is_written(before + begin));
        let last = written.max_by_key(|(_, shown)| shown.drawing);
        let end = last.map(|(begin, _)| before + begin);
        let own = gauges.partition_point(|gauge| is_written(begins[gauge.first]));
        let (numbers, genga) = (layer.numbers(), layer.genga_numbers());
        Self { layer, gauges: &gauges[..own], numbers, genga, begins, end, repeat }
    }

    /// Whether a koma lies in a repeat, behind its first drawing.
    pub(super) fn is_repeated(&self, koma: usize) -> bool {
        self.repeat.is_some_and(|repeat| koma > repeat)
    }

    /// Returns the exposures on screen in a half, each with the koma on which it begins.
    pub(super) fn on(&self, half: Half) -> impl Iterator<Item = (usize, Exposure)> + '_ {
        let after = self.begins.partition_point(|begin| *begin < half.end());
        // The last one that begins before the half may extend into it.
        let first = self.begins[..after].partition_point(|begin| *begin <= half.begin);
        let shown = first.saturating_sub(1)..after;
        let begins = self.begins[shown.clone()].iter().copied();
        let shown = begins.zip(self.layer.exposures[shown].iter().copied());
        shown.filter(move |(begin, shown)| begin + shown.koma > half.begin)
    }

    /// Returns the gauges that overlap a half, each with the koma of its two keys.
    pub(super) fn gauges_on(&self, half: Half) -> impl Iterator<Item = (&'a Gauge, usize, usize)> {
        let keys = |gauge: &Gauge| {
            (self.begins[gauge.first], self.begins[gauge.first + gauge.shares.len() - 1])
        };
        let first = self.gauges.partition_point(|gauge| keys(gauge).1 <= half.begin);
        let after = self.gauges.partition_point(|gauge| keys(gauge).0 < half.end());
        let with_keys = move |gauge| {
            let (from, to) = keys(gauge);
            (gauge, from, to)
        };
        self.gauges[first.min(after)..after].iter().map(with_keys)
    }
}
