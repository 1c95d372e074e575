//! The strip (ポーズの列): the genga as small figures over time, and below them every drawing for as long as it stays. It is
//! the main timeline: genga are chosen, dragged, pinned, forbidden and held on the figures themselves.

mod bans;
mod choice;
pub(crate) mod feet;
mod figures;
mod layout;
mod pointer;
mod track;

use egui::{Id, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo};

use self::bans::Ban;
use self::figures::Passage;
use self::layout::Layout;
use self::pointer::Hand;
use super::command::Command;
use super::difference::{Changed, Difference};
use super::focus::{self, Part};
use super::key_menu;
use super::player::Player;
use super::time_axis::Window;
use super::view_state::Shown;
use super::viewport::Orbit;

/// Least and greatest height of the strip in points, and its height in low, usual and high windows.
pub(super) const HEIGHTS: std::ops::RangeInclusive<f32> = 68.0..=260.0;
const LOW: f32 = 96.0;
const USUAL: f32 = 128.0;
const HIGH: f32 = 156.0;

/// Height of the koma numbers in points.
const NUMBERS: f32 = 13.0;

/// State of the strip: the part of the sheet in view, and what the pointer does.
#[derive(Debug, Clone, Default)]
pub(super) struct Strip {
    window: Window,
    hand: Hand,
    /// The koma that was last brought into view.
    followed: usize,
    /// The genga under the pointer, and since when.
    hovered: Option<Passage>,
    /// Where the pointer was when a button was clicked. Until it moves it is over no genga, so that a second click does
    /// nothing to the one that comes there.
    clicked: Option<Pos2>,
    /// Whether the view is to go to the action at the play head, or to the whole.
    wants_zoom: bool,
}

impl Strip {
    /// Usual height of the strip in a window of a height.
    pub(super) fn usual_height(window: f32) -> f32 {
        match window {
            ..560.0 => LOW,
            ..780.0 => USUAL,
            _ => HIGH,
        }
    }

    /// Goes to the action at the play head, or to the whole.
    pub(super) fn zoom(&mut self) {
        self.wants_zoom = true;
    }

    /// Brings the first change into view, unless some change is there already.
    pub(super) fn reveal(&mut self, difference: &Difference) {
        let is_seen = |koma: &usize| self.window.has(*koma as f64);
        if !difference.places.iter().any(is_seen)
            && let Some(first) = difference.places.first()
        {
            self.window.reveal(*first as f64);
        }
    }

