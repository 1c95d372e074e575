//! A page: its measures, and what is drawn on it in which order.

use crate::error::Error;
use crate::plot::canvas::paint;
use crate::plot::xsheet::{XSheet, column, gauge_strip, grid, head};
use crate::sheet::{Exposure, Layer, Sheet};
use crate::timing::Gauge;

/// Width and height of a page in px: a little wider than A4 and B4 inside their margins are, so that a
/// page as wide as the paper is never too high for it.
pub(super) const SIZE: (u32, u32) = (1000, 1440);
/// White at the edges.
pub(super) const MARGIN: f64 = 8.0;
/// Koma in a half, three seconds.
pub(super) const ROWS: usize = 72;
/// Height of a koma.
pub(super) const ROW: f64 = 17.0;
/// Where the first koma begins.
pub(super) const TOP: f64 = 146.0;
/// Layers on a page.
const LAYERS: usize = 8;
/// Columns there are at least: a person may need them.
const COLUMNS: usize = 5;

const HALF: f64 = 482.0;
pub(super) const NUMBERS: f64 = 30.0;
pub(super) const STRIP: f64 = 58.0;
const BLOCK: f64 = 150.0;
const SPEECH: f64 = 38.0;

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

/// One page: some layers over 144 koma.
pub(super) struct Page<'a> {
    pub(super) settings: &'a XSheet,
    pub(super) cut: &'a str,
    pub(super) sheet: &'a Sheet,
    pub(super) leaves: &'a [Leaf<'a>],
    /// The first koma of the page.
    pub(super) begin: usize,
    pub(super) number: usize,
    pub(super) of: usize,
}

/// A half of a page: where it is, and its koma.
#[derive(Clone, Copy)]
pub(super) struct Half {
    pub(super) left: f64,
    pub(super) begin: usize,
}

/// A column of cels on a half.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) left: f64,
    pub(super) width: f64,
}

impl<'a> Page<'a> {
    pub(super) fn all(
        settings: &'a XSheet,
        cut: &'a str,
        sheet: &'a Sheet,
        leaves: &'a [Leaf<'a>],
    ) -> Vec<Self> {
        let in_time = sheet.length().div_ceil(2 * ROWS).max(1);
        let groups: Vec<&[Leaf<'_>]> =
            if leaves.is_empty() { vec![&[]] } else { leaves.chunks(LAYERS).collect() };
        let of = in_time * groups.len();
        let page = |(at, leaves)| {
            move |time: usize| Self {
                settings,
                cut,
                sheet,
                leaves,
                begin: time * 2 * ROWS,
                number: at * in_time + time + 1,
                of,
            }
        };
        groups.into_iter().enumerate().flat_map(|group| (0..in_time).map(page(group))).collect()
    }

    pub(super) fn draw(&self) -> Result<String, Error> {
        paint(SIZE, |canvas| {
            head::draw(canvas, self)?;
            for half in self.halves() {
                grid::draw(canvas, self, half)?;
                grid::end(canvas, self, half)?;
                for (at, leaf) in self.leaves.iter().enumerate() {
                    gauge_strip::draw(canvas, self, leaf, half, at)?;
                    column::action(canvas, self, leaf, half, self.action(half, at))?;
                    column::cell(canvas, self, leaf, half, self.cell(half, at))?;
                }
            }
            head::legend(canvas, self)
        })
    }

    pub(super) fn halves(&self) -> [Half; 2] {
        let right = f64::from(SIZE.0) - MARGIN - HALF;
        [Half { left: MARGIN, begin: self.begin }, Half { left: right, begin: self.begin + ROWS }]
    }

    pub(super) fn columns(&self) -> usize {
        self.leaves.len().max(COLUMNS)
    }

    /// The ACTION column of a layer.
    pub(super) fn action(&self, half: Half, at: usize) -> Place {
        self.place(half.left + NUMBERS + STRIP, at)
    }

    /// The CELL column of a layer.
    pub(super) fn cell(&self, half: Half, at: usize) -> Place {
        self.place(half.left + NUMBERS + STRIP + BLOCK + SPEECH, at)
    }

    fn place(&self, left: f64, at: usize) -> Place {
        let width = BLOCK / self.columns() as f64;
        Place { left: left + width * at as f64, width }
    }

    /// Left edges and names of the blocks of a half, and its right edge.
    pub(super) fn blocks(half: Half) -> ([(f64, &'static str, &'static str); 6], f64) {
        let mut left = half.left;
        let mut next = |width: f64| {
            left += width;
            left - width
        };
        let blocks = [
            (next(NUMBERS), "koma", "コマ"),
            (next(STRIP), "spacing", "ツメ指示"),
            (next(BLOCK), "ACTION", "原画"),
            (next(SPEECH), "S", "セリフ"),
            (next(BLOCK), "CELL", "動画"),
            (next(0.0), "CAMERA", "カメラ"),
        ];
        (blocks, half.left + HALF)
    }

    /// Whether a koma is on the sheet.
    pub(super) fn has(&self, koma: usize) -> bool {
        koma < self.sheet.length()
    }

    /// Koma in a second, at least 1.
    pub(super) fn second(&self) -> usize {
        (self.sheet.clock.koma_rate.round() as usize).max(1)
    }
}

impl Half {
    pub(super) fn end(self) -> usize {
        self.begin + ROWS
    }

    /// Where a koma of this half begins.
    pub(super) fn y(self, koma: usize) -> f64 {
        self.y_at(koma as f64)
    }

    /// The same for a part of a koma.
    pub(super) fn y_at(self, koma: f64) -> f64 {
        TOP + (koma - self.begin as f64) * ROW
    }

    pub(super) fn shows(self, koma: usize) -> bool {
        (self.begin..self.end()).contains(&koma)
    }
}

impl Place {
    pub(super) fn middle(self) -> f64 {
        self.left + 0.5 * self.width
    }
}
