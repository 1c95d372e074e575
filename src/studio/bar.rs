//! The bar on top (ツールバー): files, undo, what the clip costs, how it looks.

use egui::{Align, Button, Layout, RichText, Ui};

use super::command::Command;
use super::counts::Counts;
use super::icon::{self, Icon};
use super::take::Take;
use super::words::{Language, Words};

/// Shows the buttons, the counts and the switches.
pub(super) fn show(
    ui: &mut Ui,
    take: Option<&mut Take>,
    before: Option<Counts>,
    is_exporting: bool,
    words: Words,
    commands: &mut Vec<Command>,
) {
    ui.horizontal(|ui| {
        let mut button = |ui: &mut Ui, is_enabled, name: &str, command: Command| {
            if ui.add_enabled(is_enabled, Button::new(name)).clicked() {
                commands.push(command);
            }
        };
        let is_open = take.is_some();
        button(ui, true, words.say("Open", "開く"), Command::OpenFile);
        button(ui, is_open, words.say("Save", "保存"), Command::Save);
        let can_export = is_open && !is_exporting;
        button(ui, can_export, words.say("Export", "書き出し"), Command::AskExport);
        ui.separator();
        let can = |can: fn(&Take) -> bool| take.as_deref().is_some_and(can);
        let (can_undo, can_redo) = (
            can(|take| take.history.can_undo(&take.wanted)),
            can(|take| take.history.can_redo(&take.wanted)),
        );
        button(ui, can_undo, words.say("Undo", "元に戻す"), Command::Undo);
        button(ui, can_redo, words.say("Redo", "やり直す"), Command::Redo);
        ui.separator();
        if let Some(take) = take {
            let changed = if take.is_changed() { " *" } else { "" };
            let name = RichText::new(format!("{}{changed}", take.name())).strong();
            let response = ui.label(name);
            response.on_hover_text(notes(take));
            if let Some(letter) = take.letter() {
                let other = words.say("The other sheet (X)", "もう一つのシート (X)");
                if ui.button(letter).on_hover_text(other).accessible_name(other).clicked() {
                    commands.push(Command::Other);
                }
            }
            if take.document().edits.freeze() {
                let thaw = words.say("Frozen", "凍結中");
                if ui.button(thaw).on_hover_text("W").clicked() {
                    commands.push(Command::Freeze);
                }
            }
            let counts = take.counts();
            for (what, count) in counts.words(&before.unwrap_or(counts), words) {
                ui.weak(what);
                ui.label(count);
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| switches(ui, words, commands));
    });
}

/// The file, its recipe, and what the reader said.
fn notes(take: &Take) -> String {
    let files = [take.path.display().to_string(), take.recipe.display().to_string()];
    files.into_iter().chain(take.notes.iter().cloned()).collect::<Vec<_>>().join("\n")
}

fn switches(ui: &mut Ui, words: Words, commands: &mut Vec<Command>) {
    let help = words.say("Keys", "キー一覧");
    if ui.button("?").on_hover_text(help).accessible_name(help).clicked() {
        commands.push(Command::Help);
    }
    let theme = words.say("Light or dark", "明るい・暗い画面");
    if icon::button(ui, Icon::Theme, theme).clicked() {
        commands.push(Command::Theme);
    }
    let (name, accessible) = match words.language {
        Language::Japanese => ("English", "English"),
        Language::English if words.has_japanese => ("日本語", "日本語"),
        Language::English => ("Japanese", "Japanese"),
    };
    let button = ui.add_enabled(words.has_japanese, Button::new(name));
    let button = button.on_disabled_hover_text("No font with Japanese letters is installed.");
    if button.accessible_name(accessible).clicked() {
        commands.push(Command::Language);
    }
}
