//! Corrections of keys: by the keyboard, on the sheet, over the curves.

use egui::{Key, Modifiers, pos2};
use egui_kittest::kittest::Queryable;
use genga::time::Frame;

use crate::harness::Table;

/// Height of a koma on the sheet in points.
const ROW: f32 = 17.0;

impl Table {
    fn pins(&self) -> Vec<usize> {
        self.edits().pins.iter().map(|pin| pin.frame.0).collect()
    }

    fn moves(&self) -> Vec<(usize, usize)> {
        self.edits().moves.iter().map(|moved| (moved.from.0, moved.to.0)).collect()
    }
}

#[test]
fn a_key_is_set_and_taken_back_on_the_keyboard() {
    let mut table = Table::with_kick();
    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    assert_eq!(table.pins(), [42], "koma 43 shows frame 42");
    table.harness.get_by_label("Remove: pinned koma 43");
    table.tap(Modifiers::NONE, Key::K);
    assert!(table.edits().is_empty());
    table.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!(table.pins(), [42]);
}

#[test]
fn a_found_key_is_locked_moved_and_forbidden_on_the_keyboard() {
    let mut table = Table::with_kick();
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::L);
    let [frame] = table.pins()[..] else { panic!("{:?}", table.pins()) };
    table.tap(Modifiers::NONE, Key::L);
    assert!(table.edits().is_empty());
    table.tap(Modifiers::ALT, Key::ArrowRight);
    assert_eq!(table.moves(), [(frame, frame + 1)]);
    table.tap(Modifiers::ALT, Key::ArrowLeft);
    assert!(table.edits().is_empty(), "it is where it was");
    table.tap(Modifiers::NONE, Key::K);
    assert_eq!(table.edits().forbidden.len(), 1);
    table.harness.get_by_label_contains("Remove: forbidden").click();
    table.harness.run();
    assert!(table.edits().is_empty());
}

#[test]
fn corrections_survive_another_recipe() {
    let mut table = Table::with_kick();
    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    table.turn("spacing.on", "3");
    assert_eq!(table.pins(), [42]);
    table.harness.get_by_label_contains("frame 42");
}

#[test]
fn a_key_is_dragged_on_the_sheet_in_one_step() {
    let mut table = Table::with_kick();
    table.tap(Modifiers::NONE, Key::ArrowDown);
    let koma = table.harness.state().title();
    assert_eq!(koma, "kick – genga", "nothing is changed yet");
    table.tap(Modifiers::NONE, Key::L);
    let [frame] = table.pins()[..] else { panic!("{:?}", table.pins()) };
    table.tap(Modifiers::COMMAND, Key::Z);
    let sheet = table.canvas("Timesheet");
    let row = |koma: usize| pos2(sheet.min.x + 92.0, sheet.min.y + ROW * (koma as f32 + 0.5));
    table.drag(row(frame), row(frame + 2));
    assert_eq!(table.moves(), [(frame, frame + 2)]);
    table.tap(Modifiers::COMMAND, Key::Z);
    assert!(table.edits().is_empty(), "the whole drag was one step");
}

#[test]
fn a_key_is_dragged_over_the_curves() {
    let mut table = Table::with_kick();
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::L);
    let [frame] = table.pins()[..] else { panic!("{:?}", table.pins()) };
    let curves = table.canvas("Speed curves");
    let (left, right) = (curves.min.x + 52.0, curves.max.x - 12.0);
    let place = |frame: usize| left + (right - left) * frame as f32 / 91.0;
    let number = |frame: usize| pos2(place(frame), curves.min.y + 25.0);
    table.drag(number(frame), number(frame + 2));
    assert_eq!(table.pins(), [frame + 2], "a pin moves as a pin");
}

#[test]
fn a_name_is_taken_on_when_the_field_is_left() {
    let mut table = Table::with_kick();
    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    table.tap(Modifiers::NONE, Key::N);
    table.harness.get_by_label("Name of the genga").type_text("contact");
    table.harness.run();
    assert_eq!(table.edits().pins[0].name, None, "not with every letter");
    table.tap(Modifiers::NONE, Key::Enter);
    assert_eq!(table.edits().pins[0].name.as_deref(), Some("contact"));
    assert_eq!(table.edits().pins[0].frame, Frame(42));
}

#[test]
fn a_name_that_is_given_up_is_not_taken_on() {
    let mut table = Table::with_kick();
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::N);
    table.harness.get_by_label("Name of the genga").type_text("contact");
    table.harness.run();
    table.tap(Modifiers::NONE, Key::Escape);
    assert!(table.edits().is_empty());
}

