//! Positions of koma and columns on the sheet (用紙).

use std::ops::Range;

use egui::{Rangef, Rect};

/// Width of the koma numbers in points.
pub(super) const KOMA: f32 = 40.0;
/// Distance between the middles of two columns in points.
pub(super) const PITCH: f32 = 34.0;
/// Width of the S column in points.
const SPEECH: f32 = 30.0;
/// Gap between the koma numbers and the S column in points.
const GAP: f32 = 5.0;
/// Middle of the first column in points.
const MIDDLE: f32 = KOMA + GAP + SPEECH + 0.5 * PITCH;
/// Distance from the middle of the last column to the reasons in words, in points.
const WORDS: f32 = 22.0;
/// Least width of the reasons in words, in points.
const LEAST_WORDS: f32 = 60.0;

/// Layout of the sheet in the window.
#[derive(Debug, Clone, Copy)]
pub(super) struct Paper {
    pub(super) rect: Rect,
    /// Height of a koma in points.
    pub(super) row: f32,
    pub(super) columns: usize,
}

impl Paper {
    /// Least width of a sheet with this many columns.
    pub(super) fn wide(columns: usize) -> f32 {
        MIDDLE + PITCH * columns.saturating_sub(1) as f32 + WORDS + LEAST_WORDS
    }

    /// Horizontal position of a column's middle.
    pub(super) fn x(&self, column: usize) -> f32 {
        self.rect.min.x + MIDDLE + PITCH * column as f32
    }

    /// Horizontal range of the S column.
    pub(super) fn speech(&self) -> Rangef {
        let left = self.rect.min.x + KOMA + GAP;
        Rangef::new(left, left + SPEECH)
    }

    /// Positions of the lines between the columns, from left to right.
    pub(super) fn edges(&self) -> impl Iterator<Item = f32> {
        let Rangef { min, max } = self.speech();
        let cels = (0..=self.columns).map(move |at| max + PITCH * at as f32);
        [min].into_iter().chain(cels)
    }

    /// Horizontal position at which the reasons begin.
    pub(super) fn words(&self) -> f32 {
        self.x(self.columns - 1) + WORDS
    }

    /// The column at a position. `None` beside the columns.
    pub(super) fn column(&self, x: f32) -> Option<usize> {
        let at = (x - self.x(0)) / PITCH + 0.5;
        let column = at.floor() as usize;
        (at >= 0.0 && column < self.columns).then_some(column)
    }

    /// Vertical position at which a koma begins.
    pub(super) fn y(&self, koma: usize) -> f32 {
        self.rect.min.y + self.row * koma as f32
    }

    pub(super) fn koma_range(&self, koma: usize) -> Rangef {
        Rangef::new(self.y(koma), self.y(koma + 1))
    }

    /// The koma at a position, on a sheet of `length` koma.
    pub(super) fn koma(&self, y: f32, length: usize) -> usize {
        let koma = ((y - self.rect.min.y) / self.row).max(0.0) as usize;
        koma.min(length.saturating_sub(1))
    }

    /// The nearest line between two koma, and its distance.
    pub(super) fn line(&self, y: f32) -> (usize, f32) {
        let lines = (y - self.rect.min.y) / self.row;
        let line = lines.round().max(0.0);
        (line as usize, (lines - line).abs() * self.row)
    }

    /// The koma in view.
    pub(super) fn rows(&self, seen: Rect, length: usize) -> Range<usize> {
        let first = (seen.min.y / self.row).floor().max(0.0) as usize;
        let past = (seen.max.y / self.row).ceil().max(0.0) as usize;
        first.min(length)..past.min(length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{pos2, vec2};

    #[test]
    fn what_is_under_a_point_is_what_is_drawn_there() {
        let rect = Rect::from_min_size(pos2(100.0, 50.0), vec2(300.0, 170.0));
        let paper = Paper { rect, row: 17.0, columns: 3 };
        for column in 0..3 {
            assert_eq!(paper.column(paper.x(column)), Some(column));
        }
        assert_eq!((paper.column(100.0), paper.column(paper.words())), (None, None));
        assert_eq!((paper.koma(paper.y(4) + 1.0, 10), paper.koma(1e4, 10)), (4, 9));
        let (line, into) = paper.line(paper.y(4) + 2.0);
        assert_eq!(line, 4);
        // Positions are `f32`.
        assert!((into - 2.0).abs() < 1e-4, "{into}");
        let seen = Rect::from_min_size(pos2(0.0, 40.0), vec2(300.0, 60.0));
        assert_eq!(paper.rows(seen, 10), 2..6);
        assert_eq!(paper.rows(seen, 4), 2..4);
    }
}
