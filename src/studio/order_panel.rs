//! The panel in which an order for an export is given (書き出しの画面).

use std::path::{Path, PathBuf};

use egui::{Button, ComboBox, Grid, Key, TextEdit, Ui};

use super::command::Command;
use super::desk::Desk;
use super::order::{CAMERAS, Order};
use super::words::Words;
use crate::deliver::FORMATS;
use crate::plot::Camera;

/// The panel in which it is given.
#[derive(Debug, Clone, Default)]
pub(super) struct OrderPanel {
    pub(super) order: Option<Order>,
    /// Formats that every export has.
    pub(super) always: Vec<&'static str>,
    /// Whether they go into a folder, and not into an archive.
    pub(super) has_folders: bool,
    /// The folder as it is typed.
    pub(super) folder: String,
}

impl OrderPanel {
    /// Asks for an order that begins as this one.
    pub(super) fn ask(&mut self, order: Order, desk: &dyn Desk) {
        self.folder = order.folder.display().to_string();
        (self.always, self.has_folders) = (desk.always(), desk.has_names());
        self.order = Some(order);
    }

    /// Takes a folder that was chosen.
    pub(super) fn take(&mut self, folder: &Path) {
        self.folder = folder.display().to_string();
    }

    /// Shows it while it is asked for.
    pub(super) fn show(&mut self, ui: &mut Ui, words: Words, commands: &mut Vec<Command>) {
        let Some(order) = &mut self.order else { return };
        ui.strong(words.say("Export", "書き出し"));
        formats(ui, order, &self.always, words);
        ui.separator();
        ui.horizontal(|ui| {
            ui.label(words.say("Figures seen from", "図の向き"));
            camera(ui, order, words);
        });
        ui.horizontal(|ui| {
            let (what, name) = match self.has_folders {
                true => (("Folder", "フォルダー"), ("Folder of the export", "書き出すフォルダー")),
                false => (("Archive", "ZIPの名前"), ("Archive of the export", "書き出すZIPの名前")),
            };
            ui.label(words.say(what.0, what.1));
            let field = TextEdit::singleline(&mut self.folder).desired_width(480.0);
            ui.add(field).accessible_name(words.say(name.0, name.1));
            let choose = words.say("Choose the folder…", "フォルダーを選ぶ…");
            if self.has_folders && ui.button(choose).clicked() {
                commands.push(Command::ChooseFolder);
            }
        });
        order.folder = PathBuf::from(self.folder.trim());
        let is_named = order.folder != Path::new("");
        ui.horizontal(|ui| {
            let write = Button::new(words.say("Write the files", "書き出す"));
            let is_entered = ui.input(|input| input.key_pressed(Key::Enter));
            let is_asked = ui.add_enabled(is_named, write).clicked() || is_entered;
            if is_asked && is_named {
                commands.push(Command::Export(order.clone()));
            }
            if ui.button(words.say("Not now", "やめる")).clicked() {
                commands.push(Command::Dismiss);
            }
        });
    }
}

/// A box for each format, three in a row; those that always come are on and stay so.
fn formats(ui: &mut Ui, order: &mut Order, always: &[&'static str], words: Words) {
    Grid::new("formats").num_columns(3).spacing([18.0, 4.0]).show(ui, |ui| {
        for (at, format) in FORMATS.iter().enumerate() {
            let is_always = always.contains(&format.name);
            let mut is_on = is_always || order.formats.contains(&format.name);
            let japanese = format!("{} {}", format.name, format.japanese);
            let name = words.say(format.name, &japanese).to_owned();
            let shown = ui.add_enabled_ui(!is_always, |ui| ui.checkbox(&mut is_on, name)).inner;
            let help = words.say(format.help, format.japanese);
            let help = format!("{help}\n{}", format.files.join(" "));
            if shown.on_hover_text(&help).on_disabled_hover_text(&help).changed() {
                order.toggle(format.name, is_on);
            }
            if at % 3 == 2 {
                ui.end_row();
            }
        }
    });
}

fn camera(ui: &mut Ui, order: &mut Order, words: Words) {
    let said = |wanted: Camera| {
        let found = CAMERAS.iter().find(|(camera, ..)| *camera == wanted);
        found.map_or("", |(_, english, japanese)| words.say(english, japanese))
    };
    let combo = ComboBox::from_id_salt("order camera").selected_text(said(order.camera));
    let combo = combo.width(200.0).show_ui(ui, |ui| {
        for (camera, ..) in CAMERAS {
            ui.selectable_value(&mut order.camera, camera, said(camera));
        }
    });
    combo.response.accessible_name(words.say("Figures seen from", "図の向き"));
}
