//! The timesheet (タイムシート): columns side by side, with circled genga numbers, marks for inbetweens and lines for holds.
//! It follows the play head. The keys of every column can be corrected on it, and holds dragged by their ends.

mod cells;
mod paper;
mod pointer;
mod speech;

use egui::{Button, Id, Rect, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};

use self::paper::Paper;
use self::pointer::Hand;
use self::speech::SpeechHand;
use super::command::Command;
use super::focus::{self, Part};
use super::key_menu;
use super::view_state::Shown;

pub(super) use cells::badge;

/// Space above the first koma, so that its circle is not cut, in points.
const PAD: f32 = 3.0;
/// Height of the row with the names of the columns, in points.
const NAMES: f32 = 22.0;
/// Height of a koma in points: least, greatest and default.
const LOWEST: f32 = 4.0;
const HIGHEST: f32 = 34.0;
const USUAL: f32 = 17.0;

/// State of the timesheet.
#[derive(Debug, Clone)]
pub(super) struct Timesheet {
    hand: Hand,
    speech: SpeechHand,
    /// The koma last scrolled into view.
    followed: Option<usize>,
    /// Height of a koma in points.
    row: f32,
    /// Scroll offset for the next frame, after the height of a koma has changed.
    scroll_to: Option<f32>,
}

impl Default for Timesheet {
    fn default() -> Self {
        Self {
            hand: Hand::default(),
            speech: SpeechHand::default(),
            followed: None,
            row: USUAL,
            scroll_to: None,
        }
    }
}

impl Timesheet {
    /// Multiplies the height of a koma, and scrolls the play head into view again.
    pub(super) fn zoom_by(&mut self, factor: f32) {
        self.row = (self.row * factor).clamp(LOWEST, HIGHEST);
        self.followed = None;
    }

    /// Shows the columns under their names.
    pub(super) fn show(&mut self, ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let wide = Paper::wide(shown.columns.len()).max(ui.available_width());
        ScrollArea::horizontal().id_salt("columns").auto_shrink(false).show(ui, |ui| {
            names(ui, wide, shown, commands);
            self.sheet(ui, wide, shown, commands);
        });
    }

    fn sheet(&mut self, ui: &mut Ui, wide: f32, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let high = self.row * shown.column().length as f32;
        let mut area = ScrollArea::vertical().id_salt("timesheet").auto_shrink(false);
        if let Some(offset) = self.scroll_to.take() {
            area = area.vertical_scroll_offset(offset);
        }
        area.show_viewport(ui, |ui, seen| {
            ui.set_height(high + PAD);
            ui.set_width(wide);
            let top = ui.min_rect().min + vec2(0.0, PAD);
            let rect = Rect::from_min_size(top, vec2(wide, high));
            let response = ui.interact(rect, Id::unique("timesheet"), Sense::click_and_drag());
            Part::Sheet.begins(&response);
            focus::leave_arrows(&response);
            let paper = Paper { rect, row: self.row, columns: shown.columns.len() };
            let is_spoken = self.speech.handle(&response, &paper, shown, commands);
            let koma = (!is_spoken).then(|| self.hand.handle(&response, &paper, shown, commands));
            if let Some(koma) = koma.flatten() {
                self.followed = Some(koma);
                commands.extend(shown.go(koma));
            }
            let rows = paper.rows(seen, shown.column().length);
            cells::draw(ui, &paper, rows, &self.speech, shown);
            self.follow(ui, &paper, seen, shown);
            self.pinch(ui, &paper, seen);
            let name = shown.words.say("Timesheet", "タイムシート");
            let at = format!("{} koma {}", shown.column().name, shown.at + 1);
            response.widget_info(|| WidgetInfo {
                current_text_value: Some(at.clone()),
                ..WidgetInfo::labeled(Role::Canvas, true, name)
            });
            response.context_menu(|ui| match &self.hand.asked {
                Some(key) => key_menu::show(ui, key, shown, commands),
                None => key_menu::show_none(ui, shown, commands),
            });
        });
    }

    /// Scrolls the play head into view when it has left it.
    fn follow(&mut self, ui: &Ui, paper: &Paper, seen: Rect, shown: &Shown<'_>) {
        if self.followed == Some(shown.at) {
            return;
        }
        self.followed = Some(shown.at);
        let top = self.row * shown.at as f32;
        if top < seen.min.y || top + self.row > seen.max.y {
            // As wide as the view, so that it scrolls only vertically.
            let row = Rect::from_x_y_ranges(ui.clip_rect().x_range(), paper.koma_range(shown.at));
            ui.scroll_to_rect(row, Some(egui::Align::Center));
        }
    }

    /// Changes the height of a koma by a pinch, or by Ctrl and the wheel. The point under the pointer stays in place.
    fn pinch(&mut self, ui: &Ui, paper: &Paper, seen: Rect) {
        let factor = ui.input(egui::InputState::zoom_delta);
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let Some(at) = pointer.filter(|at| factor != 1.0 && ui.clip_rect().contains(*at)) else {
            return;
        };
        let row = (self.row * factor).clamp(LOWEST, HIGHEST);
        let down = at.y - paper.rect.min.y;
        self.scroll_to = Some((seen.min.y + down * (row / self.row - 1.0)).max(0.0));
        self.row = row;
        ui.ctx().request_repaint();
    }
}

/// Shows the names of the columns, each above its own. A click selects the column.
fn names(ui: &mut Ui, wide: f32, shown: &Shown<'_>, commands: &mut Vec<Command>) {
    let (_, place) = ui.allocate_space(vec2(wide, NAMES));
    let columns = shown.columns.len();
    let paper = Paper { rect: place, row: NAMES, columns };
    let koma = Rect::from_min_size(place.min, vec2(36.0, NAMES));
    ui.put(koma, egui::Label::new(shown.words.say("koma", "コマ")));
    let speech = Rect::from_x_y_ranges(paper.speech(), place.y_range().shrink(1.0));
    let name = shown.words.say("Spoken line (S)", "セリフ (S)");
    if ui.put(speech, Button::new("S")).on_hover_text(name).accessible_name(name).clicked() {
        commands.push(Command::AskSpeech(None));
    }
    for (at, column) in shown.columns.iter().enumerate() {
        let middle = pos2(paper.x(at), place.center().y);
        let rect = Rect::from_center_size(middle, vec2(paper::PITCH - 4.0, NAMES - 2.0));
        let is_chosen = at == shown.chosen && columns > 1;
        let button = ui.put(rect, Button::selectable(is_chosen, column.name).truncate());
        let name = format!("{} {}", shown.words.say("Column", "セル"), column.name);
        if button.accessible_name(name).clicked() {
            commands.extend(shown.choose(at));
        }
    }
    ui.separator();
}
