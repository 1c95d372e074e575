//! Draws the figures of the strip, the ghosts of genga that went, and the passage that plays under the pointer.

use egui::{Painter, Pos2, Rect, Response, Stroke, Ui, Vec2, pos2, vec2};
use glam::DVec3;

use super::layout::Layout;
use crate::command::Command;
use crate::corrections::Correction;
use crate::difference::{Changed, Shifted};
use crate::icon::{self, Icon};
use crate::label_culling::Room;
use crate::theme::Look;
use crate::view_state::Shown;
use crate::viewport::{Inks, Orbit, draw_body};
use genga::sheet::Source;
use genga_plot::parts::{Posing, Stage};

/// Height of a view in heights of the body, so that arms and jumps have room.
const TALL: f64 = 1.2;
/// Seconds for which the genga under the pointer stands still before its passage plays, so that it can be compared, and
/// koma that the passage rests at its end.
const STILL: f64 = 0.8;
const REST: usize = 8;
/// Side of a button on a figure, in points.
const BUTTON: f32 = 16.0;
/// Place of a sign in the room of its figure, below its buttons, and radius, in points.
const SIGN: Vec2 = vec2(8.0, 26.0);
const RADIUS: f32 = 6.5;

/// The passage from the genga under the pointer to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passage {
    /// Index of the exposure among the cells of the column.
    cell: usize,
    /// Time at which the pointer came, in seconds.
    since: f64,
}

impl Passage {
    /// The passage of an exposure under the pointer. It goes on if it was there before.
    pub(super) fn under(cell: Option<usize>, before: Option<Self>, now: f64) -> Option<Self> {
        let cell = cell?;
        let same = before.filter(|before| before.cell == cell);
        Some(same.unwrap_or(Self { cell, since: now }))
    }

    /// Index of the genga under the pointer among the cells of the column.
    pub(super) fn cell(&self) -> usize {
        self.cell
    }

    /// Koma of the passage, the next genga included.
    fn koma(&self, shown: &Shown<'_>) -> std::ops::Range<usize> {
        let cells = &shown.column().cells;
        let Some(from) = cells.get(self.cell) else { return 0..1 };
        let next = cells[self.cell + 1..].iter().find(|cell| cell.genga.is_some());
        from.koma..next.map_or(from.koma + from.held, |next| next.koma + 1)
    }

    /// Koma that have gone by in this round of the passage. Negative while it stands still.
    fn gone(&self, now: f64, shown: &Shown<'_>) -> f64 {
        let rate = shown.column().clock.koma_rate;
        let round = STILL + (self.koma(shown).len() + REST) as f64 / rate;
        ((now - self.since) % round - STILL) * rate
    }

    /// The koma to be shown. `None` while it rests at its beginning.
    fn at(&self, now: f64, shown: &Shown<'_>) -> Option<usize> {
        let (koma, gone) = (self.koma(shown), self.gone(now, shown));
        (gone >= 0.0).then(|| (koma.start + gone as usize).min(koma.end - 1))
    }

    /// Seconds until the next koma. `None` if nothing moves.
    pub(super) fn wait(&self, now: f64, shown: &Shown<'_>) -> Option<f32> {
        let (rate, gone) = (shown.column().clock.koma_rate, self.gone(now, shown));
        let is_moving = self.koma(shown).len() > 1;
        is_moving
            .then(|| if gone < 0.0 { -gone / rate } else { (1.0 - gone.fract()) / rate } as f32)
    }
}

