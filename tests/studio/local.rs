//! Local corrections: frozen genga, genga found again in a part, copied genga, two sheets of one take.

use std::sync::Arc;

use egui::{Event, Key, Modifiers, OutputCommand, Theme};
use egui_kittest::kittest::{NodeT, Queryable};
use genga_studio::Language;

use crate::harness::{Table, sample};

impl Table {
    /// The koma of the genga, from 1, found by stepping the play head.
    pub(crate) fn genga(&mut self) -> Vec<usize> {
        let koma = |table: &Table| -> usize {
            let head = table.harness.get_by_label("Play head").accesskit_node().value().unwrap();
            head.split(' ').next().unwrap().parse().unwrap()
        };
        self.tap(Modifiers::NONE, Key::Home);
        let mut found = vec![koma(self)];
        loop {
            self.tap(Modifiers::NONE, Key::ArrowDown);
            if found.last() == Some(&koma(self)) {
                return found;
            }
            found.push(koma(self));
        }
    }
}

/// A knob setting that leaves fewer genga.
const FEWER: (&str, &str) = ("keys.min_price", "60");

#[test]
fn frozen_genga_stay_whatever_the_knobs_say() {
    let mut table = Table::with_kick();
    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    let before = table.genga();
    table.tap(Modifiers::NONE, Key::W);
    assert_eq!(table.genga(), before, "freezing alone changes nothing");
    table.harness.get_by_label("Frozen");
    table.turn(FEWER.0, FEWER.1);
    assert_eq!(table.genga(), before);
    table.tap(Modifiers::NONE, Key::ArrowUp);
    table.tap(Modifiers::NONE, Key::K);
    assert_eq!(table.edits().forbidden.len(), 1, "a hand still corrects them");
    table.tap(Modifiers::COMMAND, Key::Z);
    table.tap(Modifiers::NONE, Key::W);
    assert!(table.genga().len() < before.len(), "thawed, the knob has its say");
    assert!(table.edits().frozen.is_empty());
}

#[test]
fn a_genga_that_is_taken_away_leaves_none_in_its_place() {
    let mut table = Table::with_kick();
    let before = table.genga();
    for koma in before[1..before.len() - 1].iter().step_by(3) {
        table.go(*koma);
        table.tap(Modifiers::NONE, Key::K);
        let after = table.genga();
        assert_eq!(after.len(), before.len() - 1, "{koma} of {before:?}: {after:?}");
        table.tap(Modifiers::COMMAND, Key::Z);
    }
}

#[test]
fn a_part_is_found_again_and_the_rest_stays() {
    let mut table = Table::with_kick();
    let before = table.genga();
    table.tap(Modifiers::NONE, Key::Y);
    table.harness.get_by_label_contains("Mark a range with I and O");
    table.tap(Modifiers::NONE, Key::W);
    table.turn(FEWER.0, FEWER.1);
    table.go(30);
    table.tap(Modifiers::NONE, Key::I);
    table.go(60);
    table.tap(Modifiers::NONE, Key::O);
    table.tap(Modifiers::NONE, Key::Y);
    let after = table.genga();
    let outside = |koma: &&usize| !(30..=60).contains(*koma);
    let inside = |all: &[usize]| all.iter().filter(|koma| !outside(koma)).count();
    assert!(after.iter().filter(outside).eq(before.iter().filter(outside)), "{after:?}");
    assert!(inside(&after) < inside(&before), "{before:?} {after:?}");
}

#[test]
fn genga_are_copied_from_column_to_column_and_from_take_to_take() {
    let mut table = Table::with_kick();
    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    table.go(40);
    table.tap(Modifiers::NONE, Key::I);
    table.go(46);
    table.tap(Modifiers::NONE, Key::O);
    table.harness.input_mut().events.push(Event::Copy);
    table.harness.step();
    let copied = table.harness.output().platform_output.commands.iter().find_map(|command| {
        if let OutputCommand::CopyText(text) = command { Some(text.clone()) } else { None }
    });
    let text = copied.expect("a text goes to the clipboard");
    assert!(text.contains("frame = 42"), "{text}");
    table.harness.run();
    table.tap(Modifiers::COMMAND, Key::Z);
    table.turn("layers", "limbs");
    table.harness.get_by_label("Column B").click();
    table.harness.run();
    table.harness.input_mut().events.push(Event::Paste(text.clone()));
    table.harness.run();
    assert!(table.edits().layers["B"].pins.iter().any(|pin| pin.frame.0 == 42));
    let mut other =
        Table::with(&sample("pitch.bvh"), Arc::default(), Language::English, Theme::Light);
    other.harness.input_mut().events.push(Event::Paste(text));
    other.harness.run();
    assert!(other.edits().pins.iter().any(|pin| pin.frame.0 == 42), "{:?}", other.edits());
    other.harness.input_mut().events.push(Event::Paste("Dear Sir".into()));
    other.harness.run();
    other.harness.get_by_label_contains("the clipboard has no genga");
}

#[test]
fn one_key_goes_from_one_sheet_to_the_other() {
    let mut table = Table::with_kick();
    table.tap(Modifiers::NONE, Key::X);
    table.turn("spacing.on", "3");
    table.tap(Modifiers::NONE, Key::X);
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "2-3");
    table.tap(Modifiers::NONE, Key::X);
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "3");
    table.harness.get_by_label("B: The other sheet (X)");
}

#[test]
fn koma_are_counted_everywhere_and_frames_when_they_are_asked_for() {
    let mut table =
        Table::with(&sample("kick.bvh"), Arc::default(), Language::English, Theme::Light);
    let says = |table: &Table, text: &str| table.harness.query_by_label_contains(text).is_some();
    assert!(says(&table, "koma    1 / 92"));
    table.tap(Modifiers::NONE, Key::U);
    assert!(says(&table, "frame    0 / 91"));
    table.tap(Modifiers::NONE, Key::U);
    assert!(says(&table, "koma    1 / 92"));
}
