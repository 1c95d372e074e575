//! Playing, stepping, looping, flipping, and looking from a side.

use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::harness::Table;

impl Table {
    /// The koma at the play head, from 1, as the screen reader gets it.
    fn koma(&self) -> usize {
        let head = self.harness.get_by_label("Play head");
        let text = head.accesskit_node().value().unwrap();
        text.split(' ').next().unwrap().parse().unwrap()
    }

    fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.harness.step();
        self.harness.step();
    }

    fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.harness.run();
    }
}

#[test]
fn arrows_step_by_koma_drawing_and_genga() {
    let mut table = Table::with_kick();
    assert_eq!(table.koma(), 1);
    table.press(Key::ArrowRight);
    assert_eq!(table.koma(), 2);
    table.press(Key::End);
    assert_eq!(table.koma(), 92);
    table.press(Key::ArrowRight);
    assert_eq!(table.koma(), 92, "there is no more");
    table.press(Key::Home);
    table.press(Key::ArrowDown);
    let genga = table.koma();
    assert!(table.harness.query_by_label_contains("End of the clip").is_none());
    table.press_with(Modifiers::SHIFT, Key::ArrowLeft);
    assert!(table.koma() < genga, "a drawing before it");
}

#[test]
fn keys_that_come_in_one_frame_are_taken_in_their_order() {
    let mut table = Table::with_kick();
    table.press(Key::End);
    for key in [Key::Home, Key::ArrowRight, Key::ArrowRight] {
        table.harness.input_mut().events.push(egui::Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        });
    }
    table.harness.run();
    assert_eq!(table.koma(), 3);
}

#[test]
fn a_slider_with_the_focus_leaves_the_letters_to_the_studio() {
    let mut table = Table::with_kick();
    let role = egui::accesskit::Role::Slider;
    table.harness.get_by_role_and_label(role, "spacing.weight").focus();
    table.harness.run();
    table.press(Key::F1);
    table.harness.get_by_label("flip source and result");
}

#[test]
fn it_plays_in_time_and_stops() {
    let mut table = Table::with_kick();
    table.press(Key::Space);
    let from = table.koma();
    // A step of the harness is a quarter of a second.
    table.harness.step();
    assert_eq!(table.koma(), from + 6);
    table.harness.get_by_label("Stop").click();
    table.harness.run();
    let at = table.koma();
    table.harness.run_steps(3);
    assert_eq!(table.koma(), at);
}

#[test]
fn a_part_is_played_again_and_again() {
    let mut table = Table::with_kick();
    (0..4).for_each(|_| table.press(Key::ArrowRight));
    table.press(Key::I);
    (0..3).for_each(|_| table.press(Key::ArrowRight));
    table.press(Key::O);
    table.press(Key::Space);
    for _ in 0..5 {
        table.harness.step();
        assert!((5..=8).contains(&table.koma()), "{}", table.koma());
    }
    table.press(Key::Space);
    table.harness.get_by_label("Play all").click();
    table.harness.run();
    assert!(table.harness.query_by_label("Play all").is_none());
}

#[test]
fn one_key_flips_between_source_and_result() {
    let mut table = Table::with_kick();
    let seen = |table: &Table| {
        let canvas = |name: &str| {
            let role = egui::accesskit::Role::Canvas;
            table.harness.query_by_role_and_label(role, name).is_some()
        };
        (canvas("Source"), canvas("Result"))
    };
    assert_eq!(seen(&table), (true, true));
    table.press(Key::F);
    assert_eq!(seen(&table), (false, true));
    table.press(Key::F);
    assert_eq!(seen(&table), (true, false));
    table.press(Key::B);
    assert_eq!(seen(&table), (true, true));
}

#[test]
fn the_scrub_bar_goes_where_the_hand_does() {
    let mut table = Table::with_kick();
    let bar = table.harness.get_by_label("Play head").rect();
    let place = bar.left_center() + egui::vec2(0.5 * bar.width(), 0.0);
    table.harness.drag_at(place);
    table.harness.run();
    assert!((44..=48).contains(&table.koma()), "{}", table.koma());
    table.harness.drop_at(place);
    table.harness.run();
}

#[test]
fn the_list_of_keys_opens_and_closes() {
    let mut table = Table::with_kick();
    table.press(Key::F1);
    table.harness.get_by_label("flip source and result");
    table.press(Key::Escape);
    assert!(table.harness.query_by_label("flip source and result").is_none());
}

#[test]
fn the_movement_lane_is_a_checkbox_and_a_key() {
    let mut table = Table::with_kick();
    let is_on = |table: &Table| {
        let box_of = table.harness.get_by_label("Movement (SSD)");
        box_of.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
    };
    assert!(is_on(&table));
    table.press(Key::M);
    assert!(!is_on(&table));
    table.harness.get_by_label("Movement (SSD)").click();
    table.harness.run();
    assert!(is_on(&table));
}
