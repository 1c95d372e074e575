//! Spoken lines: marked on the sheet, changed, undone, saved, exported.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, Theme};
use egui_kittest::Node;
use egui_kittest::kittest::Queryable;
use genga::edits::Speech;
use genga_files::xdts;
use genga_studio::Language;

use crate::harness::{Table, sample};

impl Table {
    /// The middle of a koma, from 1, in the S column of the sheet.
    fn speech(&self, koma: usize) -> Pos2 {
        let sheet = self.canvas("Timesheet");
        sheet.min + egui::vec2(60.0, 17.0 * (koma as f32 - 0.5))
    }

    /// Drags down the S column, and writes a line.
    pub(crate) fn say(&mut self, from: usize, to: usize, speaker: &str, words: &str) {
        let (from, to) = (self.speech(from), self.speech(to));
        self.drag(from, to);
        self.write("Words", words);
        if !speaker.is_empty() {
            self.write("Speaker", speaker);
        }
        self.harness.get_by_label("Write the line").click();
        self.harness.run();
    }

    /// Replaces the text of a field.
    pub(crate) fn write(&mut self, field: &str, text: &str) {
        self.field(field).focus();
        self.harness.run();
        self.tap(Modifiers::COMMAND, Key::A);
        self.field(field).type_text(text);
        self.harness.run();
    }

    /// The field of a name, for words or for a number, rather than the label beside it.
    pub(crate) fn field<'a>(&'a self, name: &'a str) -> Node<'a> {
        let words = self.harness.query_by_role_and_label(Role::TextInput, name);
        words.unwrap_or_else(|| self.harness.get_by_role_and_label(Role::SpinButton, name))
    }

    fn lines(&self) -> Vec<String> {
        self.edits().speech.iter().map(Speech::to_string).collect()
    }
}

#[test]
fn a_hand_down_the_s_column_marks_a_line_and_a_click_opens_it() {
    let mut table = Table::with_kick();
    table.say(5, 10, "Aki", "Yah!");
    assert_eq!(table.lines(), ["4..10:Aki:Yah!"]);
    assert!(table.harness.query_by_label("Write the line").is_none());
    assert_eq!(table.edits().pins, [], "nothing else was touched");
    // The last speaker is offered again.
    table.say(13, 14, "", "Ha");
    assert_eq!(table.lines(), ["4..10:Aki:Yah!", "12..14:Aki:Ha"]);
    let at = table.speech(7);
    table.harness.hover_at(at);
    table.harness.drag_at(at);
    // A long press is no click.
    table.harness.step();
    table.harness.drop_at(at);
    table.harness.run();
    table.write("Words", "Hey");
    table.tap(Modifiers::NONE, Key::Enter);
    assert_eq!(table.lines(), ["4..10:Aki:Hey", "12..14:Aki:Ha"]);
    table.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!(table.lines(), ["4..10:Aki:Yah!", "12..14:Aki:Ha"]);
    table.tap(Modifiers::COMMAND, Key::Z);
    table.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!(table.lines(), [""; 0]);
    table.tap(Modifiers::COMMAND, Key::Y);
    assert_eq!(table.lines(), ["4..10:Aki:Yah!"]);
}

#[test]
fn the_keyboard_alone_writes_a_line_over_the_played_part_and_takes_it_out() {
    let mut table = Table::with_kick();
    table.go(3);
    table.tap(Modifiers::NONE, Key::I);
    table.go(8);
    table.tap(Modifiers::NONE, Key::O);
    let open = |table: &mut Table| {
        table.harness.get_by_label("Spoken line (S)").focus();
        table.harness.run();
        table.tap(Modifiers::NONE, Key::Enter);
    };
    open(&mut table);
    table.field("Words").type_text("Go");
    table.harness.run();
    table.tap(Modifiers::NONE, Key::Enter);
    assert_eq!(table.lines(), ["2..8:Go"]);
    table.tap(Modifiers::NONE, Key::P);
    open(&mut table);
    table.harness.get_by_label("Delete the line").click();
    table.harness.run();
    assert_eq!(table.lines(), [""; 0]);
    open(&mut table);
    table.tap(Modifiers::NONE, Key::Escape);
    table.tap(Modifiers::NONE, Key::Escape);
    assert!(table.harness.query_by_label("Write the line").is_none());
}

/// The spoken lines of an exported timesheet: koma from 1, and the words.
pub(crate) fn lines_of(file: &Path) -> Vec<(usize, usize, String)> {
    let read = xdts::read(&std::fs::read(file).unwrap()).unwrap();
    read.lines.iter().map(|line| (line.begin + 1, line.past(), line.to_string())).collect()
}

#[test]
fn what_is_spoken_is_saved_reopened_and_exported_as_the_program_does() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("kick.bvh");
    std::fs::copy(sample("kick.bvh"), &clip).unwrap();
    let mut table = Table::with(&clip, Arc::default(), Language::English, Theme::Light);
    table.say(2, 6, "Aki", "Yah!");
    table.tap(Modifiers::COMMAND, Key::S);
    table.tap(Modifiers::COMMAND, Key::E);
    table.harness.get_by_label("All formats").click();
    table.harness.run();
    for format in ["xdts", "xsheet"] {
        table.harness.get_by_label(format).click();
        table.harness.run();
    }
    table.harness.get_by_label("Write the files").click();
    (0..3).for_each(|_| table.harness.step());
    table.rest();
    let out = place.path().join("kick-genga");
    for side in ["genga", "douga"] {
        let lines = lines_of(&out.join(format!("kick_{side}_ts.xdts")));
        assert_eq!(lines, [(2, 6, "Aki: Yah!".to_owned())]);
    }
    let recipe = place.path().join("saved.toml");
    let saved = table.desk.text(&place.path().join("kick.genga.toml")).unwrap();
    std::fs::write(&recipe, saved).unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_genga"))
        .args(["run", "--quiet", "--deliver", "xdts,xsheet"])
        .args([clip.as_os_str(), "--recipe".as_ref(), recipe.as_os_str()])
        .args(["--out".as_ref(), place.path().join("run").as_os_str()])
        .status();
    assert!(run.unwrap().success());
    for file in ["sheet.json", "kick_genga_ts.xdts", "kick_douga_ts.xdts", "xsheet/0001.svg"] {
        let read = |folder: &str| std::fs::read(place.path().join(folder).join(file)).unwrap();
        assert_eq!(read("kick-genga"), read("run"), "{file}");
    }
    let desk = Arc::clone(&table.desk);
    let again = Table::with(&clip, desk, Language::English, Theme::Light);
    assert_eq!(again.lines(), ["1..6:Aki:Yah!"]);
}

#[test]
fn the_form_is_in_japanese() {
    let mut table =
        Table::with(&sample("kick.bvh"), Arc::default(), Language::Japanese, Theme::Light);
    table.harness.get_by_label("セリフ (S)").click();
    table.harness.run();
    for label in ["話者", "言葉", "開始コマ", "終了コマ"] {
        table.field(label);
    }
    table.field("言葉").type_text("えい！");
    table.harness.run();
    table.harness.get_by_label("書き込む").click();
    table.harness.run();
    assert_eq!(table.lines(), ["0..24:えい！"]);
}
