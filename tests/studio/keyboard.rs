//! The keyboard alone: every action works without a mouse, and the focused control is visible.

use std::collections::BTreeSet;
use std::sync::Arc;

use egui::accesskit::{Role, Toggled};
use egui::{Event, Key, Modifiers, Theme};
use egui_kittest::kittest::{NodeT, Queryable};
use genga::recipe::Recipe;
use genga_studio::Language;

use crate::harness::{Table, sample};

impl Table {
    fn strike(&mut self, key: Key) {
        self.tap(Modifiers::NONE, key);
    }

    /// Enters a name, and waits until its file is opened.
    fn enter(&mut self) {
        self.harness.key_press(Key::Enter);
        (0..2).for_each(|_| self.harness.step());
        self.wait();
    }

    /// Name of the focused control. `None` if there is none.
    pub(crate) fn focused(&self) -> Option<String> {
        let mut own = self.harness.query_all_by(|node| node.is_focused());
        own.find_map(|node| node.accesskit_node().label())
    }

    /// Presses Tab until a control with this name is focused.
    fn walk_to(&mut self, name: &str) {
        for _ in 0..400 {
            self.strike(Key::Tab);
            if self.focused().is_some_and(|own| own.starts_with(name)) {
                return;
            }
        }
        panic!("{name} is not reached");
    }

    /// Presses F6 until the part that begins with this control is focused.
    fn part(&mut self, name: &str) {
        for _ in 0..10 {
            self.strike(Key::F6);
            if self.focused().as_deref() == Some(name) {
                return;
            }
        }
        panic!("no part begins with {name}");
    }

    fn is_there(&self, name: &str) -> bool {
        self.harness.query_by_label(name).is_some()
    }

    fn koma_now(&self) -> usize {
        let head = self.harness.get_by_role_and_label(Role::Slider, "Play head");
        let text = head.accesskit_node().value().unwrap();
        text.split(' ').next().unwrap().parse().unwrap()
    }

    /// All points of the drawing, which differ if anything drawn differs.
    fn drawing(&self) -> Vec<egui::Pos2> {
        let mut points = Vec::new();
        for clipped in &self.harness.output().shapes {
            if let egui::Shape::Path(path) = &clipped.shape {
                points.extend(&path.points);
            }
        }
        points
    }
}

#[test]
fn every_control_has_the_keyboard_once_in_a_round() {
    let mut table = Table::with_kick();
    let mut seen = Vec::new();
    table.strike(Key::Tab);
    while let Some(name) = table.focused() {
        if seen.len() > 3 && seen.first() == Some(&name) {
            break;
        }
        seen.push(name);
        assert!(seen.len() < 400, "the round does not end: {seen:?}");
        table.strike(Key::Tab);
    }
    assert!(table.edits().is_empty(), "{:?}", table.edits());
    assert_eq!(*table.recipe(), Recipe::default(), "who passes by changes nothing");
    let reached: BTreeSet<&str> = seen.iter().map(String::as_str).collect();
    let controls = table.harness.query_all_by(|node| {
        let roles = [Role::Button, Role::CheckBox, Role::ComboBox, Role::Slider, Role::TextInput];
        roles.contains(&node.role()) && !node.is_disabled()
    });
    for node in controls {
        let name = node.accesskit_node().label().unwrap_or_default();
        assert!(reached.contains(&name[..]), "{name} is not reached: {seen:?}");
    }
}

#[test]
fn what_has_the_keyboard_is_framed() {
    let mut table = Table::with_kick();
    for _ in 0..30 {
        table.strike(Key::Tab);
        let own = table.harness.query_all_by(|node| node.is_focused()).next().unwrap().rect();
        let is_frame = |shape: &egui::Shape| match shape {
            egui::Shape::Rect(frame) => {
                frame.stroke.width >= 2.0
                    && frame.rect.expand(1.0).contains_rect(own)
                    && frame.rect.width() < own.width() + 8.0
            }
            _ => false,
        };
        let shapes = &table.harness.output().shapes;
        let is_framed = shapes.iter().any(|clipped| is_frame(&clipped.shape));
        assert!(is_framed, "{:?} at {own}", table.focused());
    }
}

#[test]
fn a_control_that_gets_the_keyboard_is_scrolled_into_view() {
    let mut table = Table::with_kick();
    for section in ["Sheet", "Exaggeration", "Turns of joints", "Actions"] {
        table.walk_to(section);
        table.strike(Key::Space);
    }
    table.walk_to("omission.keep_length");
    // Scrolling takes a few frames.
    (0..8).for_each(|_| table.harness.step());
    let own = table.harness.get_by_role_and_label(Role::CheckBox, "omission.keep_length").rect();
    assert!(table.harness.ctx.content_rect().contains_rect(own), "{own}");
}

