//! Draws what stands around the figures: koma numbers and actions above, the numbers of the genga, every drawing for as
//! long as it stays, the steps of gaits and the standing feet below.

use egui::{Align2, FontId, Painter, Pos2, Rect, Stroke, pos2, vec2};

use super::feet;
use super::layout::Layout;
use crate::label_culling::Room;
use crate::timesheet::badge;
use crate::view_state::Shown;
use genga::time::{Clock, Frame, FrameRate};

/// Room of a koma number, in points.
const NUMBER: f32 = 52.0;
/// Least distance of two circles, and of two ticks, in points.
const APART: f32 = 17.0;
const CLOSEST: f32 = 1.5;
/// Width of a koma from which each drawing is seen alone, in points.
const ALONE: f32 = 2.0;
/// Height of the bar of an inbetween as a share of that of a genga.
const LOWER: f32 = 0.55;

/// Draws everything but the figures.
pub(super) fn draw(painter: &Painter, layout: &Layout, figured: &[usize], shown: &Shown<'_>) {
    numbers(painter, layout, shown);
    rounds(painter, layout, shown);
    passages(painter, layout, shown);
    gaits(painter, layout, shown);
    feet::draw(painter, layout, shown);
    drawings(painter, layout, shown);
    badges(painter, layout, figured, shown);
    for koma in shown.breakdown.actions.koma(shown.column().clock) {
        let x = layout.x(koma);
        if layout.rect.x_range().contains(x) {
            painter.vline(x, layout.rect.y_range(), Stroke::new(1.5, shown.look.action));
        }
    }
}

/// Writes koma, or the frames that they show, as many as fit.
fn numbers(painter: &Painter, layout: &Layout, shown: &Shown<'_>) {
    let (column, look) = (shown.column(), &shown.look);
    let Ok(rate) = FrameRate::new(column.clock.koma_rate) else { return };
    // On the strip a place is a koma.
    let clock = Clock { first: Frame(0), frame_rate: rate, koma_rate: column.clock.koma_rate };
    let all = layout.time.koma(NUMBER, clock);
    for (place, koma) in all.into_iter().filter(|(_, koma)| *koma <= column.length) {
        let number = match shown.counts_frames {
            true => shown.frame_of_koma(koma - 1).0,
            false => koma,
        };
        let at = pos2(layout.time.x(place), layout.rect.min.y + 1.0);
        painter.text(at, Align2::CENTER_TOP, number, FontId::proportional(10.0), look.faint);
    }
}

/// Draws a line where a round of a loop ends and the next begins.
fn rounds(painter: &Painter, layout: &Layout, shown: &Shown<'_>) {
    let Some(repeat) = shown.breakdown.sheet.repeat.filter(|repeat| repeat.koma > 0) else {
        return;
    };
    for koma in (repeat.koma..shown.column().length).step_by(repeat.koma) {
        let x = layout.x(koma);
        painter.vline(x, layout.rect.y_range(), Stroke::new(1.5, shown.look.faint));
    }
}

/// Draws a bar over each passage with settings of its own.
fn passages(painter: &Painter, layout: &Layout, shown: &Shown<'_>) {
    let clock = shown.column().clock;
    for passage in shown.wanted.recipe.scopes.passages.iter() {
        let last = shown.frame(passage.frames.past.0.min(usize::MAX / 2) as f64);
        let [from, to] = [passage.frames.from, last].map(|frame| clock.koma_from_frame(frame));
        let bar = layout.x(from)..=layout.x(to);
        painter.hline(bar, layout.figures.min.y, Stroke::new(3.0, shown.look.playhead));
    }
}

/// Shades every second step of a gait, and marks where its feet come down.
fn gaits(painter: &Painter, layout: &Layout, shown: &Shown<'_>) {
    let look = &shown.look;
    for walk in &shown.column().found.keys.gaits {
        for (at, step) in walk.steps.iter().enumerate() {
            let (from, to) = (layout.time.x(step.contact), layout.time.x(step.next));
            if to < layout.rect.min.x || from > layout.rect.max.x {
                continue;
            }
            if at % 2 == 0 {
                let room = Rect::from_x_y_ranges(from..=to, layout.figures.y_range());
                painter.rect_filled(room, 0.0, look.steady);
            }
            let floor = layout.figures.max.y;
            for x in [from, to] {
                painter.vline(x, floor - 5.0..=floor, Stroke::new(1.5, look.inbetween));
            }
        }
    }
}

/// Draws each drawing as a bar that is as long as it stays. Where koma are thinner than a line, only genga are seen.
fn drawings(painter: &Painter, layout: &Layout, shown: &Shown<'_>) {
    let look = &shown.look;
    let is_alone = layout.koma() >= ALONE;
    let mut room = Room::default();
    for cell in &shown.column().cells[layout.seen(shown)] {
        let (left, right) = (layout.x(cell.koma), layout.x(cell.koma + cell.held));
        let color = look.of_role(cell.drawing.role);
        if !is_alone {
            if cell.genga.is_some() && room.take(left, CLOSEST) {
                painter.vline(left, layout.track, Stroke::new(1.0, color));
            }
            continue;
        }
        let share = if cell.genga.is_some() { 1.0 } else { LOWER };
        let top = layout.track.max - share * layout.track.span();
        let bar = Rect::from_x_y_ranges(left..=right - 1.0, top..=layout.track.max);
        painter.rect_filled(bar, 1.0, color.gamma_multiply(0.35));
        painter.vline(left + 0.75, top..=layout.track.max, Stroke::new(1.5, color));
        if cell.drawing.why.hold_set {
            painter.rect_stroke(bar, 1.0, Stroke::new(1.5, look.genga), egui::StrokeKind::Inside);
        }
    }
}

/// Draws the numbers of the genga with figures, and of others where there is room.
fn badges(painter: &Painter, layout: &Layout, figured: &[usize], shown: &Shown<'_>) {
    let (cells, look) = (&shown.column().cells, &shown.look);
    let mut next = figured.iter().map(|own| layout.x(cells[*own].koma)).peekable();
    let mut room = Room::default();
    for index in layout.seen(shown) {
        let (cell, x) = (&cells[index], layout.x(cells[index].koma));
        let Some(number) = cell.genga_number() else { continue };
        let (middle, color) = (pos2(x, layout.badges), look.of_role(cell.drawing.role));
        let has_figure = figured.binary_search(&index).is_ok();
        while next.next_if(|other| *other <= x).is_some() {}
        let is_free = next.peek().is_none_or(|other| *other - x >= APART);
        // Numbers with figures stand apart already.
        if room.take(x, APART) && is_free || has_figure {
            stem(painter, layout, middle, shown);
            badge(painter, middle, &number, color, cell.key, look.paper);
        } else if layout.koma() >= ALONE {
            painter.circle_filled(middle, 2.5, color);
        }
    }
}

/// Ties a number to its drawing.
fn stem(painter: &Painter, layout: &Layout, middle: Pos2, shown: &Shown<'_>) {
    let from = middle + vec2(0.0, 8.0);
    painter.vline(from.x, from.y..=layout.track.min, Stroke::new(1.0, shown.look.genga_line));
}
