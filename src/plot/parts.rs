//! What the studio draws with too, so that a figure is one thing everywhere.

pub(crate) use super::cells::{Cell, cells};
pub(crate) use super::figure::{Drawn, Figure};
pub(crate) use super::heat::color as heat;
pub(crate) use super::points::Posing;
pub(crate) use super::ssd::Moves;
pub(crate) use super::stage::{Stage, fitting};
pub(crate) use super::style::{
    END, FAINT, FILTERED, GENGA, GENGA_LINE, INK, LEFT, PAPER, RAW, RIGHT, WALL,
};
pub(crate) use crate::motion::BodySide;
pub(crate) use crate::motion::view::View;
