//! The viewport (画面): source and result as figures, side by side or one of them alone.

mod body;
mod floor;
mod ghosts;
mod orbit;
mod picture;
mod sides;
mod trails;

use glam::DVec3;

use egui::{
    FontId, Frame, Id, Margin, Painter, PointerButton, Rect, Response, Role, Sense, Ui, pos2, vec2,
};

use super::command::{Command, Placement, Seen};
use super::focus::{self, Part};
use super::scene::Scene;
use super::view_state::Shown;
use genga::sheet::Source;
use genga_plot::parts::{Posing, Stage};

pub(super) use body::{Inks, draw as draw_body};
pub(super) use orbit::Orbit;

/// State of the viewport: the camera, and what is shown.
#[derive(Debug, Clone)]
pub(super) struct Viewport {
    pub(super) orbit: Orbit,
    pub(super) seen: Seen,
    /// Whether the onion skin is shown.
    pub(super) onion: bool,
    /// Whether the trails of the chosen joints are shown.
    pub(super) trails: bool,
    /// Whether the source is shown exaggerated, over the captured motion.
    pub(super) exaggerated: bool,
    /// Placement of reference pictures.
    pub(super) placement: Placement,
}

impl Default for Viewport {
    fn default() -> Self {
        Self {
            orbit: Orbit::default(),
            seen: Seen::Both,
            onion: false,
            trails: true,
            exaggerated: true,
            placement: Placement::default(),
        }
    }
}

/// Pointer movement that turns or pans a view as far as one key press, in points.
const A_PRESS: f32 = 20.0;
/// Gap between the two halves in points.
const GAP: f32 = 6.0;

impl Viewport {
    /// Creates the viewport of a scene. The camera follows a body that travels far.
    pub(super) fn new(scene: &Scene) -> Self {
        let mut viewport = Self::default();
        viewport.orbit.follows = scene.goes_far();
        viewport
    }

