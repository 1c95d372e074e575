//! The timesheet (タイムシート): a column that runs down, with circled genga numbers, marks for inbetweens and
//! lines for holds. It follows the play head; keys are corrected on it, and holds by their ends.

mod hand;

use egui::{
    Align2, Color32, FontId, Id, Painter, Pos2, Rect, Role, ScrollArea, Sense, Stroke, Ui,
    WidgetInfo, pos2, vec2,
};

use self::hand::{Hand, ROW};
use super::column::KeyedCell;
use super::command::Command;
use super::key_menu;
use super::shown::Shown;
use crate::keys::{Key, Origin};

/// Room over the first koma, so that its circle is whole.
const PAD: f32 = 3.0;
/// Where the middle of the column stands.
const MIDDLE: f32 = 62.0;
/// Where the words begin.
const WORDS: f32 = 84.0;
/// Radius of the circle round a genga's number.
const CIRCLE: f32 = 8.0;
/// Koma between two thin lines, as on printed sheets.
const THIN: usize = 6;

/// The sheet, as it is looked at and worked on.
#[derive(Debug, Clone, Default)]
pub(super) struct Timesheet {
    hand: Hand,
    /// The koma that was last brought into view.
    followed: Option<usize>,
}

impl Timesheet {
    /// Shows the column.
    pub(super) fn show(&mut self, ui: &mut Ui, shown: &Shown<'_>, commands: &mut Vec<Command>) {
        let words = shown.words;
        ui.horizontal(|ui| {
            ui.add_space(4.0);
            ui.weak(words.say("koma", "コマ"));
            ui.add_space(16.0);
            ui.strong("A");
        });
        ui.separator();
        let high = ROW * shown.column.length as f32;
        ScrollArea::vertical().id_salt("timesheet").auto_shrink(false).show_viewport(
            ui,
            |ui, seen| {
                ui.set_height(high + PAD);
                let top = ui.min_rect().min + vec2(0.0, PAD);
                let rect = Rect::from_min_size(top, vec2(ui.available_width(), high));
                let response = ui.interact(rect, Id::unique("timesheet"), Sense::click_and_drag());
                if let Some(koma) = self.hand.handle(&response, rect, shown, commands) {
                    self.followed = Some(koma);
                    commands.extend(shown.go(koma));
                }
                let rows = rows(seen, shown.column.length);
                draw(ui, rect, rows, shown);
                self.follow(ui, rect, seen, shown);
                let name = words.say("Timesheet", "タイムシート");
                let at = format!("koma {}", shown.at + 1);
                response.widget_info(|| WidgetInfo {
                    current_text_value: Some(at.clone()),
                    ..WidgetInfo::labeled(Role::Canvas, true, name)
                });
                response.context_menu(|ui| match &self.hand.asked {
                    Some(key) => key_menu::show(ui, key, words, commands),
                    None => key_menu::show_none(ui, shown, commands),
                });
            },
        );
    }

    /// Brings the play head into view when it has left it.
    fn follow(&mut self, ui: &Ui, rect: Rect, seen: Rect, shown: &Shown<'_>) {
        if self.followed == Some(shown.at) {
            return;
        }
        self.followed = Some(shown.at);
        let top = ROW * shown.at as f32;
        if top < seen.min.y || top + ROW > seen.max.y {
            let row = Rect::from_min_size(rect.min + vec2(0.0, top), vec2(rect.width(), ROW));
            ui.scroll_to_rect(row, Some(egui::Align::Center));
        }
    }
}

/// The koma in view.
fn rows(seen: Rect, length: usize) -> std::ops::Range<usize> {
    let first = (seen.min.y / ROW).floor().max(0.0) as usize;
    let past = (seen.max.y / ROW).ceil().max(0.0) as usize;
    first.min(length)..past.min(length)
}

fn draw(ui: &Ui, rect: Rect, rows: std::ops::Range<usize>, shown: &Shown<'_>) {
    if rows.is_empty() {
        return;
    }
    let painter = ui.painter_at(rect.intersect(ui.clip_rect()));
    painter.rect_filled(rect, 0.0, shown.look.paper);
    grid(&painter, rect, &rows, shown);
    let column = &shown.column;
    for cell in &column.cells[column.at(rows.start)..=column.at(rows.end - 1)] {
        draw_cell(&painter, rect.min, cell, shown);
    }
    forbidden(&painter, rect, &rows, shown);
}

