//! The panels (パネル) around the views: which are shown, and how large they may be.

use std::ops::RangeInclusive;

use egui::{Context, Ui, Vec2};
use web_time::Instant;

use super::task::BUDGET;

/// A panel that can be hidden.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Knobs,
    Curves,
    Sheet,
}

impl Side {
    #[cfg(test)]
    const ALL: [Self; 3] = [Self::Knobs, Self::Curves, Self::Sheet];

    /// Whether it is shown by default. The views come first: expert settings and curves are for who asks for them.
    fn is_usual(self, window: Vec2) -> bool {
        match self {
            Self::Knobs => false,
            Self::Curves => false,
            Self::Sheet => window.x >= 800.0,
        }
    }

    /// Allowed width or height, which leaves room for the views.
    pub(super) fn range(self, window: Vec2) -> RangeInclusive<f32> {
        let (least, most, views) = match self {
            // In a narrow window it replaces the sheet, so that the longest names fit.
            Self::Knobs if is_narrow(window) => (364.0, 460.0, window.x - 360.0),
            Self::Knobs => (280.0, 460.0, window.x - 560.0),
            Self::Curves => (120.0, 640.0, window.y - 400.0),
            Self::Sheet => (236.0, 640.0, window.x - 480.0),
        };
        least..=f32::clamp(views, least, most)
    }
}

/// Whether a window has room for one panel at the side only.
fn is_narrow(window: Vec2) -> bool {
    window.x < 1000.0
}

/// Whether a window is so low that everything has to be in as few rows as possible: a small screen, or a page at 200 %.
pub(super) fn is_low(window: Vec2) -> bool {
    window.y < 520.0
}

/// The person's choice for each panel. `None` shows the panel if the window has room for it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Panels([Option<bool>; 3]);

impl Panels {
    pub(super) fn is_shown(&self, side: Side, window: Vec2) -> bool {
        self.0[side as usize].unwrap_or_else(|| side.is_usual(window))
    }

    /// Hides or shows a panel. In a narrow window, showing the knobs hides the sheet and the other way round.
    pub(super) fn toggle(&mut self, side: Side, window: Vec2) {
        let is_wanted = !self.is_shown(side, window);
        self.0[side as usize] = Some(is_wanted);
        let other = match side {
            Side::Knobs => Side::Sheet,
            Side::Sheet => Side::Knobs,
            Side::Curves => return,
        };
        if is_wanted && is_narrow(window) {
            self.0[other as usize] = Some(false);
        }
    }
}

/// How far the panels were filled since the first clip was opened (登場). In a browser code is slow the first time it
/// runs, and drawing all panels at once would block the page.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Arrival {
    /// Number of panels that the frame before filled.
    filled: usize,
    is_over: bool,
}

/// The panels that are filled in a frame: those of the frame before, one more, and what else begins in its time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turns {
    taken: usize,
    sure: usize,
    end: Instant,
    is_short: bool,
}

impl Arrival {
    /// Returns the turns of this frame, in which all panels have one once they were all filled.
    pub(super) fn turns(&self) -> Turns {
        self.turns_until(Instant::now() + BUDGET)
    }

    fn turns_until(&self, end: Instant) -> Turns {
        let sure = if self.is_over { usize::MAX } else { self.filled + 1 };
        Turns { taken: 0, sure, end, is_short: false }
    }

    /// Notes the turns that were taken. Requests another frame if a panel had none.
    pub(super) fn note(&mut self, turns: Turns, context: &Context) {
        (self.filled, self.is_over) = (turns.taken, !turns.is_short);
        if turns.is_short {
            context.request_repaint();
        }
    }
}

impl Turns {
    /// Takes a turn. Returns whether there was one.
    pub(super) fn take(&mut self) -> bool {
        let is_there = self.taken < self.sure || Instant::now() < self.end;
        self.taken += usize::from(is_there);
        self.is_short |= !is_there;
        is_there
    }

    /// Fills a panel if it has a turn; otherwise only reserves its space.
    pub(super) fn fill(&mut self, ui: &mut Ui, fill: impl FnOnce(&mut Ui)) {
        match self.take() {
            true => fill(ui),
            false => ui.take_available_space(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    #[test]
    fn panels_are_filled_one_more_each_frame_and_all_within_its_time() {
        let (context, now) = (Context::default(), Instant::now());
        let filled = |arrival: &mut Arrival, end| {
            let mut turns = arrival.turns_until(end);
            let filled = (0..6).filter(|_| turns.take()).count();
            arrival.note(turns, &context);
            filled
        };
        let mut slow = Arrival::default();
        let frames: [usize; 8] = std::array::from_fn(|_| filled(&mut slow, now));
        assert_eq!(frames, [1, 2, 3, 4, 5, 6, 6, 6]);
        assert_eq!(filled(&mut Arrival::default(), now + 1000 * BUDGET), 6);
    }

    #[test]
    fn a_panel_is_there_as_there_is_room_until_a_person_says_otherwise() {
        let (large, small) = (vec2(1440.0, 900.0), vec2(720.0, 450.0));
        let mut panels = Panels::default();
        let shown = |panels: &Panels, window| Side::ALL.map(|side| panels.is_shown(side, window));
        assert_eq!(shown(&panels, large), [false, false, true]);
        assert_eq!(shown(&panels, small), [false, false, false], "the views alone");
        panels.toggle(Side::Knobs, small);
        panels.toggle(Side::Curves, small);
        assert_eq!(shown(&panels, small), [true, true, false], "one of the two at the side");
        panels.toggle(Side::Sheet, small);
        assert_eq!(shown(&panels, small), [false, true, true]);
        panels.toggle(Side::Knobs, large);
        assert_eq!(shown(&panels, large), [true, true, true], "a large window has room for both");
    }

    #[test]
    fn views_have_room_beside_the_widest_panels() {
        for window in [vec2(720.0, 450.0), vec2(1024.0, 700.0), vec2(1440.0, 900.0)] {
            let most = |side: Side| *side.range(window).end();
            assert!(window.y - most(Side::Curves) >= 320.0, "{window}");
            assert!(window.x - most(Side::Sheet) >= 480.0, "{window}");
            for side in Side::ALL {
                assert!(!side.range(window).is_empty(), "{side:?} {window}");
            }
        }
    }
}
