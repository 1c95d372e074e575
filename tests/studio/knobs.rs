//! Knobs and presets, undone and redone.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use genga::recipe::{KNOBS, Kind};

use crate::harness::Table;

#[test]
fn a_slider_sets_its_knob_and_a_drag_is_one_step() {
    let mut table = Table::with_kick();
    // So that the slider is in view.
    table.harness.get_by_label("Genga").click();
    table.harness.run_steps(8);
    let before = table.recipe().clone();
    let slider =
        table.harness.get_by_role_and_label(egui::accesskit::Role::Slider, "spacing.weight").rect();
    table.harness.drag_at(slider.left_center() + egui::vec2(30.0, 0.0));
    for step in 4..8 {
        table.harness.hover_at(slider.left_center() + egui::vec2(10.0 * step as f32, 0.0));
        table.harness.run();
    }
    table.harness.drop_at(slider.left_center() + egui::vec2(70.0, 0.0));
    table.harness.run();
    assert!(
        table.recipe().spacing.weight > before.spacing.weight,
        "{}",
        table.recipe().spacing.weight
    );
    table.harness.get_by_label("Undo").click();
    table.harness.run();
    assert_eq!(*table.recipe(), before, "the whole drag was one step");
    table.harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    table.harness.run();
    assert!(table.recipe().spacing.weight > before.spacing.weight);
}

#[test]
fn every_knob_has_a_control_of_its_name() {
    let mut table = Table::with_kick();
    for section in ["Sheet", "Exaggeration", "Turns of joints", "Actions", "For studies"] {
        // By now the last header lies below the window's edge.
        table.harness.get_by_label(section).click_accesskit();
        table.harness.run();
    }
    for knob in KNOBS {
        let is_unset = knob.name == "spacing.inbetweens";
        let controls = table.harness.query_all_by_label(knob.name).count();
        let expected = match knob.kind {
            _ if is_unset => 1..=1,
            Kind::Choice(_) | Kind::On | Kind::SeenFrom | Kind::Flag => 1..=1,
            _ => 1..=2,
        };
        assert!(expected.contains(&controls), "{}: {controls} controls", knob.name);
    }
}

#[test]
fn a_preset_turns_its_knobs_and_the_defaults_take_it_back() {
    let mut table = Table::with_kick();
    let before = table.recipe().clone();
    table.harness.get_by_label("TV acting").click();
    table.harness.run();
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "3");
    table.harness.get_by_label("Defaults").click();
    table.harness.run();
    assert_eq!(*table.recipe(), before);
}

#[test]
fn a_knob_goes_back_to_its_default_alone() {
    let mut table = Table::with_kick();
    for (knob, value) in [("spacing.weight", "0.5"), ("spacing.on", "3")] {
        table.turn(knob, value);
    }
    table.harness.get_by_label_contains("Reset to default: spacing.weight").click_accesskit();
    table.harness.run();
    let default = genga::recipe::Recipe::default();
    assert_eq!(table.recipe().spacing.weight, default.spacing.weight);
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "3");
}

#[test]
fn a_length_of_time_takes_frames_or_seconds() {
    let mut table = Table::with_kick();
    assert!(table.recipe().get("filter.width").unwrap().ends_with('s'));
    table.harness.get_by_label("unit of filter.width").click();
    table.harness.run();
    assert!(!table.recipe().get("filter.width").unwrap().ends_with('s'));
}

#[test]
fn a_hand_on_the_map_turns_both_knobs_in_one_step_and_the_map_is_the_same() {
    let mut table = Table::with_kick();
    let before = table.recipe().clone();
    table.harness.key_press(Key::H);
    table.harness.run_steps(8);
    table.rest();
    let canvas = |table: &Table| {
        let role = egui::accesskit::Role::Canvas;
        table.harness.get_by_role_and_label(role, "Map of the smoothing").rect()
    };
    let map = canvas(&table);
    // The cells begin 40 points from the left and end 30 points from the bottom.
    let cell = |x: f32, y: f32| {
        let (wide, high) = ((map.width() - 46.0) / 10.0, (map.height() - 34.0) / 10.0);
        map.left_bottom() + egui::vec2(40.0 + (x + 0.5) * wide, -30.0 - (y + 0.5) * high)
    };
    table.harness.drag_at(cell(3.0, 1.0));
    table.rest();
    table.harness.hover_at(cell(5.0, 7.0));
    table.rest();
    assert_eq!(table.recipe().get("filter.width").unwrap(), "0.3s", "while it is dragged");
    table.harness.drop_at(cell(5.0, 7.0));
    table.harness.run();
    let own = ["filter.width", "turns.persistence"].map(|knob| table.recipe().get(knob).unwrap());
    assert_eq!(own, ["0.3s", "0.2s"]);
    assert!(!table.harness.state().is_mapping(), "the map is the same");
    table.harness.get_by_label("Undo").click();
    table.harness.run();
    assert_eq!(*table.recipe(), before, "the whole drag was one step");
    table.harness.state_mut().turn("filter.kind", "gaussian").unwrap();
    table.harness.step();
    assert!(table.harness.state().is_mapping(), "another filter has another map");
    table.rest();
}
