//! Colours (色), by day and by night. By day they are those of the pictures.

use egui::{Color32, Theme};

use crate::plot::parts::{self, BodySide};
use crate::sheet::Role;

/// The colours of everything that is drawn by hand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    pub(super) genga: Color32,
    pub(super) genga_line: Color32,
    pub(super) wall: Color32,
    pub(super) inbetween: Color32,
    pub(super) end: Color32,
    pub(super) ink: Color32,
    pub(super) faint: Color32,
    pub(super) grid: Color32,
    pub(super) raw: Color32,
    pub(super) filtered: Color32,
    /// Where a joint counts as steady.
    pub(super) steady: Color32,
    pub(super) left: Color32,
    pub(super) right: Color32,
    pub(super) paper: Color32,
    pub(super) ground: Color32,
    pub(super) shadow: Color32,
    pub(super) before: Color32,
    pub(super) after: Color32,
    /// Where an action begins.
    pub(super) action: Color32,
    pub(super) playhead: Color32,
    pub(super) chosen: Color32,
}

const fn gray(value: u8) -> Color32 {
    Color32::from_gray(value)
}

impl Look {
    pub(super) fn of(theme: Theme) -> Self {
        match theme {
            Theme::Light => Self::day(),
            Theme::Dark => Self::night(),
        }
    }

    fn day() -> Self {
        let of = |color: plotters::style::RGBColor| Color32::from_rgb(color.0, color.1, color.2);
        Self {
            genga: of(parts::GENGA),
            genga_line: of(parts::GENGA_LINE),
            wall: of(parts::WALL),
            inbetween: gray(122),
            end: of(parts::END),
            ink: of(parts::INK),
            faint: of(parts::FAINT),
            grid: Color32::from_rgb(218, 222, 226),
            raw: of(parts::RAW),
            filtered: of(parts::FILTERED),
            steady: Color32::from_rgb(232, 237, 241),
            left: of(parts::LEFT),
            right: of(parts::RIGHT),
            paper: of(parts::PAPER),
            ground: Color32::from_rgb(240, 242, 244),
            shadow: Color32::from_rgb(219, 223, 227),
            before: Color32::from_rgb(214, 160, 178),
            after: Color32::from_rgb(146, 190, 160),
            action: Color32::from_rgb(120, 84, 160),
            playhead: Color32::from_rgb(0, 128, 96),
            chosen: Color32::from_rgb(214, 240, 230),
        }
    }

    fn night() -> Self {
        Self {
            genga: Color32::from_rgb(240, 108, 72),
            genga_line: Color32::from_rgb(122, 62, 46),
            wall: Color32::from_rgb(92, 170, 236),
            inbetween: gray(150),
            end: gray(208),
            ink: gray(222),
            faint: gray(146),
            grid: gray(54),
            raw: gray(92),
            filtered: gray(214),
            steady: Color32::from_rgb(36, 42, 48),
            left: Color32::from_rgb(92, 170, 236),
            right: Color32::from_rgb(240, 164, 56),
            paper: gray(24),
            ground: gray(30),
            shadow: gray(16),
            before: Color32::from_rgb(122, 76, 94),
            after: Color32::from_rgb(62, 108, 80),
            action: Color32::from_rgb(176, 140, 220),
            playhead: Color32::from_rgb(72, 208, 160),
            chosen: Color32::from_rgb(24, 62, 50),
        }
    }

    /// The colour of a drawing.
    pub(super) fn of_role(&self, role: Role) -> Color32 {
        match role {
            Role::Genga => self.genga,
            Role::Inbetween => self.inbetween,
            Role::End => self.end,
        }
    }

    /// The colour of a limb.
    pub(super) fn of_side(&self, side: BodySide) -> Color32 {
        match side {
            BodySide::Left => self.left,
            BodySide::Right => self.right,
            BodySide::Trunk => self.ink,
        }
    }
}
