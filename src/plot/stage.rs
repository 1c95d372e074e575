//! The stage: where in a picture a point of the world comes, the same for all poses.

use glam::DVec3;

use crate::motion::seen::view::View;
use crate::plot::figure::{Drawn, Figure};
use crate::plot::px::Point;

/// The box round everything that is shown, seen from one side, in units of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) floor: f64,
    pub(crate) top: f64,
}

impl Bounds {
    /// Round some poses, with room for a head and for the thickness of lines.
    pub(crate) fn of<'a>(
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

    #[cfg(feature = "pictures")]
    pub(crate) fn height(&self) -> f64 {
        self.top - self.floor
    }
}

/// A camera with a scale, and the point of the world that stands at a point of the picture.
#[derive(Debug, Clone)]
pub(crate) struct Stage {
    pub(crate) figure: Figure,
    pub(crate) view: View,
    /// px for a unit of the file.
    pub(crate) scale: f64,
    /// Right and up of what stands at [`Stage::at`], in units of the file.
    pub(crate) origin: (f64, f64),
    /// A point of the picture, in px.
    pub(crate) at: Point,
}

impl Stage {
    /// The stage on which a box fills as much of a picture as it can: in the middle, on the floor.
    #[cfg(feature = "pictures")]
    pub(crate) fn filling(
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

    /// Where a point of the world comes.
    pub(crate) fn place(&self, point: DVec3) -> Point {
        let (right, up, _) = self.view.see(point);
        let (x, y) = self.at;
        (x + (right - self.origin.0) * self.scale, y - (up - self.origin.1) * self.scale)
    }

    /// A pose in its place.
    pub(crate) fn draw(&self, pose: &[DVec3]) -> Drawn {
        self.figure.draw(pose, &self.view, self.scale, |point| self.place(point))
    }

    /// A pose with its middle over a point on the floor, wherever it is in the world.
    pub(crate) fn draw_over(&self, pose: &[DVec3], at: Point) -> Drawn {
        let (left, right) = self.view.sides(self.figure.shown(pose));
        let origin = (0.5 * (left + right), self.origin.1);
        Self { origin, at, ..self.clone() }.draw(pose)
    }
}

/// px for a unit, so that a box fits into another; bodies without any size are not blown up.
pub(crate) fn fitting((width, height): (f64, f64), room: (f64, f64)) -> f64 {
    let scale = (room.0 / width.max(1e-9)).min(room.1 / height.max(1e-9));
    if scale.is_finite() && width.max(height) > 1e-9 { scale } else { 1.0 }
}

/// The largest width of any pose and the largest height over a common floor, in units of the file.
pub(crate) fn largest(
    figure: &Figure,
    view: &View,
    poses: &[Vec<DVec3>],
    floor: f64,
) -> (f64, f64) {
    let boxes = poses.iter().map(|pose| Bounds::of(figure, view, [pose]));
    boxes.fold((0.0, 0.0), |(wide, high): (f64, f64), bounds| {
        (wide.max(bounds.width()), high.max(bounds.top - floor))
    })
}
