//! The movement into each koma (動きの大きさ): √SSD of the sheet before anything was left out, and in front of it that of the
//! result.

use egui::{Align2, FontId, Painter, Rect, Stroke, pos2, vec2};

use crate::column::KeyedCell;
use crate::counts::moves;
use crate::time_axis::Scale;
use crate::view_state::Shown;

/// Width of the result's bars, as a share of a koma.
const SHARE: f32 = 0.5;

/// Draws the lane. Bars are as high as the root of the SSD, so that twice the height means twice the distance.
pub(super) fn draw(painter: &Painter, rect: Rect, time: &Scale, shown: &Shown<'_>) {
    let (look, breakdown) = (&shown.look, &shown.breakdown);
    let column = shown.column();
    let layers = [column.spaced, column.layer];
    let [before, after] = layers.map(|layer| moves(breakdown, &column.found, layer));
    let most = before.largest().max(after.largest()).sqrt();
    let clipped = painter.with_clip_rect(rect.intersect(painter.clip_rect()));
    let clock = &shown.column().clock;
    let bar = |koma: usize, ssd: f64, share: f32| {
        let [left, right] = [koma, koma + 1].map(|koma| time.x(clock.place_from_koma(koma)));
        let half = 0.5 * share * (right - left).max(1.0);
        let high = if most > 0.0 { (ssd.sqrt() / most) as f32 * rect.height() } else { 0.0 };
        // A koma shows its drawing from its beginning; the bar of the step into it stands in its middle.
        let middle = 0.5 * (left + right);
        Rect::from_min_max(pos2(middle - half, rect.max.y - high), pos2(middle + half, rect.max.y))
    };
    // If a point of the window has many koma, only the highest bar is drawn.
    let across = time.x(clock.place_from_koma(1)) - time.x(clock.place_from_koma(0));
    let bunch = (1.0 / across.max(1e-3)).floor().max(1.0) as usize;
    let seen = |koma: usize| {
        let x = time.x(clock.place_from_koma(koma));
        x >= rect.min.x - 2.0 * across.max(1.0) && x <= rect.max.x
    };
    for (at, bunched) in before.ssd.chunks(bunch).enumerate().filter(|(at, _)| seen(at * bunch)) {
        let ssd = bunched.iter().copied().fold(0.0, f64::max);
        if ssd > 0.0 {
            clipped.rect_filled(bar(at * bunch, ssd, 0.92), 0.0, look.grid);
        }
    }
    let mut cells = shown.column().cells.as_slice();
    while let [first, ..] = cells {
        let is_with = |cell: &&KeyedCell<'_>| cell.koma / bunch == first.koma / bunch;
        let (bunched, rest) = cells.split_at(cells.iter().take_while(is_with).count());
        cells = rest;
        if !seen(first.koma) {
            continue;
        }
        let ssd = bunched.iter().map(|cell| after.ssd[cell.koma]).fold(0.0, f64::max);
        let is_after_a_gap = bunched.iter().any(|cell| cell.drawing.why.omitted_before > 0);
        let color = if is_after_a_gap { look.genga } else { look.wall };
        clipped.rect_filled(bar(first.koma, ssd, SHARE), 0.0, color);
    }
    painter.hline(rect.x_range(), rect.max.y, Stroke::new(1.0, look.grid));
    let number = if most < 10.0 { (most * 10.0).round() / 10.0 } else { most.round() };
    let at = rect.min - vec2(4.0, 0.0);
    painter.text(at, Align2::RIGHT_TOP, number, FontId::proportional(10.0), look.faint);
}
