//! Onion skin (オニオンスキン): the genga before and after, each side in its own colour, fainter with distance.

use egui::{Color32, Painter};
use glam::DVec3;

use super::body;
use crate::view_state::Shown;
use genga_plot::parts::{ShownDrawing, Stage};

/// Number of neighbours on each side.
const NEIGHBOURS: usize = 2;

/// Draws the neighbours of the drawing shown. `pose` returns the points of a koma.
pub(super) fn draw(
    painter: &Painter,
    stage: &Stage,
    shown: &Shown<'_>,
    mut pose: impl FnMut(usize) -> Vec<DVec3>,
) {
    let look = &shown.look;
    let [before, after] = neighbours(shown);
    for away in (0..NEIGHBOURS).rev() {
        for (koma, color) in [(&before, look.before), (&after, look.after)] {
            let Some(koma) = koma.get(away) else { continue };
            let color = faded(color, look.ground, away);
            let drawn = stage.draw(&pose(*koma));
            body::draw(painter, &drawn, body::Inks::One(color, 0.6), look);
        }
    }
}

/// The koma of the genga before and after the play head, nearest first.
fn neighbours(shown: &Shown<'_>) -> [Vec<usize>; 2] {
    let on_screen = &shown.on_screen;
    let now = on_screen.at(shown.at);
    let (before, after) = on_screen.cells.split_at(now);
    let kept = |cell: &&ShownDrawing<'_>| cell.drawing.role.is_kept();
    let before = before.iter().rev().filter(kept).take(NEIGHBOURS);
    let after = after.iter().skip(1).filter(kept).take(NEIGHBOURS);
    [before.map(|cell| cell.koma).collect(), after.map(|cell| cell.koma).collect()]
}

fn faded(color: Color32, ground: Color32, away: usize) -> Color32 {
    color.lerp_to_gamma(ground, away as f32 * 0.5)
}
