//! Maps points of the world to points of a picture, in the same way for all poses.

use glam::DVec3;

use crate::figure::{Drawn, Figure};
use crate::paper_point::Point;
use genga::motion::seen::view::View;

/// The bounding box of all poses shown, seen from one side, in units of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Left edge.
    pub left: f64,
    /// Right edge.
    pub right: f64,
    /// Lower edge.
    pub floor: f64,
    /// Upper edge.
    pub top: f64,
}

impl Bounds {
    /// Computes the box round some poses, with room for a head and for the thickness of lines.
    pub(crate) fn new<'a>(
        figure: &Figure,
        view: &View,
        poses: impl IntoIterator<Item = &'a Vec<DVec3>>,
    ) -> Self {
        let mut bounds = Self {
            left: f64::INFINITY,
            right: f64::NEG_INFINITY,
            floor: f64::INFINITY,
            top: f64::NEG_INFINITY,
        };
        for pose in poses {
            let (left, right) = view.sides(figure.shown(pose));
            let head = figure.reach(pose);
            bounds.left = bounds.left.min(left - head);
            bounds.right = bounds.right.max(right + head);
            for point in figure.shown(pose) {
                let up = view.see(*point).1;
                bounds.floor = bounds.floor.min(up);
                bounds.top = bounds.top.max(up + head);
            }
        }
        bounds
    }

    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }

    #[cfg(feature = "images")]
    pub(crate) fn height(&self) -> f64 {
        self.top - self.floor
    }
}

/// A camera with a scale and an anchor: a point of the world and the point of the picture that shows it.
#[derive(Debug, Clone)]
pub struct Stage {
    /// Figure to draw.
    pub figure: Figure,
    /// View of the camera.
    pub view: View,
    /// Scale in px per unit of the file.
    pub scale: f64,
    /// Coordinates (right, up) of the point of the world shown at [`Stage::at`], in units of the file.
    pub origin: (f64, f64),
    /// Point of the picture at which the origin is shown, in px.
    pub at: Point,
}

impl Stage {
    /// Builds the stage on which a box fills a picture as far as it can, centred and standing on the floor.
    #[cfg(feature = "images")]
    pub fn filling(
        figure: Figure,
        view: View,
        bounds: &Bounds,
        (x, floor): Point,
        (width, height): (f64, f64),
    ) -> Self {
        let scale = fitting((bounds.width(), bounds.height()), (width, height));
        let middle = 0.5 * (bounds.left + bounds.right);
        Self { figure, view, scale, origin: (middle, bounds.floor), at: (x, floor) }
    }

    /// Returns the point of the picture that shows a point of the world.
    pub fn place(&self, point: DVec3) -> Point {
        let (right, up, _) = self.view.see(point);
        let (x, y) = self.at;
        (x + (right - self.origin.0) * self.scale, y - (up - self.origin.1) * self.scale)
    }

    /// Draws a pose at its place in the world.
    pub fn draw(&self, pose: &[DVec3]) -> Drawn {
        self.figure.draw(pose, &self.view, self.scale, |point| self.place(point))
    }

    /// Draws a pose with its middle over a point on the floor, regardless of its place in the world.
    pub fn draw_over(&self, pose: &[DVec3], at: Point) -> Drawn {
        let (left, right) = self.view.sides(self.figure.shown(pose));
        let origin = (0.5 * (left + right), self.origin.1);
        Self { origin, at, ..self.clone() }.draw(pose)
    }
}

/// Returns the scale, in px per unit, at which a box fits into another; 1 for a box without any size.
pub fn fitting((width, height): (f64, f64), room: (f64, f64)) -> f64 {
    let scale = (room.0 / width.max(1e-9)).min(room.1 / height.max(1e-9));
    if scale.is_finite() && width.max(height) > 1e-9 { scale } else { 1.0 }
}

/// Returns the largest width of any pose and the largest height over a common floor, in units of the file.
pub(crate) fn largest(
    figure: &Figure,
    view: &View,
    poses: &[Vec<DVec3>],
    floor: f64,
) -> (f64, f64) {
    let boxes = poses.iter().map(|pose| Bounds::new(figure, view, [pose]));
    boxes.fold((0.0, 0.0), |(wide, high): (f64, f64), bounds| {
        (wide.max(bounds.width()), high.max(bounds.top - floor))
    })
}
