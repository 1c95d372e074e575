//! What the studio draws with too, so that a figure is one thing everywhere.

use glam::DVec3;

use super::Camera;
use crate::motion::Clip;

pub(crate) use super::drawings::{ShownDrawing, shown_drawings};
pub(crate) use super::figure::{Drawn, Figure, FigureBody, Ink, Shape, bones};
pub(crate) use super::heat::color as heat;
pub(crate) use super::points::{Posing, Showing};
pub(crate) use super::ssd::Moves;
pub(crate) use super::stage::{Stage, fitting};
pub(crate) use super::style::{
    END, FAINT, FILTERED, GENGA, GENGA_LINE, INK, LEFT, PAPER, RAW, RIGHT, WALL,
};
pub(crate) use crate::motion::seen::view::View;
pub(crate) use crate::motion::{BodySide, Cels, Composite};

/// What a camera sees of some poses of a clip, each the positions of its joints and then of its tips.
pub(crate) fn seen_by(camera: Camera, clip: &Clip, poses: &[Vec<DVec3>]) -> View {
    camera.view(clip, poses)
}
