//! The table with nothing on it.

use egui::{Align2, CentralPanel, FontId, Ui, vec2};

use super::keyboard::Command;
use super::look::Look;
use super::words::Words;

/// Says how to begin.
pub(super) fn show(ui: &mut Ui, look: &Look, words: Words, commands: &mut Vec<Command>) {
    CentralPanel::default_margins().show(ui, |ui| {
        let rect = ui.available_rect_before_wrap();
        ui.painter().rect_filled(rect, 6.0, look.ground);
        let middle = rect.center();
        let what = words.say("Drop a BVH clip here", "ここにBVHファイルをドロップ");
        ui.painter().text(
            middle,
            Align2::CENTER_BOTTOM,
            what,
            FontId::proportional(24.0),
            look.ink,
        );
        let place = egui::Rect::from_center_size(middle + vec2(0.0, 32.0), vec2(220.0, 30.0));
        let name = words.say("or open one by its name", "またはファイル名で開く");
        if ui.put(place, egui::Button::new(name)).clicked() {
            commands.push(Command::OpenFile);
        }
    });
}
