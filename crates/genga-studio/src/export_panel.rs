//! The export panel (書き出しの画面), in which an order is given.

use std::path::{Path, PathBuf};

use egui::{
    Button, CollapsingHeader, ComboBox, Grid, Key, Label, RichText, ScrollArea, TextEdit, Ui,
};

use super::command::Command;
use super::destinations;
use super::export_settings::{CAMERAS, Order};
use super::focus::{self, Part};
use super::host::Host;
use super::knobs;
use super::notice;
use super::panels;
use super::words::Words;
use genga::recipe::Knob;
use genga_files::{FORMATS, HAS_PIXELS};
use genga_plot::Camera;

/// Sections of the settings for paper, and for all figures.
const PAPER: &str = "xsheet";
const FIGURES: &str = "figures";

/// Height of everything above and below the formats in the panel, and the least height of the formats, in points.
const ROOM: f32 = 164.0;
const LEAST_ROOM: f32 = 120.0;
/// Width of the panel from which settings stand in two columns, in points.
const WIDE: f32 = 600.0;
/// Width of the checkbox of a format in points.
const COLUMN: f32 = 270.0;
/// Space for the button beside the folder, in points.
const CHOOSE: f32 = 190.0;

/// State of the export panel.
#[derive(Debug, Clone, Default)]
pub(super) struct OrderPanel {
    pub(super) order: Option<Order>,
    /// Formats that every export has.
    pub(super) always: Vec<&'static str>,
    /// Whether exports go into a folder rather than an archive.
    pub(super) has_folders: bool,
    /// The folder being typed.
    pub(super) folder: String,
    /// Whether the button that writes the files, or before the first order a card, is to be focused.
    wants_focus: bool,
}

impl OrderPanel {
    /// Opens the panel with an initial order.
    ///
    /// A pointer needs no focus, and a focused card would look chosen.
    pub(super) fn ask(&mut self, order: Order, desk: &dyn Host, is_by_pointer: bool) {
        self.folder = order.folder.display().to_string();
        (self.always, self.has_folders) = (desk.always(), desk.has_names());
        self.wants_focus = !is_by_pointer || !order.formats.is_empty();
        self.order = Some(order);
    }

    /// Takes over a folder chosen in the dialog.
    pub(super) fn take(&mut self, folder: &Path) {
        self.folder = folder.display().to_string();
    }

    /// Shows the panel while it is open. `layers` is that knob of the recipe; an export has all layers.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        layers: &str,
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        let Some(order) = &self.order else { return };
        let is_asked = order.formats.is_empty() && std::mem::take(&mut self.wants_focus);
        ui.strong(words.say("Export: where does it go?", "書き出し: 届け先を選ぶ"));
        let window = ui.ctx().content_rect().size();
        let room = (window.y - notice::top(window) - ROOM).max(LEAST_ROOM);
        // A low window has room for one list alone.
        let is_low = panels::is_low(window);
        let list = |name, room| ScrollArea::vertical().id_salt(name).max_height(room);
        let cards = list("order", room).min_scrolled_height(room).show(ui, |ui| {
            if let Some(order) = &mut self.order {
                destinations::show(ui, order, is_asked, words);
                destinations::show_next(ui, order, words);
            }
            if is_low {
                self.details(ui, layers, words, commands);
            }
            focus::bring_into_view(ui);
        });
        ui.separator();
        ui.horizontal_wrapped(|ui| self.place(ui, words, commands));
        ui.horizontal(|ui| self.decide(ui, words, commands));
        if !is_low {
            // Below the button, which so stays where it is when a card brings settings of its own.
            ui.separator();
            let room = (room - cards.content_size.y).max(LEAST_ROOM);
            list("details", room).min_scrolled_height(room).show(ui, |ui| {
                self.details(ui, layers, words, commands);
                focus::bring_into_view(ui);
            });
        }
    }

    /// Shows what need not be asked: single formats, the camera, layers, and the settings of what is ordered.
    fn details(&mut self, ui: &mut Ui, layers: &str, words: Words, commands: &mut Vec<Command>) {
        let Some(order) = &mut self.order else { return };
        let title = RichText::new(words.say("All formats", "すべての形式")).strong();
        let header = CollapsingHeader::new(title).id_salt("all formats");
        // An order for no destination is seen where it was made.
        let is_own = !order.formats.is_empty() && destinations::of(order).is_none();
        header.default_open(is_own).show_unindented(ui, |ui| {
            formats(ui, order, &self.always, words);
            let is_always = |section: &str| self.always.contains(&section) || section == FIGURES;
            settings(ui, order, is_always, words);
        });
        ui.separator();
        ui.horizontal(|ui| {
            ui.label(words.say("Figures seen from", "図の向き"));
            camera(ui, order, words);
        });
        split(ui, layers, words, commands);
        let own = order.formats.clone();
        settings(ui, order, |section| own.contains(&section), words);
    }

    /// Shows the field for the folder or archive.
    fn place(&mut self, ui: &mut Ui, words: Words, commands: &mut Vec<Command>) {
        let (what, name) = match self.has_folders {
            true => (("Folder", "フォルダー"), ("Folder of the export", "書き出すフォルダー")),
            false => (("Archive", "ZIPの名前"), ("Archive of the export", "書き出すZIPの名前")),
        };
        ui.label(words.say(what.0, what.1));
        let wide = (ui.available_width() - CHOOSE).clamp(160.0, 480.0);
        let field = TextEdit::singleline(&mut self.folder).desired_width(wide);
        let field = ui.add(field).accessible_name(words.say(name.0, name.1));
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let choose = words.say("Choose the folder…", "フォルダーを選ぶ…");
        if self.has_folders && ui.button(choose).clicked() {
            commands.push(Command::ChooseFolder);
        }
        let Some(order) = &mut self.order else { return };
        order.folder = PathBuf::from(self.folder.trim());
        if is_entered && order.folder != Path::new("") {
            commands.push(Command::Export(Box::new(order.clone())));
        }
    }

    /// Shows the buttons that export or cancel. The first is focused, since the last order usually fits again. Before
    /// the first order that is the first card.
    fn decide(&mut self, ui: &mut Ui, words: Words, commands: &mut Vec<Command>) {
        let Some(order) = &self.order else { return };
        let is_named = order.folder != Path::new("");
        // It leads on once it is said where the results go. Without that an export has only what every export has.
        let write = Button::new(words.say("Write the files", "書き出す"));
        let write = write.selected(!order.formats.is_empty());
        let write = ui.add_enabled(is_named, write);
        Part::Notices.begins(&write);
        if std::mem::take(&mut self.wants_focus) {
            write.request_focus();
        }
        if write.clicked() {
            commands.push(Command::Export(Box::new(order.clone())));
        }
        if ui.button(words.say("Cancel", "やめる")).clicked() {
            commands.push(Command::Dismiss);
        }
        let all = words.say("sheet.json, tables, figures, recipe", "sheet.json、表、図、レシピ");
        let own = match destinations::of(order) {
            Some(destination) => destination.writes(words).to_owned(),
            None => order.formats.join(" "),
        };
        if own.is_empty() {
            let only =
                words.say("No card is chosen: only ", "届け先が選ばれていません。書き出すのは");
            let text = RichText::new(format!("{only}{all}")).color(ui.visuals().warn_fg_color);
            ui.add(Label::new(text).truncate());
            return;
        }
        let text = match words.is_japanese() {
            true => format!("{own}、ほかに{all}"),
            false => format!("{own}; {all}"),
        };
        // A wider panel would move its buttons.
        ui.add(Label::new(RichText::new(text).weak()).truncate());
    }
}