/// Draws the ghosts of a change and of what the ban under the pointer takes away, then the figures.
pub(super) fn draw(
    painter: &Painter,
    layout: &Layout,
    (figured, passage): (&[usize], Option<(&Passage, f64)>),
    (shown, orbit): (&Shown<'_>, &Orbit),
    (changed, banned): (Option<&Changed>, &[(usize, f64)]),
) {
    let painter = &painter.with_clip_rect(layout.rect.intersect(painter.clip_rect()));
    let mut place = Place::new(layout, shown, orbit);
    let column = shown.column();
    let banned = banned.iter().map(|(koma, place)| (layout.x(*koma), *place));
    let gone = changed.iter().flat_map(|changed| &changed.gone);
    let gone = gone.map(|gone| (layout.x(gone.koma), gone.place));
    ghosts(painter, layout, &mut place, banned.chain(gone), shown);
    let mut posing = shown.on_screen.posing(shown.scene.figure.marks());
    for &own in figured {
        let cell = &column.cells[own];
        let x = layout.x(cell.koma);
        let played = passage.filter(|(passage, _)| passage.cell == own);
        let koma = played.and_then(|(passage, now)| passage.at(now, shown)).unwrap_or(cell.koma);
        let pose = posing.koma(koma);
        draw_body(painter, &place.stage(x, &pose).draw(&pose), Inks::Sides, &shown.look);
    }
    for (sign, at, _) in signs(layout, figured, shown, changed) {
        sign.draw(painter, at, &shown.look);
    }
}

/// Draws genga that are not there, as pale figures where they stood.
fn ghosts(
    painter: &Painter,
    layout: &Layout,
    place: &mut Place<'_>,
    gone: impl Iterator<Item = (f32, f64)>,
    shown: &Shown<'_>,
) {
    let look = &shown.look;
    let mut posing = Posing::new(shown.breakdown.clip, shown.scene.figure.marks());
    let mut room = Room::default();
    for (x, source) in gone {
        let is_seen = layout.rect.x_range().contains(x);
        if !is_seen || !room.take(x, 0.4 * layout.wide) {
            continue;
        }
        let pose = posing.points(Source::At(source));
        let ink = Inks::One(look.faint.gamma_multiply(0.55), 0.8);
        draw_body(painter, &place.stage(x, &pose).draw(&pose), ink, look);
        Sign::Gone.draw(painter, gone_sign(layout, x), look);
    }
}

/// Place of the sign on the ghost of a genga that went.
fn gone_sign(layout: &Layout, x: f32) -> Pos2 {
    layout.slot(x).right_top() + vec2(-8.0, 8.0)
}

/// The signs on the figures of what the last change did to them, with their places and their koma before, from 0.
fn signs(
    layout: &Layout,
    figured: &[usize],
    shown: &Shown<'_>,
    changed: Option<&Changed>,
) -> Vec<(Sign, Pos2, usize)> {
    let sign = |own: &usize| {
        let koma = shown.column().cells[*own].koma;
        let (sign, before) = Sign::of(koma, changed?)?;
        Some((sign, layout.slot(layout.x(koma)).left_top() + SIGN, before))
    };
    figured.iter().filter_map(sign).collect()
}

/// Says of the sign under the pointer what it means.
pub(super) fn explain(
    response: Response,
    layout: &Layout,
    figured: &[usize],
    (shown, changed): (&Shown<'_>, Option<&Changed>),
) -> Response {
    let Some(at) = response.hover_pos() else { return response };
    let gone = changed.iter().flat_map(|changed| &changed.gone);
    let gone = gone.map(|own| (Sign::Gone, gone_sign(layout, layout.x(own.koma)), own.koma));
    let mut signs = signs(layout, figured, shown, changed).into_iter().chain(gone);
    let found = signs.find(|(_, middle, _)| middle.distance(at) <= RADIUS);
    let Some((sign, _, before)) = found else { return response };
    let koma = before + 1;
    response.on_hover_text_at_pointer(match (sign, shown.words.is_japanese()) {
        (Sign::Came, true) => "この変更でできた原画".to_owned(),
        (Sign::Came, false) => "New by the last change".to_owned(),
        (Sign::Gone, true) => format!("この変更でなくなった、コマ{koma}の原画"),
        (Sign::Gone, false) => format!("Gone by the last change: the genga on koma {koma}"),
        (_, true) => format!("この変更でコマ{koma}から移った原画"),
        (_, false) => format!("Moved by the last change. It was on koma {koma}"),
    })
}

/// The sign on a figure of what the last change did to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Gone,
    Came,
    Earlier,
    Later,
}

impl Sign {
    /// The sign of the genga on a koma, and its koma before. `None` if it is as it was.
    fn of(koma: usize, changed: &Changed) -> Option<(Self, usize)> {
        if changed.has_new(koma) {
            return Some((Self::Came, koma));
        }
        let Shifted { from, to } = changed.shift_to(koma)?;
        Some((if to > from { Self::Later } else { Self::Earlier }, from))
    }

    /// Draws it in a disc. It is drawn by lines, so that no font needs it.
    fn draw(self, painter: &Painter, middle: Pos2, look: &Look) {
        let color = if self == Self::Came { look.wall } else { look.faint };
        painter.circle_filled(middle, RADIUS, color);
        let stroke = Stroke::new(1.5, look.paper);
        let line = |from: Vec2, to: Vec2| {
            painter.line_segment([middle + from, middle + to], stroke);
        };
        line(vec2(-3.5, 0.0), vec2(3.5, 0.0));
        let tip = match self {
            Self::Gone => return,
            Self::Came => return line(vec2(0.0, -3.5), vec2(0.0, 3.5)),
            Self::Earlier => vec2(-3.5, 0.0),
            Self::Later => vec2(3.5, 0.0),
        };
        for y in [-2.5, 2.5] {
            line(tip, vec2(0.3 * tip.x, y));
        }
    }
}

/// The stage of one figure after another.
struct Place<'a> {
    stage: Stage,
    shown: &'a Shown<'a>,
}

