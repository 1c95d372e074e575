//! The list of keys (キー一覧).

use egui::{Grid, Ui, Window};

use super::keyboard::BINDINGS;
use super::words::Words;

/// Shows the list while it is open.
pub(super) fn show(ui: &Ui, is_open: &mut bool, words: Words) {
    let title = words.say("Keys", "キー一覧");
    let window = Window::new(title).id(egui::Id::unique("help")).open(is_open).collapsible(false);
    window.resizable(false).default_pos([360.0, 80.0]).show(ui.ctx(), |ui| {
        ui.horizontal_top(|ui| {
            for (column, bindings) in BINDINGS.chunks(BINDINGS.len().div_ceil(2)).enumerate() {
                Grid::new(("keys", column)).num_columns(2).spacing([14.0, 3.0]).show(ui, |ui| {
                    for binding in bindings {
                        ui.monospace(binding.keys(ui));
                        ui.label(binding.what(words));
                        ui.end_row();
                    }
                });
                ui.add_space(18.0);
            }
        });
        ui.separator();
        ui.label(words.say(
            "Mouse: drag a view to turn it, with Shift or the right button to move it, the wheel zooms. \
             Drag a number on the timesheet or over the curves to move a genga, the end of a hold on the timesheet to \
             lengthen it, the dot of an inbetween over the curves to pull it; the right button has more.",
            "マウス: 画面をドラッグで回転、Shift か右ボタンで移動、ホイールで拡大。\
             シートやグラフの番号をドラッグで原画を移動、シートの止めの端で長さを、\
             グラフの中割りの点で詰めを変える。右クリックでメニュー。",
        ));
    });
}
