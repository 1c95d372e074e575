//! Converts poses to whole numbers, as a page stores them.

use glam::DVec3;

use super::figure::{fronts, points};
use crate::figure::Figure;
use crate::stage::Bounds;
use genga::motion::seen::view::View;

/// Number of steps in a body's height: the precision of coordinates.
pub(crate) const STEPS: f64 = 1000.0;

/// A grid of whole steps, counted from the first pose's root on the floor.
pub(crate) struct Steps {
    from: DVec3,
    /// Length of a step, in units of the file.
    pub(crate) unit: f64,
}

impl Steps {
    /// Builds the grid for a figure in some poses. Its origin lies under the root of the first pose.
    pub(crate) fn new(figure: &Figure, view: &View, poses: &[Vec<DVec3>]) -> Self {
        let floor = Bounds::new(figure, view, poses).floor;
        let root = poses[0][0];
        let from = root + view.up * (floor - root.dot(view.up));
        let unit = if figure.height > 0.0 { figure.height / STEPS } else { 1.0 };
        Self { from, unit }
    }

    /// Returns the points of a pose in steps, then the directions of the figure's fronts in thousandths.
    pub(crate) fn all(&self, figure: &Figure, pose: &[DVec3]) -> Vec<i32> {
        let steps = |point: &DVec3| ((*point - self.from) / self.unit).round().to_array();
        let points = points(figure, pose);
        let fronts = fronts(figure, pose);
        let fronts = fronts.iter().flat_map(|front| (*front * 1000.0).round().to_array());
        points.iter().flat_map(steps).chain(fronts).map(|step| step as i32).collect()
    }
}
