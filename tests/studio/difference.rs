//! What a change made of the sheet: its counts beside it, what went and came, and one key for before and after.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use crate::harness::Table;

impl Table {
    fn shows(&self, text: &str) -> bool {
        self.harness.query_all_by_label_contains(text).next().is_some()
    }
}

#[test]
fn a_change_says_what_it_made_until_the_next_one() {
    let mut table = Table::plain_kick();
    assert!(!table.shows("13 to"));
    table.harness.get_by_label("TV acting").click();
    table.harness.run();
    assert!(table.shows("13 to "), "it has fewer genga");
    table.write_to_look_at("difference");
    table.tap(Modifiers::NONE, Key::ArrowRight);
    assert!(table.shows("13 to "), "whoever only looks round still sees it");
    table.tap(Modifiers::NONE, Key::Escape);
    assert!(!table.shows("13 to "), "until it is put away");
}

#[test]
fn one_key_goes_before_the_change_and_after_it() {
    let mut table = Table::plain_kick();
    table.harness.get_by_label("TV acting").click();
    table.harness.run();
    let after = table.recipe().clone();
    let note = "Before the change (V)";
    for _ in 0..2 {
        table.tap(Modifiers::NONE, Key::V);
        assert_eq!(table.recipe().get("spacing.on").unwrap(), "2-3");
        table.harness.get_by_label(note);
        table.tap(Modifiers::NONE, Key::V);
        assert_eq!(*table.recipe(), after);
        assert!(table.harness.query_by_label(note).is_none());
    }
    // A change made before the change is a change like any other.
    table.tap(Modifiers::NONE, Key::V);
    table.tap(Modifiers::NONE, Key::CloseBracket);
    assert!(table.harness.query_by_label(note).is_none());
    table.tap(Modifiers::NONE, Key::V);
    assert!(table.edits().is_empty());
}
