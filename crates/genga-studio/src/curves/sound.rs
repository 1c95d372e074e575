//! The waveform (波形) of the sound, below the curves and on the same time axis.

use egui::{Painter, Rect, Stroke};

use crate::time_axis::Scale;
use crate::view_state::Shown;

/// Draws the lane: a line for each point of the window, as long as the sound is loud.
pub(super) fn draw(painter: &Painter, rect: Rect, time: &Scale, shown: &Shown<'_>) {
    let (look, clock) = (&shown.look, shown.column().clock);
    let koma = |x: f32| (time.place(x) - clock.first.0 as f64) / clock.frames_in_koma();
    let middle = rect.center().y;
    for point in 0..rect.width().ceil() as usize {
        let x = rect.min.x + point as f32;
        let level = shown.level(koma(x), koma(x + 1.0)).unwrap_or(0.0);
        let half = 0.5 * level * rect.height();
        if half >= 0.5 {
            painter.vline(x + 0.5, middle - half..=middle + half, Stroke::new(1.0, look.wall));
        }
    }
    painter.hline(rect.x_range(), middle, Stroke::new(1.0, look.grid));
}
