//! Behaviour that once was rough: quick input, menus, notices, and labels in Japanese.

use std::path::Path;
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, Theme, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use genga_studio::Language;

use crate::harness::{Table, sample};

impl Table {
    /// Presses a key twice in one frame.
    fn twice(&mut self, key: Key) {
        for _ in 0..2 {
            self.harness.input_mut().events.push(egui::Event::Key {
                key,
                physical_key: None,
                pressed: true,
                repeat: false,
                modifiers: Modifiers::NONE,
            });
        }
        self.harness.run();
    }

    fn says_nothing(&self) -> bool {
        self.harness.query_by_label("Close the message").is_none()
    }
}

#[test]
fn a_key_pressed_twice_at_once_sets_and_takes_back() {
    let mut table = Table::with_kick();
    table.go(43);
    table.twice(Key::K);
    assert!(table.says_nothing());
    assert!(table.edits().is_empty(), "{:?}", table.edits());
    table.go(10);
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::K);
    assert_eq!(table.edits().forbidden.len(), 1);
    table.twice(Key::K);
    assert!(table.says_nothing());
    assert!(table.edits().pins.is_empty(), "set and taken back: {:?}", table.edits());
    assert_eq!(table.edits().forbidden.len(), 1, "what was taken away stays away");
}

#[test]
fn escape_closes_a_menu_and_leaves_the_rest() {
    let mut table = Table::with_kick();
    table.tap(Modifiers::COMMAND, Key::O);
    let sheet = table.canvas("Timesheet");
    let at = sheet.min + vec2(92.0, 17.0 * 2.5);
    let count = |table: &Table| table.harness.query_all_by_label("Pin here").count();
    let before = count(&table);
    table.harness.hover_at(at);
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Secondary, Modifiers::NONE);
        let event = egui::Event::PointerButton { pos: at, button, pressed, modifiers };
        table.harness.event(event);
    }
    table.harness.run();
    assert_eq!(count(&table), before + 1, "the menu is open");
    table.tap(Modifiers::NONE, Key::Escape);
    assert_eq!(count(&table), before, "the menu is closed");
    table.harness.get_by_label("File");
    table.tap(Modifiers::NONE, Key::Escape);
    assert!(table.harness.query_by_label("File").is_none());
}

#[test]
fn the_sheet_and_the_views_stay_where_they_are_whatever_is_said() {
    let mut table = Table::with_kick();
    let places = |table: &Table| (table.canvas("Timesheet").min, table.canvas("Source"));
    let before = places(&table);
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.harness.get_by_label("Name of the genga");
    assert_eq!(places(&table), before, "a genga has more in its panel than an inbetween");
    table.tap(Modifiers::NONE, Key::L);
    table.tap(Modifiers::COMMAND, Key::S);
    assert!(!table.says_nothing());
    assert_eq!(places(&table), before, "a message lies over the table");
    table.tap(Modifiers::COMMAND, Key::O);
    assert_eq!(places(&table), before, "so does the field for a file");
}

#[test]
fn what_is_typed_next_takes_the_place_of_the_old_name() {
    let mut table = Table::with_kick();
    for name in ["/recipes/twos.toml", "/recipes/threes.toml"] {
        table.desk.write_text(Path::new(name), "[spacing]\non = 3\n");
        table.tap(Modifiers::COMMAND, Key::O);
        table.harness.get_by_label("File").type_text(name);
        table.harness.run();
        let field = table.harness.get_by_label("File");
        assert_eq!(field.accesskit_node().value().unwrap(), name);
        table.harness.get_by_label("Open it").click();
        table.harness.run();
        assert!(table.says_nothing());
    }
}

#[test]
fn in_japanese_choices_and_reasons_are_japanese_too() {
    let mut table =
        Table::with(&sample("kick.bvh"), Arc::default(), Language::Japanese, Theme::Light);
    let chosen = |table: &Table, knob: &str| {
        table.harness.get_by_role_and_label(Role::ComboBox, knob).accesskit_node().value()
    };
    assert_eq!(chosen(&table, "spacing.source").as_deref(), Some("元の動き"));
    assert_eq!(chosen(&table, "spacing.on").as_deref(), Some("2〜3コマ打ち"));
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.harness.get_by_label_contains("誤差を防ぐ");
}
