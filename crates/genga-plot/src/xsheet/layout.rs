//! Computes where everything stands on a page.

use crate::xsheet::XSheet;
use crate::xsheet::half_page::{Half, Place, ROWS};
use crate::xsheet::paper_layer::Leaf;
use genga::sheet::Sheet;
use genga::slate::Slate;

/// Width and height of a page in px. The shape is a little wider than A4 and B4 are inside their margins, so
/// that a page as wide as the paper is never too high for it.
pub(super) const SIZE: (f64, f64) = (1000.0, 1440.0);
/// White at the edges, in px.
pub(super) const MARGIN: f64 = 8.0;
/// Maximum number of layers on a page.
const LAYERS: usize = 8;
/// Minimum number of columns: a person may need spare ones.
const COLUMNS: usize = 5;

const HALF: f64 = 482.0;
pub(super) const NUMBERS: f64 = 30.0;
pub(super) const STRIP: f64 = 58.0;
const BLOCK: f64 = 150.0;
const SPEECH: f64 = 38.0;

/// A page: some layers over 144 koma.
#[derive(Clone, Copy)]
pub(super) struct Page<'a> {
    pub(super) settings: &'a XSheet,
    pub(super) cut: &'a str,
    pub(super) slate: &'a Slate,
    pub(super) sheet: &'a Sheet,
    pub(super) leaves: &'a [Leaf<'a>],
    /// First koma of the page.
    pub(super) begin: usize,
    /// Number of this page, from 1, and number of pages.
    pub(super) number: usize,
    pub(super) of: usize,
}

impl<'a> Page<'a> {
    pub(super) fn all(
        settings: &'a XSheet,
        (cut, slate): (&'a str, &'a Slate),
        sheet: &'a Sheet,
        leaves: &'a [Leaf<'a>],
    ) -> Vec<Self> {
        let in_time = sheet.cut_length().div_ceil(2 * ROWS).max(1);
        let groups: Vec<&[Leaf<'_>]> =
            if leaves.is_empty() { vec![&[]] } else { leaves.chunks(LAYERS).collect() };
        let of = in_time * groups.len();
        let page = |(at, leaves)| {
            move |time: usize| Self {
                settings,
                cut,
                slate,
                sheet,
                leaves,
                begin: time * 2 * ROWS,
                number: at * in_time + time + 1,
                of,
            }
        };
        groups.into_iter().enumerate().flat_map(|group| (0..in_time).map(page(group))).collect()
    }

    pub(super) fn halves(&self) -> [Half; 2] {
        let right = SIZE.0 - MARGIN - HALF;
        [Half { left: MARGIN, begin: self.begin }, Half { left: right, begin: self.begin + ROWS }]
    }

    pub(super) fn columns(&self) -> usize {
        self.leaves.len().max(COLUMNS)
    }

    /// Returns the ACTION column of a layer.
    pub(super) fn action(&self, half: Half, at: usize) -> Place {
        self.place(half.left + NUMBERS + STRIP, at)
    }

    /// Returns the CELL column of a layer.
    pub(super) fn cell(&self, half: Half, at: usize) -> Place {
        self.place(half.left + NUMBERS + STRIP + BLOCK + SPEECH, at)
    }

    /// Returns the S column.
    pub(super) fn speech(&self, half: Half) -> Place {
        Place { left: half.left + NUMBERS + STRIP + BLOCK, width: SPEECH }
    }

    /// Returns the CAMERA column.
    pub(super) fn camera(&self, half: Half) -> Place {
        let left = half.left + NUMBERS + STRIP + BLOCK + SPEECH + BLOCK;
        Place { left, width: half.left + HALF - left }
    }

    fn place(&self, left: f64, at: usize) -> Place {
        let width = BLOCK / self.columns() as f64;
        Place { left: left + width * at as f64, width }
    }

    /// Returns the left edges and names of the blocks of a half, and its right edge.
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

    /// Returns the number of koma in a second, at least 1.
    pub(super) fn second(&self) -> usize {
        (self.sheet.clock.koma_rate.round() as usize).max(1)
    }
}
