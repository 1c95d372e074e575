//! Onion skin (オニオンスキン): the neighbouring drawings, the further the fainter.

use egui::{Color32, Painter};

use super::body;
use crate::plot::parts::{Posing, Stage};
use crate::sheet::Source;
use crate::studio::command::Seen;
use crate::studio::shown::Shown;

/// Neighbours to each side.
const NEIGHBOURS: usize = 2;

/// Draws the neighbours of what is shown: drawings of the result, koma of the source.
pub(super) fn draw(
    painter: &Painter,
    stage: &Stage,
    posing: &mut Posing<'_>,
    seen: Seen,
    shown: &Shown<'_>,
) {
    let look = &shown.look;
    for away in (1..=NEIGHBOURS).rev() {
        for (source, color) in [
            (neighbour(seen, shown, away, false), look.before),
            (neighbour(seen, shown, away, true), look.after),
        ] {
            let Some(source) = source else { continue };
            let color = faded(color, look.ground, away);
            let drawn = stage.draw(&posing.points(source));
            body::draw(painter, &drawn, body::Inks::One(color, 0.6), look);
        }
    }
}

fn neighbour(seen: Seen, shown: &Shown<'_>, away: usize, is_after: bool) -> Option<Source> {
    let column = &shown.column;
    let step = |at: usize, count: usize| {
        let there = if is_after { at + away } else { at.checked_sub(away)? };
        (there < count).then_some(there)
    };
    if seen == Seen::Source {
        let koma = step(shown.at, column.length)?;
        return Some(Source::At(column.clock.place_from_koma(koma)));
    }
    let cell = step(column.at(shown.at), column.cells.len())?;
    Some(column.cells[cell].drawing.source)
}

fn faded(color: Color32, ground: Color32, away: usize) -> Color32 {
    color.lerp_to_gamma(ground, (away as f32 - 1.0) * 0.5)
}
