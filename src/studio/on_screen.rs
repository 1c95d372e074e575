//! What is on screen (画面) of all columns together: the poses that the files have, koma for koma.

use glam::DVec3;

use crate::motion::{Clip, Point};
use crate::plot::parts::{Cels, Composite, Showing, ShownDrawing, shown_drawings};

/// All columns on one another, exposure after exposure.
#[derive(Debug, Clone)]
pub(super) struct OnScreen<'a> {
    composite: Composite<'a>,
    pub(super) cells: Vec<ShownDrawing<'a>>,
}

impl<'a> OnScreen<'a> {
    /// Cels of a motion.
    pub(super) fn of(clip: &'a Clip, cels: &'a Cels) -> Self {
        Self { composite: Composite::with(clip, cels), cells: shown_drawings(cels.layer()) }
    }

    /// Which exposure is on screen at a koma.
    pub(super) fn at(&self, koma: usize) -> usize {
        self.cells.partition_point(|cell| cell.koma <= koma).saturating_sub(1)
    }

    /// The poses, for a figure with such marks.
    pub(super) fn posing<'b>(&'b self, marks: &'b [Point]) -> ScreenPosing<'b> {
        ScreenPosing { on_screen: self, showing: Showing::of(&self.composite, marks) }
    }
}

/// Gives the points of what is on screen, one koma after another.
pub(super) struct ScreenPosing<'a> {
    on_screen: &'a OnScreen<'a>,
    showing: Showing<'a>,
}

impl ScreenPosing<'_> {
    /// The points of a koma, in the file's unit.
    pub(super) fn koma(&mut self, koma: usize) -> Vec<DVec3> {
        let drawing = self.on_screen.cells[self.on_screen.at(koma)].index;
        self.showing.points(drawing, koma)
    }
}