fn grid(painter: &Painter, rect: Rect, rows: &std::ops::Range<usize>, shown: &Shown<'_>) {
    let look = &shown.look;
    let second = shown.column.clock.koma_rate.round().max(1.0) as usize;
    for koma in rows.clone() {
        let y = rect.min.y + ROW * koma as f32;
        let row = Rect::from_min_size(pos2(rect.min.x, y), vec2(rect.width(), ROW));
        if koma == shown.at {
            painter.rect_filled(row, 0.0, look.chosen);
        }
        let (width, color) = match koma {
            koma if koma % second == 0 => (1.6, look.faint),
            koma if koma % THIN == 0 => (1.0, look.raw),
            _ => (1.0, look.grid),
        };
        painter.hline(rect.x_range(), y, Stroke::new(width, color));
        let (font, ink) = if koma == shown.at {
            (FontId::monospace(12.0), look.playhead)
        } else {
            (FontId::monospace(10.0), look.faint)
        };
        painter.text(
            pos2(rect.min.x + 34.0, y + 0.5 * ROW),
            Align2::RIGHT_CENTER,
            koma + 1,
            font,
            ink,
        );
    }
    painter.vline(rect.min.x + 40.0, rect.y_range(), Stroke::new(1.0, look.grid));
}

/// A drawing: its mark, the line of its hold, why it is there.
fn draw_cell(painter: &Painter, corner: Pos2, cell: &KeyedCell<'_>, shown: &Shown<'_>) {
    let look = &shown.look;
    let middle = corner + vec2(MIDDLE, ROW * (cell.koma as f32 + 0.5));
    let color = look.of_role(cell.drawing.role);
    if cell.held > 1 {
        let end = middle.y + ROW * (cell.held as f32 - 0.7);
        let begin = middle.y + if cell.genga.is_some() { CIRCLE + 1.0 } else { 5.0 };
        let (width, color) =
            if cell.drawing.why.hold_set { (2.2, look.genga) } else { (1.4, look.faint) };
        painter.vline(middle.x, begin..=end, Stroke::new(width, color));
        painter.hline(middle.x - 3.0..=middle.x + 3.0, end, Stroke::new(width, color));
    }
    match cell.genga {
        Some(number) => badge(painter, middle, number, color, cell.key, look.paper),
        None => drop(painter.circle_filled(middle, 2.6, color)),
    }
    let words = why(cell, shown);
    let is_set = cell.key.is_some_and(|key| key.origin.is_set()) || cell.drawing.why.hold_set;
    let ink = if is_set { look.genga } else { look.faint };
    let at = pos2(corner.x + WORDS, middle.y);
    painter.text(at, Align2::LEFT_CENTER, words, FontId::proportional(11.0), ink);
}

/// A number in a circle, which is filled where a person set it.
pub(super) fn badge(
    painter: &Painter,
    middle: Pos2,
    number: usize,
    color: Color32,
    key: Option<&Key>,
    paper: Color32,
) {
    let is_set = key.is_some_and(|key| key.origin.is_set());
    let (fill, ink) = if is_set { (color, paper) } else { (paper, color) };
    painter.circle(middle, CIRCLE, fill, Stroke::new(1.6, color));
    let size = if number < 100 { 10.5 } else { 8.5 };
    painter.text(middle, Align2::CENTER_CENTER, number, FontId::proportional(size), ink);
}

/// Why a drawing is there, in few words.
fn why(cell: &KeyedCell<'_>, shown: &Shown<'_>) -> String {
    let words = shown.words;
    let mut reasons: Vec<String> = Vec::new();
    if let Some(key) = cell.key {
        match (&key.name, key.origin) {
            (Some(name), _) => reasons.push(name.clone()),
            (None, Origin::Pinned) => reasons.push(words.say("locked", "固定").into()),
            _ => {}
        }
        match key.origin {
            Origin::Moved { from } => reasons.push(match words.is_japanese() {
                true => format!("フレーム{from}から"),
                false => format!("from frame {from}"),
            }),
            Origin::Fill | Origin::Rest | Origin::Contact => {
                let reason = key.origin.reason();
                reasons.push(words.say(reason.word(), reason.japanese()).into());
            }
            Origin::Turn | Origin::Pinned => {}
        }
    }
    let why = &cell.drawing.why;
    if why.hold_set {
        reasons.push(format!("{} {}", words.say("held", "止め"), cell.held));
    }
    if why.omitted_before > 0 {
        reasons.push(format!("{} {}", words.say("left out", "抜いた中割"), why.omitted_before));
    }
    if reasons.is_empty() {
        reasons.extend(why.voters.first().cloned());
    }
    reasons.join(" · ")
}

/// A cross on every koma that may have no key.
fn forbidden(painter: &Painter, rect: Rect, rows: &std::ops::Range<usize>, shown: &Shown<'_>) {
    let clock = &shown.column.clock;
    for range in &shown.wanted.edits.forbidden {
        let last = shown.frame(range.past.0 as f64 - 1.0);
        let [from, to] = [range.from, last].map(|frame| clock.koma_from_frame(frame));
        for koma in from.max(rows.start)..(to + 1).min(rows.end) {
            let at = rect.min + vec2(46.0, ROW * (koma as f32 + 0.5));
            let stroke = Stroke::new(1.6, shown.look.genga);
            painter.line_segment([at - vec2(3.0, 3.0), at + vec2(3.0, 3.0)], stroke);
            painter.line_segment([at - vec2(3.0, -3.0), at + vec2(3.0, -3.0)], stroke);
        }
    }
}
