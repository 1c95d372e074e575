//! The screen (画面): all columns together, with the poses of the exported files, koma by koma.

use glam::DVec3;

use genga::motion::{Clip, Point};
use genga_plot::parts::{Cels, Composite, Showing, ShownDrawing, shown_drawings};

/// All columns laid on one another, as a list of exposures.
#[derive(Debug, Clone)]
pub(super) struct OnScreen<'a> {
    composite: Composite<'a>,
    pub(super) cells: Vec<ShownDrawing<'a>>,
}

impl<'a> OnScreen<'a> {
    /// Combines the cels of a clip.
    pub(super) fn new(clip: &'a Clip, cels: &'a Cels) -> Self {
        Self { composite: Composite::with(clip, cels), cells: shown_drawings(cels.layer()) }
    }

    /// Index of the exposure on screen at a koma.
    pub(super) fn at(&self, koma: usize) -> usize {
        self.cells.partition_point(|cell| cell.koma <= koma).saturating_sub(1)
    }

    /// The poses, for a figure with the given marks.
    pub(super) fn posing<'b>(&'b self, marks: &'b [Point]) -> ScreenPosing<'b> {
        ScreenPosing { on_screen: self, showing: Showing::new(&self.composite, marks) }
    }
}

/// Computes the points on screen, one koma after another.
pub(super) struct ScreenPosing<'a> {
    on_screen: &'a OnScreen<'a>,
    showing: Showing<'a>,
}

impl ScreenPosing<'_> {
    /// Returns the points of a koma, in the file's unit.
    pub(super) fn koma(&mut self, koma: usize) -> Vec<DVec3> {
        let drawing = self.on_screen.cells[self.on_screen.at(koma)].index;
        self.showing.points(drawing, koma)
    }
}
