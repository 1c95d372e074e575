//! The list of keys (キー一覧).

use egui::{Align2, Grid, Id, Key, ScrollArea, Ui, Vec2, Window, vec2};

use super::command::Command;
use super::keyboard::{BINDINGS, Binding};
use super::words::Words;

/// Width of a column of the list and height of a row, in points.
const COLUMN: f32 = 380.0;
const ROW: f32 = 21.0;
/// Space for the title and at the sides, in points.
const ROOM: Vec2 = vec2(60.0, 118.0);

/// Shows the list while it is open, in as many columns as fit. The rest can be scrolled.
pub(super) fn show(ui: &Ui, is_open: &mut bool, words: Words, commands: &mut Vec<Command>) {
    let title = words.say("Keys", "キー一覧");
    let room = ui.ctx().content_rect().size() - ROOM;
    let most = ((room.x / COLUMN) as usize).clamp(1, 3);
    let fitting = (BINDINGS.len() as f32 * ROW / room.y).ceil() as usize;
    let columns = fitting.clamp(2.min(most), most);
    let window = Window::new(title).id(Id::unique("help")).open(is_open).collapsible(false);
    let window = window.anchor(Align2::CENTER_CENTER, Vec2::ZERO).resizable(false);
    window.show(ui.ctx(), |ui| {
        if ui.button(words.say("Tour of six steps", "6ステップの案内")).clicked() {
            commands.push(Command::Tour);
        }
        ScrollArea::vertical().max_height(room.y).show(ui, |ui| {
            ui.set_max_width(COLUMN * columns as f32);
            ui.horizontal_top(|ui| {
                for (at, bindings) in BINDINGS.chunks(BINDINGS.len().div_ceil(columns)).enumerate()
                {
                    list(ui, at, bindings, words);
                }
            });
            ui.separator();
            mouse(ui, words);
            leaf(ui, room.y);
        });
    });
}

fn list(ui: &mut Ui, column: usize, bindings: &[Binding], words: Words) {
    Grid::new(("keys", column)).num_columns(2).spacing([14.0, 3.0]).show(ui, |ui| {
        for binding in bindings {
            ui.monospace(binding.keys(ui));
            ui.label(binding.what(words));
            ui.end_row();
        }
    });
    ui.add_space(18.0);
}

/// Scrolls by a page on Page Down and Page Up, since nothing in the list can be focused.
fn leaf(ui: &Ui, page: f32) {
    let pressed = |key| ui.input(|input| input.key_pressed(key));
    for (key, way) in [(Key::PageDown, -1.0), (Key::PageUp, 1.0)] {
        if pressed(key) {
            ui.scroll_with_delta(vec2(0.0, way * 0.8 * page));
        }
    }
}

fn mouse(ui: &mut Ui, words: Words) {
    ui.label(words.say(
        "Keyboard: Tab moves to the next control, F6 to the next part. Arrows turn the focused view, and move it with \
         Shift. On the curves they scroll and zoom; on the map they change both settings.",
        "Tab で次の項目、F6 で次の部分へ。矢印キーは、画面では回転、Shift と併せて移動。グラフでは移動と拡大、\
         地図では両方の設定を変える。",
    ));
    ui.label(words.say(
        "Mouse: drag a view to turn it, with Shift or the right button to move it; the wheel zooms. \
         Drag a number on the timesheet or the curves to move its genga, the end of a hold on the timesheet to \
         change its length, an inbetween's dot on the curves to change its spacing. Right-click for more.",
        "マウス: 画面をドラッグで回転、Shift か右ボタンで移動、ホイールで拡大。\
         シートやグラフの番号をドラッグで原画を移動、シートの止めの端で長さを、\
         グラフの中割りの点で詰めを変える。右クリックでメニュー。",
    ));
}