#[test]
fn a_key_gets_a_spacing_weight_of_its_own() {
    let mut table = Table::with_kick();
    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    let weight = table.recipe().spacing.weight;
    table.harness.get_all_by_label("Own spacing weight").next().unwrap().click();
    table.harness.run();
    assert_eq!(table.edits().pins[0].weight, Some(weight));
}

#[test]
fn what_the_chain_refuses_is_said_and_undone() {
    let mut table = Table::with_kick();
    for frame in [42, 43] {
        table.go(frame + 1);
        table.tap(Modifiers::NONE, Key::K);
    }
    let before = table.edits().clone();
    assert_eq!(table.pins(), [42, 43]);
    table.tap(Modifiers::ALT, Key::ArrowLeft);
    table.harness.get_by_label_contains("pinned or moved to twice");
    assert_eq!(*table.edits(), before);
}

#[test]
fn a_hold_is_made_longer_and_shorter_by_its_end_in_one_step() {
    let mut table = Table::with_kick();
    let sheet = table.canvas("Timesheet");
    let line = |koma: usize| pos2(sheet.min.x + 92.0, sheet.min.y + ROW * koma as f32);
    // The first drawing stays for ten koma; inbetweens follow.
    table.drag(line(10), line(7));
    let holds = |table: &Table| -> Vec<(usize, usize)> {
        table.edits().holds.iter().map(|hold| (hold.frame.0, hold.koma)).collect()
    };
    assert_eq!(holds(&table), [(0, 7)]);
    table.drag(line(7), line(2));
    assert_eq!(holds(&table), [(0, 2)]);
    table.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!(holds(&table), [(0, 7)], "a drag is one step");
    table.harness.get_by_label("Reset the hold").click();
    table.harness.run();
    assert!(table.edits().is_empty());
}

#[test]
fn a_hold_is_set_on_the_keyboard_and_survives_another_recipe() {
    let mut table = Table::with_kick();
    table.tap(Modifiers::NONE, Key::CloseBracket);
    table.tap(Modifiers::NONE, Key::CloseBracket);
    table.tap(Modifiers::NONE, Key::OpenBracket);
    assert_eq!(table.edits().holds.len(), 1);
    assert_eq!(table.edits().holds[0].koma, 11);
    table.turn("spacing.on", "3");
    table.harness.get_by_label("held koma 1: for 11");
    table.harness.get_by_label("Remove: held koma 1: for 11").click();
    table.harness.run();
    assert!(table.edits().is_empty());
}

#[test]
fn an_inbetween_is_pulled_towards_its_genga() {
    let mut table = Table::with_kick();
    // Nothing is left out or held.
    for (knob, value) in [("omission.koma_dori", "0"), ("omission.naka_nashi", "0")] {
        table.harness.state_mut().turn(knob, value).unwrap();
    }
    table.harness.run();
    let own = table.recipe().spacing.weight;
    let curves = table.canvas("Speed curves");
    let (left, right) = (curves.min.x + 52.0, curves.max.x - 12.0);
    let at = |place: f64| pos2(left + (right - left) * (place / 91.0) as f32, curves.min.y + 25.0);
    // The last inbetween before the first genga at frame 15 stands on koma 13 of 15, pulled towards it by 0.3.
    let place = 15.0 - 2.0 * (1.0 - own);
    table.drag(at(place), at(14.2));
    let [pin] = &table.edits().pins[..] else { panic!("{:?}", table.edits()) };
    let weight = pin.weight.unwrap();
    assert_eq!(pin.frame, Frame(15));
    assert!((weight - 0.6).abs() < 0.06, "{weight}");
    table.tap(Modifiers::COMMAND, Key::Z);
    assert!(table.edits().is_empty(), "a drag is one step");
}

#[test]
fn inbetweens_crowd_closer_on_the_keyboard() {
    let mut table = Table::with_kick();
    let own = table.recipe().spacing.weight;
    table.tap(Modifiers::NONE, Key::ArrowDown);
    table.tap(Modifiers::NONE, Key::Period);
    table.tap(Modifiers::NONE, Key::Period);
    table.tap(Modifiers::NONE, Key::Comma);
    let weight = table.edits().pins[0].weight.unwrap();
    assert!((weight - own - 0.05).abs() < 1e-9, "{weight}");
}
