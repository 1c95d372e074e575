//! The transport (再生): buttons to play and step, and the scrub bar.

use egui::{Button, FontId, Id, Painter, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::command::Command;
use super::focus::{self, Part};
use super::icon::{self, Icon};
use super::label_culling::{Room, step};
use super::panels::is_low;
use super::passages;
use super::player::Player;
use super::view_state::Shown;

/// Shows the buttons, and the scrub bar below them, or beside them in a low window.
pub(super) fn show(ui: &mut Ui, shown: &Shown<'_>, player: &Player, commands: &mut Vec<Command>) {
    ui.add_space(2.0);
    if is_low(ui.ctx().content_rect().size()) {
        ui.horizontal(|ui| {
            steps(ui, shown, player, commands);
            scrub(ui, shown, player, commands);
        });
        return;
    }
    ui.horizontal_wrapped(|ui| steps(ui, shown, player, commands));
    scrub(ui, shown, player, commands);
}

fn steps(ui: &mut Ui, shown: &Shown<'_>, player: &Player, commands: &mut Vec<Command>) {
    let words = shown.words;
    let mut button = |ui: &mut Ui, sign: Icon, english, japanese, command: Command| {
        let name = words.say(english, japanese);
        if icon::button(ui, sign, name).clicked() {
            commands.push(command);
        }
    };
    button(ui, Icon::Skip { is_back: true }, "Previous genga", "前の原画", Command::Genga(-1));
    button(ui, Icon::Step { is_back: true }, "Previous koma", "前のコマ", Command::Koma(-1));
    match player.is_playing() {
        true => button(ui, Icon::Stop, "Stop", "停止", Command::Play),
        false => button(ui, Icon::Play, "Play", "再生", Command::Play),
    }
    button(ui, Icon::Step { is_back: false }, "Next koma", "次のコマ", Command::Koma(1));
    button(ui, Icon::Skip { is_back: false }, "Next genga", "次の原画", Command::Genga(1));
    let (at, length) = (shown.at + 1, shown.column().length);
    let rate = shown.column().clock.koma_rate;
    let seconds = shown.at as f64 / rate;
    let second = words.say("s", "秒");
    ui.monospace(match shown.counts_frames {
        true => {
            let (frame, last) = (shown.frame_of_koma(shown.at), shown.breakdown.clip.last());
            let name = words.say("frame", "フレーム");
            format!("{name} {:>4} / {last}  {seconds:>6.2} {second}", frame.0)
        }
        false => {
            let name = words.say("koma", "コマ");
            format!("{name} {at:>4} / {length}  {seconds:>6.2} {second}")
        }
    });
    let Some(range) = &player.range else { return };
    button(ui, Icon::Cross, "Play all", "全部を再生", Command::LoopAll);
    let frames = passages::frames(&shown.breakdown, range);
    let is_on = passages::has(&shown.wanted.recipe, frames);
    let passage = ui.add(Button::selectable(is_on, words.say("Passage", "区間")));
    let hint = words.say("A part with goals of its own (Q)", "目標を別に決められる部分 (Q)");
    if passage.on_hover_text(hint).clicked() {
        commands.push(Command::Passage);
    }
}

/// Height of the scrub bar in points.
const HEIGHT: f32 = 22.0;
/// Width of a koma's number, and gap between two, in points.
const LABEL: f32 = 30.0;
const GAP: f32 = 6.0;
/// Distance below which lines cannot be told apart, in points.
const CLOSEST: f32 = 1.0;

/// Shows the whole sheet as a bar: a line per drawing, the play head, the played range.
fn scrub(ui: &mut Ui, shown: &Shown<'_>, player: &Player, commands: &mut Vec<Command>) {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
    let response = ui.interact(rect, Id::unique("scrub"), Sense::click_and_drag());
    Part::PlayHead.begins(&response);
    focus::leave_arrows(&response);
    let column = shown.column();
    let inside = rect.shrink2(vec2(6.0, 3.0));
    let wide = inside.width() / column.length.max(1) as f32;
    let x = |koma: usize| inside.min.x + wide * koma as f32;
    if let Some(at) =
        response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on())
    {
        let koma = ((at.x - inside.min.x) / wide).floor().max(0.0) as usize;
        commands.extend(shown.go(koma));
    }
    let (painter, look) = (ui.painter_at(rect), &shown.look);
    painter.rect_filled(inside, 3.0, look.ground);
    let played = player.played(column.length);
    if player.range.is_some() {
        let played = Rect::from_x_y_ranges(x(played.start)..=x(played.end), inside.y_range());
        painter.rect_filled(played, 3.0, look.chosen);
    }
    let mut rooms = [Room::default(); 2];
    for cell in &column.cells {
        // Lines at the same point of the window are drawn once.
        if !rooms[usize::from(cell.drawing.role.is_kept())].take(x(cell.koma), CLOSEST) {
            continue;
        }
        let color = look.of_role(cell.drawing.role);
        let (high, stroke) = match cell.drawing.role.is_kept() {
            true => (1.0, Stroke::new(1.5, color)),
            false => (0.4, Stroke::new(1.0, color)),
        };
        let top = inside.max.y - high * inside.height();
        painter.vline(x(cell.koma), top..=inside.max.y, stroke);
    }
    for koma in shown.breakdown.actions.koma(column.clock) {
        painter.vline(x(koma), rect.y_range(), Stroke::new(2.0, look.action));
    }
    let now = x(shown.at);
    let head = Rect::from_min_max(pos2(now, rect.min.y), pos2(now + wide.max(3.0), rect.max.y));
    painter.rect_stroke(head, 2.0, Stroke::new(2.0, look.playhead), egui::StrokeKind::Outside);
    let name = shown.words.say("Play head", "再生位置");
    let (at, length) = (shown.at + 1, column.length);
    response.widget_info(|| WidgetInfo {
        value: Some(at as f64),
        current_text_value: Some(format!("{at} / {length}")),
        ..WidgetInfo::labeled(Role::Slider, true, name)
    });
    numbers(&painter, inside, wide, shown);
}

/// Draws the numbers of koma, or of the frames they show, one per second or as many as fit.
fn numbers(painter: &Painter, inside: Rect, wide: f32, shown: &Shown<'_>) {
    let (column, look) = (shown.column(), &shown.look);
    let second = column.clock.koma_rate.round().max(1.0) as usize;
    let every = second * step(wide * second as f32, LABEL + GAP);
    let mut room = Room::default();
    for koma in (every..=column.length).step_by(every) {
        let number = match shown.counts_frames {
            true => shown.frame_of_koma(koma - 1).0,
            false => koma,
        };
        let galley =
            painter.layout_no_wrap(number.to_string(), FontId::proportional(9.0), look.faint);
        let at = pos2(inside.min.x + wide * (koma - 1) as f32 + 2.0, inside.min.y);
        let rect = Rect::from_min_size(at, galley.size());
        if rect.max.x < inside.max.x && room.take(rect.min.x, rect.width() + GAP) {
            // Without a background, the lines of a long take would strike the number out.
            painter.rect_filled(rect.expand2(vec2(1.0, 0.0)), 2.0, look.ground);
            painter.galley(at, galley, look.faint);
        }
    }
}
