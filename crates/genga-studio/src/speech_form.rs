//! The form of a spoken line (セリフ): who says what, over which koma.

use std::ops::Range;

use egui::{Button, DragValue, Grid, Key, TextEdit, Ui};

use super::command::Command;
use super::corrections::Correction;
use super::words::Words;
use genga::edits::Speech;
use genga::sheet::Sheet;
use genga::time::Frame;

/// Width of the field for the words, in points.
const WIDE: f32 = 420.0;

/// State of the form.
#[derive(Debug, Clone, Default)]
pub(super) struct SpeechForm {
    asked: Option<Asked>,
}

#[derive(Debug, Clone)]
struct Asked {
    /// The line being changed. `None` for a new one.
    before: Option<Speech>,
    /// The koma, with an exclusive end.
    koma: Range<usize>,
    speaker: String,
    words: String,
    wants_focus: bool,
}

impl SpeechForm {
    pub(super) fn is_open(&self) -> bool {
        self.asked.is_some()
    }

    pub(super) fn close(&mut self) {
        self.asked = None;
    }

    /// Opens the form for a new line over some koma.
    pub(super) fn ask(&mut self, koma: Range<usize>, speaker: String) {
        let words = String::new();
        self.asked = Some(Asked { before: None, koma, speaker, words, wants_focus: true });
    }

    /// Opens the form for an existing line.
    pub(super) fn edit(&mut self, speech: &Speech, koma: Range<usize>) {
        let (speaker, words) = (speech.speaker.clone(), speech.words.clone());
        let before = Some(speech.clone());
        self.asked = Some(Asked { before, koma, speaker, words, wants_focus: true });
    }

    /// Shows the form. `last` is the clip's last frame.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        sheet: &Sheet,
        last: Frame,
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        let Some(asked) = &mut self.asked else { return };
        let length = sheet.length();
        ui.strong(words.say("Spoken line (S)", "セリフ"));
        let is_entered = asked.fields(ui, length, words);
        let is_whole = !asked.words.trim().is_empty();
        let mut correction = None;
        ui.horizontal(|ui| {
            let write = Button::new(words.say("Write the line", "書き込む"));
            let is_asked = ui.add_enabled(is_whole, write).clicked();
            if is_whole && (is_asked || is_entered) {
                correction =
                    Some(Correction::Say(asked.before.clone(), Some(asked.line(sheet, last))));
            }
            let take_out = words.say("Delete the line", "セリフを削除");
            if asked.before.is_some() && ui.button(take_out).clicked() {
                correction = Some(Correction::Say(asked.before.clone(), None));
            }
            if ui.button(words.say("Cancel", "やめる")).clicked() {
                commands.push(Command::Dismiss);
            }
        });
        if let Some(correction) = correction {
            commands.push(Command::Correct(correction));
            self.asked = None;
        }
    }
}

impl Asked {
    /// Shows the fields. Returns whether Enter was pressed in one.
    fn fields(&mut self, ui: &mut Ui, length: usize, words: Words) -> bool {
        let mut is_left = false;
        Grid::new("speech").num_columns(2).spacing([10.0, 6.0]).show(ui, |ui| {
            let label = words.say("Speaker", "話者");
            ui.label(label);
            let field = TextEdit::singleline(&mut self.speaker).desired_width(160.0);
            is_left |= ui.add(field).accessible_name(label).lost_focus();
            ui.end_row();
            let label = words.say("Words", "言葉");
            ui.label(label);
            let field = ui.add(TextEdit::singleline(&mut self.words).desired_width(WIDE));
            let field = field.accessible_name(label);
            if std::mem::take(&mut self.wants_focus) {
                field.request_focus();
            }
            is_left |= field.lost_focus();
            ui.end_row();
            ui.label(words.say("Koma", "コマ"));
            ui.horizontal(|ui| self.range(ui, length, words));
            ui.end_row();
        });
        is_left && ui.input(|input| input.key_pressed(Key::Enter))
    }

    /// The first and last koma, counted from 1 as on the sheet. Both are inclusive.
    fn range(&mut self, ui: &mut Ui, length: usize, words: Words) {
        let (mut from, mut to) = (self.koma.start + 1, self.koma.end);
        let first = DragValue::new(&mut from).range(1..=length.max(1)).speed(0.2);
        ui.add(first).accessible_name(words.say("From koma", "開始コマ"));
        ui.label("–");
        let last = DragValue::new(&mut to).range(from..=length.max(from)).speed(0.2);
        ui.add(last).accessible_name(words.say("To koma", "終了コマ"));
        self.koma = from - 1..to.max(from);
    }

    fn line(&self, sheet: &Sheet, last: Frame) -> Speech {
        let koma = (self.koma.start, self.koma.end);
        Speech::over(koma, (sheet.clock, last, sheet.length()), &self.speaker, &self.words)
    }
}
