//! The bar at the top (ツールバー): files, undo, the counts of the clip, display settings.

use egui::{Align, Button, Layout, RichText, Ui};

use super::command::Command;
use super::counts::Counts;
use super::focus::Part;
use super::icon::{self, Icon};
use super::open_take::Take;
use super::panels::{Panels, Side, is_low};
use super::words::{Language, Words};

/// Width of the window from which everything fits in one row, in points.
const WIDE: f32 = 1120.0;

/// State shown in the bar, and the list of commands it adds to.
pub(super) struct Bar<'a> {
    pub(super) words: Words,
    pub(super) commands: &'a mut Vec<Command>,
    pub(super) panels: &'a Panels,
    pub(super) is_exporting: bool,
    /// Whether the sheet before the last change is shown.
    pub(super) is_before: bool,
}

impl Bar<'_> {
    /// Shows buttons, counts and switches. In a narrow window the counts get a row of their own, if it is not low too.
    pub(super) fn show(&mut self, ui: &mut Ui, take: Option<&Take>, before: Option<Counts>) {
        let is_wide = ui.ctx().content_rect().width() >= WIDE;
        ui.horizontal(|ui| {
            self.files(ui, take);
            if let Some(take) = take.filter(|_| is_wide) {
                ui.separator();
                self.clip(ui, take, before);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| self.switches(ui));
        });
        let has_row = !is_wide && !is_low(ui.ctx().content_rect().size());
        if let Some(take) = take.filter(|_| has_row) {
            ui.horizontal_wrapped(|ui| self.clip(ui, take, before));
        }
    }

    fn files(&mut self, ui: &mut Ui, take: Option<&Take>) {
        let (words, is_open) = (self.words, take.is_some());
        let mut button = |ui: &mut Ui, is_enabled, name: &str, command: Command| {
            let button = ui.add_enabled(is_enabled, Button::new(name));
            if command == Command::OpenFile {
                Part::Bar.begins(&button);
            }
            if button.clicked() {
                self.commands.push(command);
            }
        };
        button(ui, true, words.say("Open", "開く"), Command::OpenFile);
        button(ui, is_open, words.say("Save", "保存"), Command::Save);
        let can_export = is_open && !self.is_exporting;
        button(ui, can_export, words.say("Export", "書き出し"), Command::AskExport);
        ui.separator();
        let can = |can: fn(&Take) -> bool| take.is_some_and(can);
        let (can_undo, can_redo) = (
            can(|take| take.history.can_undo(&take.wanted)),
            can(|take| take.history.can_redo(&take.wanted)),
        );
        button(ui, can_undo, words.say("Undo", "元に戻す"), Command::Undo);
        button(ui, can_redo, words.say("Redo", "やり直す"), Command::Redo);
    }

    /// Shows the clip's name, the letter of the sheet, and the counts.
    fn clip(&mut self, ui: &mut Ui, take: &Take, before: Option<Counts>) {
        let words = self.words;
        let changed = if take.is_changed() { " *" } else { "" };
        let name = RichText::new(format!("{}{changed}", take.name())).strong();
        let response = ui.label(name);
        response.on_hover_text(notes(take));
        if let Some(letter) = take.letter() {
            let other = words.say("The other sheet (X)", "もう一つのシート (X)");
            let name = format!("{letter}: {other}");
            if ui.button(letter).on_hover_text(other).accessible_name(name).clicked() {
                self.commands.push(Command::Other);
            }
        }
        if take.document().edits.freeze() {
            let thaw = words.say("Frozen", "凍結中");
            if ui.button(thaw).on_hover_text("W").clicked() {
                self.commands.push(Command::Freeze);
            }
        }
        if self.is_before {
            let before = words.say("Before the change (V)", "変更前 (V)");
            if ui.add(Button::selectable(true, before)).clicked() {
                self.commands.push(Command::Compare);
            }
        }
        let counts = take.counts();
        for (what, count) in counts.words(&before.unwrap_or(counts), words) {
            ui.weak(what);
            ui.label(count);
        }
    }

    fn switches(&mut self, ui: &mut Ui) {
        let words = self.words;
        let help = words.say("Keys", "キー一覧");
        if ui.button("?").on_hover_text(help).accessible_name(help).clicked() {
            self.commands.push(Command::Help);
        }
        let theme = words.say("Light or dark", "ライト・ダーク");
        if icon::button(ui, Icon::Theme, theme).clicked() {
            self.commands.push(Command::Theme);
        }
        self.language(ui);
        self.sides(ui);
    }

    fn language(&mut self, ui: &mut Ui) {
        let words = self.words;
        let (name, accessible) = match words.language {
            Language::Japanese => ("English", "English"),
            Language::English if words.has_japanese => ("日本語", "日本語"),
            Language::English => ("Japanese", "Japanese"),
        };
        let button = ui.add_enabled(words.has_japanese, Button::new(name));
        let button = button.on_disabled_hover_text("No font with Japanese letters is installed.");
        if button.accessible_name(accessible).clicked() {
            self.commands.push(Command::Language);
        }
    }

    /// Shows a switch for sheet and curves, unless a wide window has both. That of the expert settings stands beside the
    /// goals.
    fn sides(&mut self, ui: &mut Ui) {
        let (words, window) = (self.words, ui.ctx().content_rect().size());
        let sides = [
            (Side::Sheet, words.say("Sheet panel (9)", "シートのパネル (9)")),
            (Side::Curves, words.say("Curves panel (8)", "グラフのパネル (8)")),
        ];
        let is_on = sides.map(|(side, _)| self.panels.is_shown(side, window));
        if window.x >= WIDE && is_on == [true; 2] {
            return;
        }
        for ((side, name), is_on) in sides.into_iter().zip(is_on) {
            if icon::switch(ui, Icon::Panel(side), name, is_on).clicked() {
                self.commands.push(Command::Panel(side));
            }
        }
    }
}

/// Paths of the clip and its recipe, and the reader's notes.
fn notes(take: &Take) -> String {
    let files = [take.path.display().to_string(), take.recipe.display().to_string()];
    files.into_iter().chain(take.notes.iter().cloned()).collect::<Vec<_>>().join("\n")
}
