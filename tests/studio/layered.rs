//! Several columns: each has its own genga and pins, and one composite shows them all.

use std::sync::Arc;

use egui::{Key, Modifiers, Theme, pos2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use genga_studio::Language;

use crate::harness::{Table, sample};

impl Table {
    /// Opens a kick in five columns, in a window so high that the sheet need not be scrolled.
    fn with_limbs() -> Self {
        let window = ((1440, 1300), 1.0);
        let mut table = Self::in_window(window, Arc::default(), Language::English, Theme::Light);
        table.open(&sample("kick.bvh"));
        table.harness.state_mut().turn("layers", "limbs").unwrap();
        table.harness.run();
        table
    }

    /// Name of the selected column, as the screen reader gets it.
    fn column(&self) -> String {
        let sheet = self.harness.get_by_role_and_label(egui::accesskit::Role::Canvas, "Timesheet");
        sheet.accesskit_node().value().unwrap().split(' ').next().unwrap().to_owned()
    }

    fn pins_of(&self, column: &str) -> Vec<usize> {
        let own = self.edits().layers.get(column);
        own.into_iter().flat_map(|own| &own.pins).map(|pin| pin.frame.0).collect()
    }
}

#[test]
fn every_column_stands_on_the_sheet_and_has_pins_of_its_own() {
    let mut table = Table::with_limbs();
    for name in ["A", "B", "C", "D", "E"] {
        table.harness.get_by_label(&format!("Column {name}"));
    }
    assert_eq!(table.column(), "A");
    table.harness.get_by_label("Column C").click();
    table.harness.run();
    assert_eq!(table.column(), "C");
    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    assert!(table.edits().layers.keys().eq(["C"]), "{:?}", table.edits());
    assert!(table.edits().pins.is_empty() && table.edits().forbidden.is_empty(), "of no other");
    table.harness.get_by_label_contains("Remove: C ").click();
    table.harness.run();
    assert!(table.edits().is_empty());
}

#[test]
fn a_key_goes_to_the_next_column_and_round() {
    let mut table = Table::with_limbs();
    for column in ["B", "C", "D", "E", "A"] {
        table.tap(Modifiers::NONE, Key::A);
        assert_eq!(table.column(), column);
    }
}

#[test]
fn a_genga_is_dragged_in_its_own_column() {
    let mut table = Table::with_limbs();
    table.tap(Modifiers::NONE, Key::A);
    // The second genga stands on the koma of its frame.
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::L);
    let [frame] = table.pins_of("B")[..] else { panic!("{:?}", table.edits()) };
    table.tap(Modifiers::COMMAND, Key::Z);
    table.harness.get_by_label("Column A").click();
    table.harness.run();
    let sheet = table.canvas("Timesheet");
    // The middle of column B is 34 points to the right of that of A.
    let row = |koma: usize| sheet.min + vec2(126.0, 17.0 * (koma as f32 + 0.5));
    table.drag(row(frame), row(frame + 2));
    let moves = &table.edits().layers["B"].moves;
    assert_eq!((moves[0].from.0, moves[0].to.0), (frame, frame + 2));
    assert_eq!(table.column(), "B", "the hand has chosen it");
}

#[test]
fn layers_are_chosen_in_the_panel_and_the_counts_are_of_all_columns() {
    let mut table = Table::with_kick();
    table.harness.get_by_label("Sheet").click();
    table.harness.run();
    table.harness.get_by_label("layers").click();
    table.harness.run();
    table.harness.get_by_label("limbs").click();
    table.harness.run();
    assert_eq!(table.recipe().get("layers").unwrap(), "limbs");
    table.harness.get_by_label("Column E");
}

#[test]
fn the_sheet_grows_and_shrinks_by_keys() {
    let mut table = Table::with_kick();
    let before = table.canvas("Timesheet");
    table.tap(Modifiers::NONE, Key::R);
    let high = table.canvas("Timesheet").height();
    assert!(high > 1.2 * before.height(), "{high}");
    (0..20).for_each(|_| table.tap(Modifiers::SHIFT, Key::R));
    let low = table.canvas("Timesheet").height();
    assert!((low - 92.0 * 4.0).abs() < 0.1, "as low as it goes: {low}");
    let sheet = table.canvas("Timesheet");
    table.harness.drag_at(pos2(sheet.min.x + 20.0, sheet.min.y + 4.0 * 50.5));
    table.harness.run();
    table.harness.drop_at(pos2(sheet.min.x + 20.0, sheet.min.y + 4.0 * 50.5));
    table.harness.run();
    let head = table.harness.get_by_label("Play head");
    assert_eq!(head.accesskit_node().value().unwrap(), "51 / 92");
}