#[test]
fn a_clip_is_opened_by_its_name_and_a_bad_name_is_closed_again() {
    let mut table = Table::empty(Arc::default(), Language::English, Theme::Light);
    table.tap(Modifiers::COMMAND, Key::O);
    assert_eq!(table.focused().as_deref(), Some("File"));
    let path = sample("swing.bvh").display().to_string();
    table.harness.event(Event::Text(path));
    table.enter();
    assert_eq!(table.harness.state().title(), "swing – genga");
    table.tap(Modifiers::COMMAND, Key::O);
    table.harness.event(Event::Text("/no/such.bvh".into()));
    table.enter();
    table.part("Close the message");
    table.strike(Key::Space);
    assert!(!table.is_there("Close the message"));
}

#[test]
fn a_view_is_turned_and_moved() {
    let mut table = Table::with_kick();
    table.part("Source");
    let koma = table.koma_now();
    let mut seen = vec![table.drawing()];
    for modifiers in [Modifiers::NONE, Modifiers::SHIFT] {
        for key in [Key::ArrowRight, Key::ArrowDown] {
            table.tap(modifiers, key);
            assert_eq!(table.focused().as_deref(), Some("Source"), "the keyboard stays");
            let now = table.drawing();
            assert!(!seen.contains(&now), "{modifiers:?} {key:?}");
            seen.push(now);
        }
    }
    assert_eq!(table.koma_now(), koma, "the play head stays");
    table.strike(Key::Escape);
    table.strike(Key::ArrowRight);
    assert_eq!(table.koma_now(), koma + 1);
}

#[test]
fn play_head_and_sheet_leave_the_arrows_to_the_koma() {
    let mut table = Table::with_kick();
    for (at, name) in ["Play head", "Timesheet"].into_iter().enumerate() {
        table.part(name);
        table.strike(Key::ArrowRight);
        assert_eq!(table.koma_now(), at + 2);
        assert_eq!(table.focused().as_deref(), Some(name));
    }
    table.strike(Key::Space);
    table.harness.step();
    assert!(table.is_there("Stop"));
}

#[test]
fn curves_are_zoomed_and_moved() {
    let mut table = Table::with_kick();
    table.part("Speed curves");
    let before = table.drawing();
    table.strike(Key::ArrowUp);
    let near = table.drawing();
    table.strike(Key::ArrowRight);
    let moved = table.drawing();
    assert!(before != near && near != moved);
    table.strike(Key::ArrowLeft);
    table.strike(Key::ArrowDown);
    assert_eq!(table.drawing(), before, "all of it again");
    assert_eq!(table.koma_now(), 1);
}

#[test]
fn the_map_turns_both_knobs() {
    let mut table = Table::with_kick();
    table.strike(Key::H);
    table.harness.run_steps(4);
    table.rest();
    table.walk_to("Map of the smoothing");
    table.strike(Key::ArrowRight);
    assert_eq!(table.recipe().get("filter.width").unwrap(), "0.2s");
    table.strike(Key::ArrowUp);
    assert_eq!(table.recipe().get("turns.persistence").unwrap(), "0.125s");
    table.strike(Key::ArrowLeft);
    assert_eq!(table.recipe().get("filter.width").unwrap(), "0.15s");
}

#[test]
fn knobs_are_turned_chosen_and_switched() {
    let mut table = Table::with_kick();
    let get = |table: &Table, knob: &str| table.recipe().get(knob).unwrap();
    table.part("TV action");
    table.strike(Key::Tab);
    table.strike(Key::Space);
    assert_eq!(get(&table, "spacing.on"), "3", "a preset");
    let before = table.recipe().spacing.weight;
    table.walk_to("spacing.weight");
    table.strike(Key::ArrowRight);
    assert!(table.recipe().spacing.weight > before, "a slider");
    table.walk_to("omission.keep_length");
    table.strike(Key::Space);
    assert_eq!(get(&table, "omission.keep_length"), "false", "a box");
    table.walk_to("keys.contacts");
    table.strike(Key::Enter);
    table.walk_to("keys");
    table.strike(Key::Enter);
    assert_eq!(get(&table, "keys.contacts"), "keys", "a list");
    table.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!(get(&table, "keys.contacts"), "off");
}