impl<'a> Place<'a> {
    fn new(layout: &Layout, shown: &'a Shown<'a>, orbit: &Orbit) -> Self {
        let (scene, high) = (shown.scene, f64::from(layout.figures.height()));
        let figure = scene.figure.clone();
        let scale = high / (TALL * figure.height);
        let floor = (0.0, f64::from(layout.figures.max.y) - 0.04 * high);
        Self {
            stage: Stage { figure, view: orbit.view(scene), scale, origin: (0.0, 0.0), at: floor },
            shown,
        }
    }

    /// The stage on which a pose stands over a position, on the floor of the scene.
    fn stage(&mut self, x: f32, pose: &[DVec3]) -> &Stage {
        let below = self.stage.view.see(self.shown.scene.on_floor(pose[0]));
        self.stage.origin = (below.0, below.1);
        self.stage.at.0 = f64::from(x);
        &self.stage
    }
}

/// Shows buttons on the figure under the pointer: pin or unpin it, and forbid it.
pub(super) fn buttons(
    ui: &mut Ui,
    passage: &Passage,
    layout: &Layout,
    shown: &Shown<'_>,
    commands: &mut Vec<Command>,
) {
    let Some(cell) = shown.column().cells.get(passage.cell) else { return };
    let Some(key) = cell.key else { return };
    let (slot, words) = (layout.slot(layout.x(cell.koma)), shown.words);
    let is_set = key.origin.is_set();
    let pin = match is_set {
        true => (words.say("Unpin", "固定を解除"), Correction::TakeBack(key.clone())),
        false => (words.say("Pin", "固定"), Correction::PinKey(key.clone())),
    };
    let place = shown.column().place_of(key);
    let forbid = (words.say("Forbid", "禁止"), Correction::Forbid(key.clone(), place));
    let corner = pos2(slot.center().x - BUTTON - 1.0, slot.min.y - 2.0);
    for (at, (icon, (name, correction))) in
        [(Icon::Pin { is_set }, pin), (Icon::Cross, forbid)].into_iter().enumerate()
    {
        let corner = corner + vec2(at as f32 * (BUTTON + 2.0), 0.0);
        let rect = Rect::from_min_size(corner, vec2(BUTTON, BUTTON));
        if ui.put(rect, |ui: &mut Ui| icon::button(ui, icon, name)).clicked() {
            commands.push(Command::Correct(correction));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_genga_that_came_or_moved_has_a_sign_and_its_koma_before() {
        let shifted = vec![Shifted { from: 9, to: 8 }, Shifted { from: 20, to: 22 }];
        let changed = Changed { came: vec![4, 30], shifted, ..Changed::default() };
        let signs = [4, 8, 9, 22].map(|koma| Sign::of(koma, &changed));
        let wanted =
            [Some((Sign::Came, 4)), Some((Sign::Earlier, 9)), None, Some((Sign::Later, 20))];
        assert_eq!(signs, wanted);
    }
}
