//! The standing feet (接地) on the strip: for each foot a bar for as long as it stands, in the colour of its side.

use egui::{Painter, Rangef, Response, Stroke};

use super::layout::Layout;
use crate::scene::Stand;
use crate::view_state::Shown;
use genga_plot::parts::BodySide;

/// Width of a bar, and the distance of two, in points.
const WIDE: f32 = 2.0;
const APART: f32 = 3.5;

/// Draws the bars at the feet of the figures.
pub(super) fn draw(painter: &Painter, layout: &Layout, shown: &Shown<'_>) {
    for stand in stands(shown) {
        let stroke = Stroke::new(WIDE, shown.look.of_side(stand.side));
        painter.hline(span(stand, layout, shown), y(stand, layout), stroke);
    }
}

/// Says of the bar under the pointer which foot stands.
pub(super) fn explain(response: Response, layout: &Layout, shown: &Shown<'_>) -> Response {
    let Some(at) = response.hover_pos() else { return response };
    let is_there = |stand: &&Stand| {
        (at.y - y(stand, layout)).abs() <= 0.5 * APART && span(stand, layout, shown).contains(at.x)
    };
    let Some(stand) = stands(shown).find(is_there) else { return response };
    let words = shown.words;
    response.on_hover_text_at_pointer(match stand.side {
        BodySide::Left => words.say("The left foot stands still", "左足が止まって接地"),
        BodySide::Right => words.say("The right foot stands still", "右足が止まって接地"),
        BodySide::Trunk => words.say("A foot stands still", "足が止まって接地"),
    })
}

/// The stands of the source. A loop shows other times of it, and has none.
fn stands<'a>(shown: &Shown<'a>) -> impl Iterator<Item = &'a Stand> {
    let is_loop = shown.breakdown.sheet.repeat.is_some();
    shown.scene.stands.iter().filter(move |_| !is_loop)
}

fn span(stand: &Stand, layout: &Layout, shown: &Shown<'_>) -> Rangef {
    let clock = shown.column().clock;
    let x = |place: f64| layout.time.x((place - clock.place_from_koma(0)) / clock.frames_in_koma());
    Rangef::new(x(stand.from), x(stand.past))
}

/// Height of a bar: that of the first foot is the upper one.
fn y(stand: &Stand, layout: &Layout) -> f32 {
    layout.figures.max.y - 1.0 - APART * if stand.is_first { 1.0 } else { 0.0 }
}
