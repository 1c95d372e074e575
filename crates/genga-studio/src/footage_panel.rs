//! The panel of reference footage (参考の画面): files, first koma, and placement of the pictures.

use egui::{DragValue, Grid, Key, TextEdit, Ui};

use super::command::{Command, Placement};
use super::words::Words;
use genga::recipe::Footage;

/// Width of a file field in points.
const WIDE: f32 = 420.0;

/// State of the panel, with the file names being typed.
#[derive(Debug, Clone, Default)]
pub(super) struct FootagePanel {
    pub(super) is_open: bool,
    pictures: String,
    sound: String,
}

impl FootagePanel {
    /// Opens the panel for some footage.
    pub(super) fn ask(&mut self, footage: &Footage) {
        (self.pictures, self.sound) = (footage.pictures.clone(), footage.sound.clone());
        self.is_open = true;
    }

    /// Shows the panel. Changes take effect at once.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        (footage, placement, is_silent, is_listing): (&Footage, &Placement, bool, bool),
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        ui.strong(words.say("Reference: pictures and sound", "参考の映像と音"));
        let mut wanted = footage.clone();
        Grid::new("footage").num_columns(2).spacing([10.0, 6.0]).show(ui, |ui| {
            let (label, hint) = (
                words.say("Pictures", "映像"),
                words.say(
                    "a folder, take_0001.png, take.mp4",
                    "フォルダー、take_0001.png、take.mp4",
                ),
            );
            file(ui, (label, hint), &mut self.pictures, &mut wanted.pictures);
            ui.end_row();
            ui.label("");
            ui.horizontal(|ui| {
                offset(
                    ui,
                    words.say("First picture on koma", "映像の開始コマ"),
                    &mut wanted.offset,
                );
                let a_second = words.say("pictures a second", "枚/秒");
                let rate = DragValue::new(&mut wanted.fps).range(1.0..=240.0).speed(0.1);
                ui.add(rate.max_decimals(3)).accessible_name(a_second);
                ui.label(a_second);
            });
            ui.end_row();
            ui.label("");
            ui.horizontal(|ui| self::placement(ui, *placement, words, commands));
            ui.end_row();
            let (label, hint) = (words.say("Sound", "音"), "take.wav");
            file(ui, (label, hint), &mut self.sound, &mut wanted.sound);
            ui.end_row();
            ui.label("");
            ui.horizontal(|ui| {
                offset(
                    ui,
                    words.say("Sound begins on koma", "音の開始コマ"),
                    &mut wanted.sound_offset,
                );
                let mut is_heard = !is_silent;
                if ui.checkbox(&mut is_heard, words.say("Heard", "音を出す")).changed() {
                    commands.push(Command::Silence);
                }
            });
            ui.end_row();
        });
        ui.horizontal(|ui| {
            if ui.button(words.say("Choose a file…", "ファイルを選ぶ…")).clicked() {
                commands.push(Command::Choose);
            }
            if ui.button(words.say("Close", "閉じる")).clicked() {
                commands.push(Command::Dismiss);
            }
            if is_listing {
                ui.spinner();
                ui.label(words.say("searching for pictures", "映像を検索中"));
            }
        });
        if wanted != *footage {
            commands.push(Command::Footage(wanted));
        }
    }
}

/// A field for a file name. The name takes effect when the field is left, unless by Escape.
fn file(ui: &mut Ui, (label, hint): (&str, &str), typed: &mut String, wanted: &mut String) {
    ui.label(label);
    let field = TextEdit::singleline(typed).desired_width(WIDE).hint_text(hint);
    let field = ui.add(field).accessible_name(label);
    let is_left = field.lost_focus() && !ui.input(|input| input.key_pressed(Key::Escape));
    if is_left && typed.trim() != wanted {
        *wanted = typed.trim().to_owned();
    }
}

/// A koma, counted from 1 as on the sheet. Values below 1 lie before the sheet.
fn offset(ui: &mut Ui, label: &str, offset: &mut i64) {
    ui.label(label);
    let mut koma = *offset + 1;
    let value = ui.add(DragValue::new(&mut koma).speed(0.2)).accessible_name(label);
    if value.changed() {
        *offset = (koma - 1).clamp(-1_000_000, 1_000_000);
    }
}

fn placement(ui: &mut Ui, now: Placement, words: Words, commands: &mut Vec<Command>) {
    for (placement, name) in [
        (Placement::Beside, words.say("Beside the view", "横に並べる")),
        (Placement::Behind, words.say("Behind the figures", "人物の後ろに")),
        (Placement::Off, words.say("Not shown", "表示しない")),
    ] {
        if ui.radio(now == placement, name).clicked() {
            commands.push(Command::Place(placement));
        }
    }
}