#[test]
fn an_export_is_ordered_written_and_stopped() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("kick.bvh");
    std::fs::copy(sample("kick.bvh"), &clip).unwrap();
    let mut table = Table::with(&clip, Arc::default(), Language::English, Theme::Light);
    table.tap(Modifiers::COMMAND, Key::E);
    assert_eq!(table.focused().as_deref(), Some("Clip Studio"), "where does it go?");
    table.walk_to("All formats");
    table.strike(Key::Space);
    table.walk_to("xdts");
    table.strike(Key::Enter);
    assert!(table.is_there("Write the files"), "it switches the format and writes nothing");
    let hold = Arc::clone(&table.desk);
    let writing = hold.is_writing.lock().unwrap();
    table.walk_to("Write the files");
    table.harness.key_press(Key::Enter);
    (0..3).for_each(|_| table.harness.step());
    for _ in 0..10 {
        table.harness.key_press(Key::F6);
        (0..2).for_each(|_| table.harness.step());
        if table.focused().as_deref() == Some("Stop writing") {
            break;
        }
    }
    table.harness.key_press(Key::Space);
    (0..3).for_each(|_| table.harness.step());
    drop(writing);
    table.rest();
    table.harness.get_by_label_contains("stopped: nothing was written");
    table.strike(Key::Escape);
    table.tap(Modifiers::COMMAND, Key::E);
    assert_eq!(table.focused().as_deref(), Some("Write the files"), "there again");
    let xdts = table.harness.get_by_label("xdts").accesskit_node().toggled();
    assert_eq!(xdts, Some(Toggled::True), "it is remembered");
    table.harness.key_press(Key::Enter);
    (0..3).for_each(|_| table.harness.step());
    table.rest();
    assert!(place.path().join("kick-genga/kick_genga_ts.xdts").is_file());
}

#[test]
fn what_was_left_is_recovered() {
    let desk: Arc<crate::desk::Memory> = Arc::default();
    desk.write_text(&sample("kick.genga-autosave.toml"), "[spacing]\non = 3\n");
    let mut table = Table::with(&sample("kick.bvh"), desk, Language::English, Theme::Light);
    table.part("Recover");
    table.strike(Key::Enter);
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "3");
}

#[test]
fn takes_are_opened_from_their_list() {
    let place = tempfile::tempdir().unwrap();
    for name in ["kick.bvh", "swing.bvh"] {
        std::fs::copy(sample(name), place.path().join(name)).unwrap();
    }
    let mut table = Table::empty(Arc::default(), Language::English, Theme::Light);
    table.tap(Modifiers::COMMAND, Key::O);
    table.harness.event(Event::Text(place.path().display().to_string()));
    table.enter();
    table.part("Previous");
    table.walk_to("swing");
    table.harness.key_press(Key::Space);
    table.harness.step();
    table.wait();
    assert_eq!(table.harness.state().title(), "swing – genga");
}

#[test]
fn a_key_is_named_weighted_held_and_forbidden() {
    let mut table = Table::with_kick();
    table.strike(Key::ArrowDown);
    table.strike(Key::N);
    table.harness.event(Event::Text("hit".into()));
    table.strike(Key::Enter);
    assert_eq!(table.edits().pins[0].name.as_deref(), Some("hit"));
    table.walk_to("Own spacing weight");
    table.strike(Key::Space);
    assert!(table.edits().pins[0].weight.is_some());
    table.walk_to("Remove: pinned");
    table.strike(Key::Space);
    assert!(table.edits().is_empty());
    table.walk_to("Forbid");
    table.strike(Key::Enter);
    assert_eq!(table.edits().forbidden.len(), 1);
}

#[test]
fn panels_are_put_away_and_back_and_joints_chosen() {
    let mut table = Table::with_kick();
    for (key, name) in
        [(Key::Num7, "filter.width"), (Key::Num8, "Speed curves"), (Key::Num9, "Timesheet")]
    {
        let is_there = |table: &Table| table.harness.query_all_by_label(name).next().is_some();
        table.strike(key);
        assert!(!is_there(&table), "{name}");
        table.strike(key);
        assert!(is_there(&table), "{name}");
    }
    table.walk_to("RightLeg");
    table.strike(Key::Space);
    let chosen = table.harness.get_by_role_and_label(Role::CheckBox, "RightLeg");
    assert_eq!(chosen.accesskit_node().toggled(), Some(Toggled::True));
}

#[test]
fn the_list_of_keys_is_opened_and_closed_by_one_key() {
    let mut table = Table::with_kick();
    table.strike(Key::F1);
    table.harness.get_by_label("flip source and result");
    table.strike(Key::F1);
    assert!(!table.is_there("flip source and result"));
}