    /// Shows the strip.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        (shown, difference): (&Shown<'_>, Option<&Difference>),
        (orbit, player): (&Orbit, &Player),
        commands: &mut Vec<Command>,
    ) {
        let rect = ui.available_rect_before_wrap();
        let response = ui.interact(rect, Id::unique("strip"), Sense::click_and_drag());
        Part::Strip.begins(&response);
        focus::leave_arrows(&response);
        let was_whole = self.window.is_whole();
        self.window.fit((0.0, shown.column().length as f64));
        let inside = layout::inside(rect);
        self.window.handle(ui, &response, inside);
        if std::mem::take(&mut self.wants_zoom) || response.double_clicked() && was_whole {
            self.zoom_at(shown, was_whole);
        }
        if std::mem::replace(&mut self.followed, shown.at) != shown.at {
            self.window.reveal(shown.at as f64);
        }
        let layout = Layout::new(rect, self.window.scale(inside));
        let hovered = self.hovered.as_ref().map(Passage::cell);
        let changed = difference.and_then(|all| all.columns.get(shown.chosen));
        let figured = choice::choose(&layout, shown, player.is_playing(), (hovered, changed));
        let bans = bans::of(&layout, shown);
        self.hover(ui, &layout, (&figured, &bans), response.dragged(), shown);
        self.hand.handle(&response, &layout, &figured, shown, commands);
        self.draw(ui, &layout, (&figured, &bans), (shown, changed), (orbit, player));
        bans::draw(&ui.painter_at(rect), &bans, &shown.look);
        self.press(ui, &layout, &bans, shown, commands);
        name(&response, shown);
        let response = feet::explain(response, &layout, shown);
        let response = figures::explain(response, &layout, &figured, (shown, changed));
        response.context_menu(|ui| match &self.hand.asked {
            Some(key) => key_menu::show(ui, key, shown, commands),
            None => key_menu::show_none(ui, shown, commands),
        });
        ui.advance_cursor_after_rect(rect);
    }

    /// Notes the genga under the pointer.
    fn hover(
        &mut self,
        ui: &Ui,
        layout: &Layout,
        (figured, bans): (&[usize], &[Ban]),
        is_dragged: bool,
        shown: &Shown<'_>,
    ) {
        // The buttons on a figure lie over the strip, and are as much a part of it.
        let is_over = ui.rect_contains_pointer(layout.rect) && !is_dragged;
        let at = ui.input(|input| input.pointer.hover_pos()).filter(|_| is_over);
        self.clicked = self.clicked.filter(|clicked| Some(*clicked) == at);
        // A cross over a figure is not the figure's.
        let free = at.filter(|at| !bans.iter().any(|ban| ban.is_at(*at)));
        let free = free.filter(|_| self.clicked.is_none());
        let cell = free.and_then(|at| layout.cell(at, figured, shown));
        let now = ui.input(|input| input.time);
        self.hovered = Passage::under(cell, self.hovered.take(), now);
    }

    /// Shows the crosses of bans and the buttons of the genga under the pointer, and asks for a frame when its passage
    /// has another koma.
    fn press(
        &mut self,
        ui: &mut Ui,
        layout: &Layout,
        bans: &[Ban],
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) {
        let given = commands.len();
        if self.clicked.is_none() {
            bans::handle(ui, bans, shown, commands);
        }
        if let Some(passage) = &self.hovered {
            figures::buttons(ui, passage, layout, shown, commands);
        }
        if commands.len() > given {
            self.clicked = ui.input(|input| input.pointer.hover_pos());
        }
        let Some(passage) = &self.hovered else { return };
        let now = ui.input(|input| input.time);
        if let Some(wait) = passage.wait(now, shown) {
            ui.ctx().request_repaint_after_secs(wait);
        }
    }

    /// Shows the action at the play head if everything is in view, else everything.
    fn zoom_at(&mut self, shown: &Shown<'_>, was_whole: bool) {
        if !was_whole {
            return self.window.show_whole();
        }
        let (mut from, mut to) = (0, shown.column().length);
        for koma in shown.breakdown.actions.koma(shown.column().clock) {
            if koma <= shown.at {
                from = koma;
            } else {
                to = to.min(koma);
            }
        }
        self.window.show_part(from as f64, to as f64);
    }

    fn draw(
        &self,
        ui: &Ui,
        layout: &Layout,
        (figured, bans): (&[usize], &[Ban]),
        (shown, changed): (&Shown<'_>, Option<&Changed>),
        (orbit, player): (&Orbit, &Player),
    ) {
        let (painter, look) = (ui.painter_at(layout.rect), &shown.look);
        painter.rect_filled(layout.rect, 4.0, look.ground);
        if let Some(range) = &player.range {
            let played = layout.x(range.start)..=layout.x(range.end);
            let played = Rect::from_x_y_ranges(played, layout.rect.y_range());
            painter.rect_filled(played, 0.0, look.chosen);
        }
        let cells = &shown.column().cells;
        let current = shown.column().at(shown.at);
        if figured.binary_search(&current).is_ok() {
            let slot = layout.slot(layout.x(cells[current].koma));
            painter.rect_filled(slot, 4.0, look.chosen);
        }
        // Behind the numbers of genga and below those of koma, so that none is struck out.
        let (x, top) = (layout.x(shown.at), layout.rect.min.y + NUMBERS);
        painter.vline(x, top..=layout.rect.max.y, Stroke::new(2.0, look.playhead));
        track::draw(&painter, layout, figured, shown);
        let passage = self.hovered.as_ref().map(|own| (own, ui.input(|input| input.time)));
        let pointed = ui.input(|input| input.pointer.hover_pos());
        let ban = pointed.and_then(|at| bans.iter().find(|ban| ban.is_at(at)));
        let banned: Vec<(usize, f64)> = ban.into_iter().flat_map(Ban::taken).collect();
        figures::draw(&painter, layout, (figured, passage), (shown, orbit), (changed, &banned));
    }
}

/// Names the strip and the drawing at the play head, as a screen reader says them.
fn name(response: &egui::Response, shown: &Shown<'_>) {
    let (words, cell) = (shown.words, shown.column().cell(shown.at));
    let drawing = match cell.genga_number() {
        Some(number) => format!("{} {number}", words.say("genga", "原画")),
        None => words.say("inbetween", "中割り").to_owned(),
    };
    let at = format!("{drawing}, {} {}", words.say("koma", "コマ"), shown.at + 1);
    let name = words.say("Strip of genga", "原画の列");
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(at.clone()),
        ..WidgetInfo::labeled(Role::Canvas, true, name)
    });
}
