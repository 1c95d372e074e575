//! Poses as a page has them: whole numbers.

use glam::DVec3;

use super::figure::{fronts, points};
use crate::motion::seen::view::View;
use crate::plot::figure::Figure;
use crate::plot::stage::Bounds;

/// Steps in a body's height that places are written to.
pub(crate) const STEPS: f64 = 1000.0;

/// Places as whole numbers: steps from the first pose's root, on the floor.
pub(crate) struct Steps {
    from: DVec3,
    /// The length of a step.
    pub(crate) unit: f64,
}

impl Steps {
    /// For a figure in some poses, the first of which stands where all begin.
    pub(crate) fn of(figure: &Figure, view: &View, poses: &[Vec<DVec3>]) -> Self {
        let floor = Bounds::of(figure, view, poses).floor;
        let root = poses[0][0];
        let from = root + view.up * (floor - root.dot(view.up));
        let unit = if figure.height > 0.0 { figure.height / STEPS } else { 1.0 };
        Self { from, unit }
    }

    /// The points of a pose on the page, and where the fronts of the figure look, in thousandths.
    pub(crate) fn all(&self, figure: &Figure, pose: &[DVec3]) -> Vec<i32> {
        let steps = |point: &DVec3| ((*point - self.from) / self.unit).round().to_array();
        let points = points(figure, pose);
        let fronts = fronts(figure, pose);
        let fronts = fronts.iter().flat_map(|front| (*front * 1000.0).round().to_array());
        points.iter().flat_map(steps).chain(fronts).map(|step| step as i32).collect()
    }
}
