//! A layer for the sheet on paper, looked through once.

use crate::plot::xsheet::half::Half;
use crate::sheet::{Exposure, Layer};
use crate::timing::Gauge;

/// A layer with what is known about its drawings.
pub(super) struct Leaf<'a> {
    pub(super) layer: &'a Layer,
    pub(super) gauges: &'a [Gauge],
    /// The number of each drawing among the keys.
    pub(super) genga: Vec<Option<usize>>,
    /// The koma on which each exposure begins.
    pub(super) begins: Vec<usize>,
    /// The koma on which the highest drawing comes last: it carries END.
    pub(super) end: Option<usize>,
}

impl<'a> Leaf<'a> {
    pub(super) fn new(layer: &'a Layer, gauges: &'a [Gauge]) -> Self {
        let begins = layer.timed().map(|(begin, _)| begin).collect();
        let last = layer.timed().max_by_key(|(_, shown)| shown.drawing);
        let end = last.map(|(begin, _)| begin);
        Self { layer, gauges, genga: layer.genga_numbers(), begins, end }
    }

    /// The exposures that are on screen in a half, each with the koma it begins on.
    pub(super) fn on(&self, half: Half) -> impl Iterator<Item = (usize, Exposure)> + '_ {
        let after = self.begins.partition_point(|begin| *begin < half.end());
        // The last that begins before the half goes on into it, if not further than that.
        let first = self.begins[..after].partition_point(|begin| *begin <= half.begin);
        let shown = first.saturating_sub(1)..after;
        let begins = self.begins[shown.clone()].iter().copied();
        let shown = begins.zip(self.layer.exposures[shown].iter().copied());
        shown.filter(move |(begin, shown)| begin + shown.koma > half.begin)
    }

    /// The gauges of which a part is in a half, each with the koma of its two keys.
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
