//! The movement into each koma (動きの大きさ): √SSD of the sheet before anything was left out, and of the result
//! over it.

use egui::{Align2, FontId, Painter, Rect, Stroke, pos2, vec2};

use super::lane;
use super::time::Scale;
use crate::plot::parts::Moves;
use crate::studio::shown::Shown;

/// How much of a koma the bars of the result take.
const SHARE: f32 = 0.5;

/// Draws the lane. Bars are as high as the root of the SSD, so that twice as high is twice as far.
pub(super) fn draw(painter: &Painter, rect: Rect, time: &Scale, shown: &Shown<'_>) {
    let (look, breakdown) = (&shown.look, &shown.breakdown);
    let column = shown.column();
    let [before, after] = [column.spaced, column.layer]
        .map(|layer| Moves::of(breakdown.clip, layer, breakdown.screen));
    let most = before.largest().max(after.largest()).sqrt();
    let clipped = painter.with_clip_rect(rect.intersect(painter.clip_rect()));
    let clock = &shown.column().clock;
    let bar = |koma: usize, ssd: f64, share: f32| {
        let [left, right] = [koma, koma + 1].map(|koma| time.x(clock.place_from_koma(koma)));
        let half = 0.5 * share * (right - left).max(1.0);
        let high = if most > 0.0 { (ssd.sqrt() / most) as f32 * rect.height() } else { 0.0 };
        // A koma shows its drawing from its beginning on; the step into it stands in its middle.
        let middle = 0.5 * (left + right);
        Rect::from_min_max(pos2(middle - half, rect.max.y - high), pos2(middle + half, rect.max.y))
    };
    for (koma, ssd) in before.ssd.iter().enumerate().filter(|(_, ssd)| **ssd > 0.0) {
        clipped.rect_filled(bar(koma, *ssd, 0.92), 0.0, look.grid);
    }
    for cell in &shown.column().cells {
        let is_after_a_gap = cell.drawing.why.omitted_before > 0;
        let color = if is_after_a_gap { look.genga } else { look.wall };
        clipped.rect_filled(bar(cell.koma, after.ssd[cell.koma], SHARE), 0.0, color);
    }
    painter.hline(rect.x_range(), rect.max.y, Stroke::new(1.0, look.grid));
    lane::title(painter, rect, shown.words.say("Movement √SSD", "動きの大きさ √SSD"), look);
    let number = if most < 10.0 { (most * 10.0).round() / 10.0 } else { most.round() };
    let at = rect.min - vec2(4.0, 0.0);
    painter.text(at, Align2::RIGHT_TOP, number, FontId::proportional(10.0), look.faint);
}
