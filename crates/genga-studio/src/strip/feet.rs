//! The standing feet (接地) on the strip: for each foot a bar in the colour of its side for as long as it stands, and where
//! it comes down the word contact beside the number of its genga.

use egui::{Align2, FontId, Painter, Pos2, Rangef, Rect, Response, Stroke, pos2, vec2};

use super::layout::Layout;
use crate::scene::Stand;
use crate::view_state::Shown;
use genga_plot::parts::BodySide;

/// Width of a bar, and the distance of two, in points.
const WIDE: f32 = 2.0;
const APART: f32 = 3.5;

/// Height of the bar's beginning where a foot comes down, in points.
const LANDING: f32 = 6.0;
/// Koma that a genga may stand from a contact and be its genga: its pose is the same to the eye.
const NEAR: f64 = 1.5;
/// Half the room of a number, and the distance of a word from the contact where there is none, in points.
const NUMBER: f32 = 9.5;
const BESIDE: f32 = 2.0;

/// Draws the bars at the feet of the figures, and names the contacts.
pub(super) fn draw(painter: &Painter, layout: &Layout, shown: &Shown<'_>) {
    for stand in stands(shown) {
        let stroke = Stroke::new(WIDE, shown.look.of_side(stand.side));
        let (span, y) = (span(stand, layout, shown), y(stand, layout));
        painter.hline(span, y, stroke);
        if lands(stand, shown) {
            painter.vline(span.min, y - LANDING..=y, stroke);
        }
    }
    let font = FontId::proportional(10.0);
    for Contact { word, place, .. } in contacts(layout, shown) {
        // In the colour of the side such small letters would be hard to read.
        let ink = shown.look.ink;
        painter.text(place.center(), Align2::CENTER_CENTER, word, font.clone(), ink);
    }
}

/// Says of the bar or the word under the pointer which foot stands, and from which koma.
pub(super) fn explain(response: Response, layout: &Layout, shown: &Shown<'_>) -> Response {
    let Some(at) = response.hover_pos() else { return response };
    let is_there = |stand: &&Stand| {
        (at.y - y(stand, layout)).abs() <= 0.5 * APART && span(stand, layout, shown).contains(at.x)
    };
    let named = || contacts(layout, shown).into_iter().find(|contact| contact.is_at(at));
    let stand = stands(shown).find(is_there).or_else(|| named().map(|contact| contact.stand));
    let Some(stand) = stand else { return response };
    let from = shown.named(shown.frame(stand.from));
    response.on_hover_text_at_pointer(match (stand.side, shown.words.is_japanese()) {
        (BodySide::Left, false) => format!("The left foot stands still from {from}"),
        (BodySide::Right, false) => format!("The right foot stands still from {from}"),
        (BodySide::Trunk, false) => format!("A foot stands still from {from}"),
        (BodySide::Left, true) => format!("左足が{from}から止まって接地"),
        (BodySide::Right, true) => format!("右足が{from}から止まって接地"),
        (BodySide::Trunk, true) => format!("足が{from}から止まって接地"),
    })
}

/// Says which foot comes down with the genga that begins on a koma, if one does: that of the word on the strip.
pub(crate) fn contact_at(koma: usize, shown: &Shown<'_>) -> Option<&'static str> {
    let is_own = |stand: &&Stand| genga_of(stand, shown) == Some(koma);
    let landing = stands(shown).filter(|stand| lands(stand, shown)).find(is_own)?;
    Some(match landing.side {
        BodySide::Left => shown.words.say("contact of the left foot", "左足の接地"),
        BodySide::Right => shown.words.say("contact of the right foot", "右足の接地"),
        BodySide::Trunk => shown.words.say("contact of a foot", "足の接地"),
    })
}

/// Returns the koma of the genga with which a foot comes down: the nearest, if it is near.
fn genga_of(stand: &Stand, shown: &Shown<'_>) -> Option<usize> {
    let (clock, cells) = (shown.column().clock, &shown.column().cells);
    let place = (stand.from - clock.place_from_koma(0)) / clock.frames_in_koma();
    let away = |koma: usize| (place - koma as f64).abs();
    let genga = cells.iter().filter(|cell| cell.genga.is_some()).map(|cell| cell.koma);
    let nearest = genga.min_by(|a, b| away(*a).total_cmp(&away(*b)))?;
    (away(nearest) <= NEAR).then_some(nearest)
}

/// A contact that is named.
struct Contact<'a> {
    stand: &'a Stand,
    word: &'static str,
    /// Room of the word, and of the number beside which it stands.
    place: Rect,
    number: Rect,
}

impl Contact<'_> {
    fn is_at(&self, at: Pos2) -> bool {
        self.place.contains(at) || self.number.contains(at)
    }
}

/// The contacts in view that have room for a word, which stands beside the number of the nearest genga.
fn contacts<'a>(layout: &Layout, shown: &Shown<'a>) -> Vec<Contact<'a>> {
    let cells = &shown.column().cells[layout.seen(shown)];
    let genga: Vec<f32> =
        cells.iter().filter(|cell| cell.genga.is_some()).map(|cell| layout.x(cell.koma)).collect();
    let mut landings: Vec<(&Stand, f32)> = stands(shown)
        .filter(|stand| lands(stand, shown))
        .map(|stand| (stand, span(stand, layout, shown).min))
        .filter(|(_, x)| layout.rect.x_range().contains(*x))
        .collect();
    landings.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
    let mut taken = f32::NEG_INFINITY;
    let mut named = Vec::new();
    for (stand, x) in landings {
        let own = genga_of(stand, shown).map(|koma| layout.x(koma));
        let (x, apart) = own.map_or((x, BESIDE), |own| (own, NUMBER));
        let is_free = |from: f32, wide: f32| {
            let touches = |own: &f32| *own > from - NUMBER && *own < from + wide + NUMBER;
            from >= taken && !genga.iter().any(touches)
        };
        let places = words(shown).iter().flat_map(|(word, wide)| {
            [x + apart, x - apart - wide].map(|from| (*word, from, *wide))
        });
        if let Some((word, from, wide)) = { places }.find(|(_, from, wide)| is_free(*from, *wide)) {
            taken = from + wide + BESIDE;
            let room = |middle: f32, wide: f32| {
                Rect::from_center_size(pos2(middle, layout.badges), vec2(wide, 2.0 * NUMBER))
            };
            let number = own.map_or(Rect::NOTHING, |own| room(own, 2.0 * NUMBER));
            named.push(Contact { stand, word, place: room(from + 0.5 * wide, wide), number });
        }
    }
    named
}

/// The words for a contact and their widths in points, the plainest first. The short ones are for close genga.
fn words(shown: &Shown<'_>) -> &'static [(&'static str, f32)] {
    match shown.words.is_japanese() {
        true => &[("接地", 22.0), ("接", 11.0)],
        false => &[("contact", 38.0), ("cont.", 24.0), ("c.", 9.0)],
    }
}

/// Whether the foot comes down there, and does not stand from the beginning.
fn lands(stand: &Stand, shown: &Shown<'_>) -> bool {
    stand.from > shown.column().clock.place_from_koma(0)
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