/// Shows the settings of the wanted formats: paper, tables, pictures.
fn settings(ui: &mut Ui, order: &mut Order, is_wanted: impl Fn(&str) -> bool, words: Words) {
    let mut sections: Vec<&str> = Vec::new();
    let values = order.asked.settings();
    for (knob, _) in &values {
        if let Some(section) = knob.path().0
            && is_wanted(section)
            && sections.last() != Some(&section)
        {
            sections.push(section);
        }
    }
    let mut asked = Vec::new();
    for section in sections {
        let header = CollapsingHeader::new(named(section, words)).id_salt(("asked", section));
        header.default_open(section == PAPER).show_unindented(ui, |ui| {
            let columns = if ui.available_width() > WIDE { 2 } else { 1 };
            Grid::new(section).num_columns(2 * columns).spacing([14.0, 4.0]).show(ui, |ui| {
                let own = values.iter().filter(|(knob, _)| {
                    // The camera is asked once for all figures.
                    let is_asked =
                        knob.path().1 != "camera" && (HAS_PIXELS || knob.path().1 != "png");
                    knob.path().0 == Some(section) && is_asked
                });
                for (at, (knob, value)) in own.enumerate() {
                    knobs::help(ui.label(knobs::label(knob, words)), knob, "", words);
                    ui.horizontal(|ui| {
                        let mut set = |text| asked.push((knob.name, text));
                        ui.name_inputs(knob.name, |ui| {
                            knobs::control(ui, knob, value, words, &mut set);
                        });
                    });
                    if at % columns == columns - 1 {
                        ui.end_row();
                    }
                }
            });
        });
    }
    for (name, value) in asked {
        // If a value is refused, the setting stays as it was.
        drop(order.asked.set(name, &value));
    }
}

/// Title of the settings of a format.
fn named(section: &str, words: Words) -> String {
    let format = FORMATS.iter().find(|format| format.name == section);
    match (section, format) {
        (FIGURES, _) => words.say("Figures", "図の人物").into(),
        (PAPER, _) => words.say("Paper (xsheet)", "用紙 (xsheet)").into(),
        (_, Some(format)) if words.is_japanese() => format!("{}の設定", format.japanese),
        _ => format!("settings of {section}"),
    }
}

/// Shows a checkbox for each format, in as many columns as fit. Formats of every export are checked and disabled.
fn formats(ui: &mut Ui, order: &mut Order, always: &[&'static str], words: Words) {
    // In English a checkbox shows only the short name.
    let column = if words.is_japanese() { COLUMN } else { 0.5 * COLUMN };
    let columns = ((ui.available_width() / column) as usize).clamp(1, 3);
    Grid::new("formats").num_columns(columns).spacing([18.0, 4.0]).show(ui, |ui| {
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
            if at % columns == columns - 1 {
                ui.end_row();
            }
        }
    });
}

/// Shows into which layers the sheet is split: the same knob as in the panel of knobs.
fn split(ui: &mut Ui, layers: &str, words: Words, commands: &mut Vec<Command>) {
    let knob = Knob::find("layers").expect("a recipe has layers");
    let mut set = |text| commands.push(Command::Set(knob.name, text));
    ui.horizontal(|ui| {
        knobs::help(ui.label(knobs::label(knob, words)), knob, "", words);
        knobs::control(ui, knob, layers, words, &mut set);
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
