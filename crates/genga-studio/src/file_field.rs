//! The field for a file name (ファイル名) to open or save to, and the clips opened last.

use std::path::{Path, PathBuf};

use egui::text::{CCursor, CCursorRange};
use egui::{Button, Key, Response, TextEdit, Ui};

use super::command::Command;
use super::focus::Part;
use super::words::Words;

/// State of the field.
#[derive(Debug, Clone, Default)]
pub(super) struct FileField {
    pub(super) is_open: bool,
    pub(super) text: String,
    pub(super) wants_focus: bool,
}

impl FileField {
    /// Shows the field, and below it the clips opened last.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        can_save: bool,
        recent: &[PathBuf],
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        ui.horizontal_wrapped(|ui| self.row(ui, can_save, words, commands));
        if !recent.is_empty() {
            ui.horizontal_wrapped(|ui| {
                ui.weak(words.say("recent", "最近のファイル"));
                self::recent(ui, recent, commands);
            });
        }
    }

    fn row(&mut self, ui: &mut Ui, can_save: bool, words: Words, commands: &mut Vec<Command>) {
        let hint = words.say("clip.bvh or recipe.toml", "clip.bvh または recipe.toml");
        let field = TextEdit::singleline(&mut self.text)
            .desired_width(ui.available_width().min(460.0))
            .hint_text(hint);
        let field = ui.add(field).accessible_name(words.say("File", "ファイル"));
        Part::Notices.begins(&field);
        if std::mem::take(&mut self.wants_focus) {
            field.request_focus();
            choose_all(ui, &field, &self.text);
        }
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let name = self.text.trim();
        let button = |ui: &mut Ui, is_enabled, label: &str| {
            ui.add_enabled(is_enabled, Button::new(label)).clicked()
        };
        let is_named = !name.is_empty();
        let is_asked = button(ui, is_named, words.say("Open it", "開く"));
        if is_asked || is_entered && is_named {
            commands.push(Command::Open(PathBuf::from(name)));
        }
        if button(ui, is_named && can_save, words.say("Save recipe as", "レシピを別名で保存"))
        {
            commands.push(Command::SaveAs(PathBuf::from(name)));
        }
        if button(ui, true, words.say("Choose…", "選ぶ…")) {
            commands.push(Command::Choose);
        }
    }
}

/// Selects all text, so that typing replaces it.
fn choose_all(ui: &Ui, field: &Response, text: &str) {
    if let Some(mut state) = TextEdit::load_state(ui.ctx(), field.id) {
        let all = CCursorRange::two(CCursor::default(), CCursor::new(text.chars().count()));
        state.cursor.set_char_range(Some(all));
        state.store(ui.ctx(), field.id);
    }
}

/// Links that open the clips opened last again, by name.
pub(super) fn recent(ui: &mut Ui, recent: &[PathBuf], commands: &mut Vec<Command>) {
    for clip in recent {
        if ui.link(name(clip)).on_hover_text(clip.display().to_string()).clicked() {
            commands.push(Command::Open(clip.clone()));
        }
    }
}

fn name(clip: &Path) -> String {
    clip.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}
