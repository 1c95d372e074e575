//! The welcome screen, shown while no clip is open.

use std::path::PathBuf;

use egui::{Align, Button, CentralPanel, Layout, Rect, RichText, Ui, UiBuilder, vec2};

use super::command::Command;
use super::file_field;
use super::theme::Look;
use super::words::Words;

/// Shows how to open a clip.
pub(super) fn show(
    ui: &mut Ui,
    look: &Look,
    recent: &[PathBuf],
    has_names: bool,
    words: Words,
    commands: &mut Vec<Command>,
) {
    CentralPanel::default_margins().show(ui, |ui| {
        let rect = ui.available_rect_before_wrap();
        ui.painter().rect_filled(rect, 6.0, look.ground);
        let middle = Rect::from_center_size(rect.center(), vec2(480.0, 240.0));
        let layout = Layout::top_down(Align::Center);
        ui.scope_builder(UiBuilder::new().max_rect(middle).layout(layout), |ui| {
            let what = words.say("Drop a clip here", "ここにモーションファイルをドロップ");
            ui.label(RichText::new(what).size(24.0).color(look.ink));
            ui.add_space(12.0);
            if ui.add(Button::new(words.say("Choose a file…", "ファイルを選ぶ…"))).clicked()
            {
                commands.push(Command::Choose);
            }
            let name = words.say("or open one by its name", "またはファイル名で開く");
            if has_names && ui.add(Button::new(name)).clicked() {
                commands.push(Command::OpenFile);
            }
            if !recent.is_empty() {
                ui.add_space(18.0);
                ui.weak(words.say("recent", "最近のファイル"));
                file_field::recent(ui, recent, commands);
            }
        });
    });
}