    /// Draws both halves and handles pointer and arrow keys.
    pub(super) fn show(&mut self, ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let margin = Margin { left: 6, ..Margin::ZERO };
        Frame::NONE.inner_margin(margin).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                let selected = sides::Selected {
                    seen: self.seen,
                    orbit: &self.orbit,
                    onion: self.onion,
                    trails: self.trails,
                    exaggerated: self.exaggerated,
                };
                sides::show(ui, shown, &selected, commands);
            });
        });
        let all = ui.available_rect_before_wrap();
        let mut whole = all;
        if shown.beside.pictures.is_some() && self.placement == Placement::Beside {
            let views = if self.seen == Seen::Both { 2.0 } else { 1.0 };
            whole.max.x -= (all.width() - views * GAP) / (views + 1.0) + GAP;
            picture::show(ui, all.with_min_x(whole.max.x + GAP), shown);
        }
        let anchor = self.anchor(shown);
        let half = vec2(0.5 * (whole.width() - GAP), whole.height());
        let halves: &[(Seen, Rect)] = match self.seen {
            Seen::Both => &[
                (Seen::Source, Rect::from_min_size(whole.min, half)),
                (Seen::Result, Rect::from_min_size(whole.min + vec2(half.x + GAP, 0.0), half)),
            ],
            alone => &[(alone, whole)],
        };
        for (seen, rect) in halves {
            let id = Id::unique(("viewport", *seen == Seen::Source));
            let response = ui.interact(*rect, id, Sense::click_and_drag());
            if halves[0].0 == *seen {
                Part::Views.begins(&response);
            }
            self.handle(ui, &response, shown, commands);
            self.draw(&ui.painter_at(*rect), *rect, *seen, anchor, shown);
            let name = self.heading(*seen, shown);
            response.widget_info(|| egui::WidgetInfo::labeled(Role::Canvas, true, &name));
        }
        ui.advance_cursor_after_rect(all);
    }

    /// The point that a following camera centres on: the body of the source, because its path is smooth.
    fn anchor(&self, shown: &Shown<'_>) -> DVec3 {
        let place = shown.place(shown.at);
        let root = Posing::new(shown.breakdown.source, &[]).points(Source::At(place))[0];
        shown.scene.on_floor(root) + shown.scene.up * (0.5 * shown.scene.figure.height)
    }

    fn handle(
        &mut self,
        ui: &Ui,
        response: &Response,
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) {
        let way = response.drag_delta();
        let is_pan = ui.input(|input| input.modifiers.shift)
            || response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle);
        if response.dragged() && is_pan {
            self.orbit.pan(way, shown.scene, response.rect);
        } else if response.dragged() {
            self.orbit.turn(way);
        }
        if response.double_clicked() {
            commands.push(Command::Fit);
        }
        let (turned, moved) = focus::take_arrows(response);
        self.orbit.turn(turned * A_PRESS);
        self.orbit.pan(moved * A_PRESS, shown.scene, response.rect);
        if response.contains_pointer() {
            let (scroll, pinch) =
                ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            self.orbit.zoom_by(pinch * (scroll * 0.004).exp());
        }
    }

    /// Draws one half.
    fn draw(&self, painter: &Painter, rect: Rect, seen: Seen, anchor: DVec3, shown: &Shown<'_>) {
        painter.rect_filled(rect, 4.0, shown.look.ground);
        if self.placement == Placement::Behind {
            picture::draw(painter, rect, picture::BEHIND, shown);
        }
        let stage = self.orbit.stage(shown.scene, rect, anchor);
        floor::draw(painter, &stage, shown);
        let marks = shown.scene.figure.marks();
        if seen == Seen::Source {
            let place = |koma| Source::At(shown.place(koma));
            let mut captured = Posing::new(shown.breakdown.source, marks);
            let mut drawn = Posing::new(shown.breakdown.clip, marks);
            let is_drawn = self.exaggerated && shown.is_exaggerated();
            let posing = if is_drawn { &mut drawn } else { &mut captured };
            self.body(painter, &stage, seen, shown, |koma| posing.points(place(koma)));
            if is_drawn {
                let pose = stage.draw(&captured.points(place(shown.at)));
                let ink = body::Inks::One(shown.look.faint, 0.6);
                body::draw(painter, &pose, ink, &shown.look);
            }
        } else {
            let mut posing = shown.on_screen.posing(marks);
            self.body(painter, &stage, seen, shown, |koma| posing.koma(koma));
        }
        self.words(painter, rect, seen, shown);
    }

    /// Draws the figure at the play head, with its shadow, neighbours and trails.
    fn body(
        &self,
        painter: &Painter,
        stage: &Stage,
        seen: Seen,
        shown: &Shown<'_>,
        mut pose: impl FnMut(usize) -> Vec<DVec3>,
    ) {
        let now = pose(shown.at);
        floor::shadow(painter, stage, &now, shown);
        if self.onion {
            ghosts::draw(painter, stage, shown, &mut pose);
        }
        body::draw(painter, &stage.draw(&now), body::Inks::Sides, &shown.look);
        if self.trails {
            trails::draw(painter, stage, seen, shown, &mut pose);
        }
    }

    fn words(&self, painter: &Painter, rect: Rect, seen: Seen, shown: &Shown<'_>) {
        let (at, look) = (rect.min + vec2(10.0, 8.0), &shown.look);
        let heading = self.heading(seen, shown);
        let wide = rect.width() - 20.0;
        let galley = painter.layout(heading, FontId::proportional(14.0), look.ink, wide);
        painter.galley(at, galley, look.ink);
        let standing = standing(seen, shown);
        let galley = painter.layout(standing, FontId::proportional(12.0), look.faint, wide);
        let at = pos2(at.x, rect.max.y - 8.0 - galley.size().y);
        painter.galley(at, galley, look.faint);
    }

    fn heading(&self, seen: Seen, shown: &Shown<'_>) -> String {
        let words = shown.words;
        match seen {
            Seen::Source if self.exaggerated && shown.is_exaggerated() => {
                words.say("Source, exaggerated", "素材（誇張後）").into()
            }
            Seen::Source => words.say("Source", "素材").into(),
            _ => words.say("Result", "結果").into(),
        }
    }
}

/// Describes the drawing at the play head in words.
fn standing(seen: Seen, shown: &Shown<'_>) -> String {
    let (words, column) = (shown.words, shown.column());
    if seen == Seen::Source {
        let place = shown.place(shown.at);
        let frame = (place * 10.0).round() / 10.0;
        return match shown.counts_frames {
            true => format!("{} {frame}", words.say("source frame", "素材フレーム")),
            false => format!("{} {}", words.say("koma", "コマ"), shown.at + 1),
        };
    }
    let cell = column.cell(shown.at);
    let number = match (cell.genga_number(), words.is_japanese()) {
        (Some(number), true) => format!("原画 {number}"),
        (Some(number), false) => format!("genga {number}"),
        (None, true) => "中割り".into(),
        (None, false) => "inbetween".into(),
    };
    let (drawing, since, held) = (cell.number(), shown.at - cell.koma + 1, cell.held);
    let name = if shown.columns.len() > 1 { format!("{} · ", column.name) } else { String::new() };
    match words.is_japanese() {
        true => format!("{name}動画 {drawing} · {number} · {held}コマ中{since}コマ目"),
        false => format!("{name}drawing {drawing} · {number} · koma {since} of {held}"),
    }
}

#[cfg(test)]
mod tests;
