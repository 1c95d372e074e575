//! The camera of a view: a standard side, turned, tilted, moved and zoomed by hand.

use egui::{Pos2, Rect, Vec2, pos2};
use glam::DVec3;

use crate::command::Standard;
use crate::scene::Scene;
use genga_plot::Camera;
use genga_plot::parts::{Stage, View, fitting};

/// Downward tilt of the three-quarter view in radians.
const TILT: f64 = 0.2;
/// Radians turned per point of pointer movement: a full turn in 720.
const TURN: f64 = std::f64::consts::TAU / 720.0;
/// Width and height that a following view shows, in heights of the body.
const NEAR: (f64, f64) = (1.2, 1.35);
/// Share of a view that the motion fills.
const FILLED: f64 = 0.86;

/// The camera shared by both halves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Orbit {
    standard: Standard,
    /// Radians to the right about the scene's up axis.
    yaw: f64,
    /// Downward tilt in radians.
    pitch: f64,
    zoom: f64,
    /// Offset to the right and up, in the file's unit.
    pan: (f64, f64),
    /// Whether the camera follows the body.
    pub(crate) follows: bool,
}

impl Default for Orbit {
    fn default() -> Self {
        Self::from(Standard::ThreeQuarter)
    }
}

impl From<Standard> for Orbit {
    fn from(standard: Standard) -> Self {
        let pitch = match standard {
            Standard::Front | Standard::Side => 0.0,
            Standard::Top => std::f64::consts::FRAC_PI_2,
            Standard::ThreeQuarter => TILT,
        };
        Self { standard, yaw: 0.0, pitch, zoom: 1.0, pan: (0.0, 0.0), follows: false }
    }
}

impl Orbit {
    /// The standard side. `None` once the camera was turned by hand.
    pub(crate) fn standard(&self) -> Option<Standard> {
        let still = Self::from(self.standard);
        ((self.yaw, self.pitch) == (still.yaw, still.pitch)).then_some(self.standard)
    }

    /// Turns by a pointer movement. The tilt is clamped so that the floor is never seen from below.
    pub(super) fn turn(&mut self, way: Vec2) {
        self.yaw -= f64::from(way.x) * TURN;
        let down = self.pitch + f64::from(way.y) * TURN;
        self.pitch = down.clamp(0.0, std::f64::consts::FRAC_PI_2);
    }

    /// Moves the view along with the pointer.
    pub(super) fn pan(&mut self, way: Vec2, scene: &Scene, rect: Rect) {
        let scale = self.scale(&self.view(scene), scene, rect);
        self.pan.0 -= f64::from(way.x) / scale;
        self.pan.1 += f64::from(way.y) / scale;
    }

    /// Zooms in by a factor, or out below 1.
    pub(crate) fn zoom_by(&mut self, factor: f32) {
        self.zoom = (self.zoom * f64::from(factor)).clamp(0.2, 40.0);
    }

    /// Shows the whole motion again.
    pub(crate) fn fit(&mut self) {
        (self.zoom, self.pan) = (1.0, (0.0, 0.0));
    }

    pub(crate) fn view(&self, scene: &Scene) -> View {
        let level = scene.view(match self.standard {
            Standard::Front | Standard::Top => Camera::Front,
            Standard::Side => Camera::Side,
            Standard::ThreeQuarter => Camera::ThreeQuarter,
        });
        let (sin, cos) = self.yaw.sin_cos();
        let right = level.right * cos - level.near * sin;
        let near = level.near * cos + level.right * sin;
        let (sin, cos) = self.pitch.sin_cos();
        View { right, up: level.up * cos - near * sin, near: near * cos + level.up * sin }
    }

    /// The stage that fills a rectangle of the window.
    pub(super) fn stage(&self, scene: &Scene, rect: Rect, anchor: DVec3) -> Stage {
        let view = self.view(scene);
        let (left, right, low, high) = reach(&view, scene);
        let middle = match self.follows {
            true => (view.see(anchor).0, view.see(anchor).1),
            false => (0.5 * (left + right), 0.5 * (low + high)),
        };
        let origin = (middle.0 + self.pan.0, middle.1 + self.pan.1);
        let scale = self.scale(&view, scene, rect);
        let middle = rect.center();
        let at = (f64::from(middle.x), f64::from(middle.y));
        Stage { figure: scene.figure.clone(), view, scale, origin, at }
    }

    /// Points of the window per unit of the file.
    fn scale(&self, view: &View, scene: &Scene, rect: Rect) -> f64 {
        let room = (f64::from(rect.width()) * FILLED, f64::from(rect.height()) * FILLED);
        let (left, right, low, high) = reach(view, scene);
        let size = match self.follows {
            true => (NEAR.0 * scene.figure.height, NEAR.1 * scene.figure.height),
            false => (right - left, high - low),
        };
        fitting(size, room) * self.zoom
    }
}

/// Left, right, low and high bounds of everything the motion reaches, as seen in a view.
fn reach(view: &View, scene: &Scene) -> (f64, f64, f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
    let head = 0.06 * scene.figure.height;
    scene.reached.iter().fold(start, |(left, right, low, high), point: &DVec3| {
        let (x, y, _) = view.see(*point);
        (left.min(x - head), right.max(x + head), low.min(y), high.max(y + head))
    })
}

/// Converts a point of the stage to a point of the window.
pub(super) fn position((x, y): (f64, f64)) -> Pos2 {
    pos2(x as f32, y as f32)
}

/// Position of a point of the world in the window.
pub(super) fn placed(stage: &Stage, point: DVec3) -> Pos2 {
    position(stage.place(point))
}
