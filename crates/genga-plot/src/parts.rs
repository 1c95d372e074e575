//! Re-exports the drawing parts that the studio shares, so that a figure looks the same everywhere.

use glam::DVec3;

use super::Camera;
use genga::motion::Clip;

pub use super::drawings::{ShownDrawing, seconds_and_koma, shown_drawings};
pub use super::figure::{Drawn, Figure, FigureBody, Ink, Shape, bones};
pub use super::heat::color as heat;
pub use super::points::{Posing, Showing};
pub use super::ssd::Moves;
pub use super::stage::{Bounds, Stage, fitting};
pub use super::style::{
    END, FAINT, FILTERED, GENGA, GENGA_LINE, INK, LEFT, PAPER, RAW, RIGHT, WALL,
};
pub use genga::motion::seen::view::View;
pub use genga::motion::{BodySide, Cels, Composite};

/// Builds a camera's view of some poses of a clip. A pose lists the positions of its joints, then of its
/// tips.
pub fn seen_by(camera: Camera, clip: &Clip, poses: &[Vec<DVec3>]) -> View {
    camera.view(clip, poses)
}
