//! Where everything stands on the strip: numbers above, figures in the middle, drawings below.

use egui::{Pos2, Rangef, Rect, vec2};

use crate::column::KeyedCell;
use crate::time_axis::Scale;
use crate::view_state::Shown;

/// Height of the koma numbers, of the circles of the genga and of the drawings, in points.
const NUMBERS: f32 = 13.0;
const BADGES: f32 = 18.0;
const TRACK: f32 = 11.0;
/// Room at both sides, so that the first and the last figure are whole, in points.
const SIDE: f32 = 22.0;
/// Width of a figure as a share of its height, and the least.
const SLENDER: f32 = 0.52;
const LEAST: f32 = 22.0;
/// Distance within which the end of a hold is grabbed, and the least length of one that can be, in points.
const NEAR_END: f32 = 4.0;
const LEAST_END: f32 = 9.0;

/// The strip in the window.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    pub(super) rect: Rect,
    pub(super) time: Scale,
    pub(super) figures: Rect,
    /// Vertical middle of the circles.
    pub(super) badges: f32,
    pub(super) track: Rangef,
    /// Width of a figure in points.
    pub(super) wide: f32,
}

/// The part of the strip that the time axis fills.
pub(super) fn inside(rect: Rect) -> Rect {
    rect.shrink2(vec2(SIDE, 0.0))
}

impl Layout {
    pub(super) fn new(rect: Rect, time: Scale) -> Self {
        let track = Rangef::new(rect.max.y - TRACK - 2.0, rect.max.y - 2.0);
        let below = track.min - BADGES;
        let figures = Rect::from_x_y_ranges(rect.x_range(), rect.min.y + NUMBERS..=below);
        let wide = (SLENDER * figures.height()).max(LEAST);
        Self { rect, time, figures, badges: below + 0.5 * BADGES, track, wide }
    }

    /// Horizontal position at which a koma begins.
    pub(super) fn x(&self, koma: usize) -> f32 {
        self.time.x(koma as f64)
    }

    /// Width of a koma in points.
    pub(super) fn koma(&self) -> f32 {
        self.x(1) - self.x(0)
    }

    /// The koma at a position, on a sheet of `length` koma.
    pub(super) fn at(&self, x: f32, length: usize) -> usize {
        (self.time.place(x).floor().max(0.0) as usize).min(length.saturating_sub(1))
    }

    /// The line between koma that is nearest to a position.
    pub(super) fn line(&self, x: f32) -> usize {
        self.time.place(x).round().max(0.0) as usize
    }

    /// The koma meant at a position: the one whose bar is there, else the one whose figure and number are nearest. Those
    /// stand on the line at which their koma begins.
    pub(super) fn meant(&self, at: Pos2, length: usize) -> usize {
        match at.y >= self.track.min {
            true => self.at(at.x, length),
            false => self.line(at.x).min(length.saturating_sub(1)),
        }
    }

    /// The exposures in view, as a range of a column's cells.
    pub(super) fn seen(&self, shown: &Shown<'_>) -> std::ops::Range<usize> {
        let column = shown.column();
        let (from, to) = (self.rect.min.x - self.wide, self.rect.max.x + self.wide);
        column.at(self.at(from, column.length))..column.at(self.at(to, column.length)) + 1
    }

    /// Room of a figure.
    pub(super) fn slot(&self, x: f32) -> Rect {
        Rect::from_x_y_ranges(x - 0.5 * self.wide..=x + 0.5 * self.wide, self.figures.y_range())
    }

    /// Index of the exposure whose figure or circle is at a position.
    pub(super) fn cell(&self, at: Pos2, figured: &[usize], shown: &Shown<'_>) -> Option<usize> {
        if at.y > self.badges + 0.5 * BADGES || at.y < self.figures.min.y {
            return None;
        }
        let cells = &shown.column().cells;
        let away = |own: &usize| (self.x(cells[*own].koma) - at.x).abs();
        let nearest = |all: &mut dyn Iterator<Item = usize>, room: f32| {
            all.min_by(|a, b| away(a).total_cmp(&away(b))).filter(|own| away(own) <= room)
        };
        // Each genga has a circle or a dot, those that have no figure too.
        let mut genga = self.seen(shown).filter(|own| cells[*own].genga.is_some());
        let circle =
            (at.y > self.figures.max.y).then(|| nearest(&mut genga, 0.5 * BADGES)).flatten();
        circle.or_else(|| nearest(&mut figured.iter().copied(), 0.5 * self.wide))
    }

    /// The drawing whose end is at a position of the track. The last one ends with the sheet and cannot be dragged.
    pub(super) fn ending<'a, 'b>(
        &self,
        at: Pos2,
        shown: &'b Shown<'a>,
    ) -> Option<&'b KeyedCell<'a>> {
        let (line, column) = (self.line(at.x), shown.column());
        let is_there = self.track.expand(2.0).contains(at.y) && line >= 1 && line < column.length;
        let is_near = (self.x(line) - at.x).abs() <= NEAR_END;
        let cell = (is_there && is_near).then(|| column.cell(line - 1))?;
        let is_long = cell.held as f32 * self.koma() >= LEAST_END;
        (is_long && cell.koma + cell.held == line).then_some(cell)
    }
}
