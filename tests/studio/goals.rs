//! The three goals and the presets, and that their results are the program's own.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Theme, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use genga::recipe::Recipe;
use genga_studio::Language;

use crate::harness::{Table, sample};

const GOALS: [&str; 3] = ["How many genga", "Drawings a second", "How snappy"];

impl Table {
    /// Drags a goal's slider to a share of its length.
    fn slide(&mut self, goal: &str, share: f32) {
        let rect = self.harness.get_by_role_and_label(Role::Slider, goal).rect();
        let margin = 0.5 * rect.height();
        let to = rect.left_center() + vec2(margin + share * (rect.width() - 2.0 * margin), 0.0);
        self.drag(rect.center(), to);
    }

    pub(crate) fn says(&self, text: &str) -> bool {
        self.harness.query_all_by_label_contains(text).next().is_some()
    }

    fn count(&self) -> usize {
        let node = self.harness.get_by_role_and_label(Role::Slider, GOALS[0]);
        node.accesskit_node().numeric_value().unwrap() as usize
    }
}

/// What the program writes for a clip with these arguments: the bytes of `sheet.json`.
fn sheet(clip: &Path, folder: &Path, arguments: &[&str]) -> Vec<u8> {
    let out = folder.display().to_string();
    let program = Command::new(env!("CARGO_BIN_EXE_genga"))
        .args(["--quiet", "run"])
        .arg(clip)
        .args(["--out", &out])
        .args(arguments)
        .output()
        .unwrap();
    assert!(program.status.success(), "{}", String::from_utf8_lossy(&program.stderr));
    std::fs::read(folder.join("sheet.json")).unwrap()
}

#[test]
fn the_result_of_each_goal_is_the_programs_with_the_same_recipe() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("kick.bvh");
    std::fs::copy(sample("kick.bvh"), &clip).unwrap();
    for (at, (goal, share)) in GOALS
        .into_iter()
        .flat_map(|goal| [0.0, 0.2, 0.75, 1.0].map(|share| (goal, share)))
        .enumerate()
    {
        let mut table = Table::plain(&clip, Arc::default(), Language::English, Theme::Light);
        table.slide(goal, share);
        assert_ne!(*table.recipe(), Recipe::default(), "{goal} {share}");
        table.tap(Modifiers::COMMAND, Key::E);
        table.harness.get_by_label("Write the files").click();
        (0..3).for_each(|_| table.harness.step());
        table.rest();
        let own = place.path().join("kick-genga");
        let written = std::fs::read(own.join("sheet.json")).unwrap();
        let recipe = place.path().join("recipe.toml");
        std::fs::write(&recipe, table.harness.state().document().unwrap().text()).unwrap();
        let folder = place.path().join(format!("program-{at}"));
        let recipe = recipe.display().to_string();
        let program = sheet(&clip, &folder, &["--recipe", &recipe]);
        assert!(written == program, "{goal} at {share}");
        std::fs::remove_dir_all(own).unwrap();
    }
}

#[test]
fn a_number_of_genga_is_that_of_the_program() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("kick.bvh");
    std::fs::copy(sample("kick.bvh"), &clip).unwrap();
    let mut table = Table::plain(&clip, Arc::default(), Language::English, Theme::Light);
    let before = table.count();
    table.slide(GOALS[0], 0.35);
    let asked = table.count();
    assert!(asked < before, "{asked}");
    assert!(table.says(&format!("{before} to {asked}")), "the effect stands beside it");
    let recipe = place.path().join("recipe.toml");
    std::fs::write(&recipe, table.harness.state().document().unwrap().text()).unwrap();
    let recipe = recipe.display().to_string();
    let own = sheet(&clip, &place.path().join("own"), &["--recipe", &recipe]);
    let keys = sheet(&clip, &place.path().join("keys"), &["--keys", &asked.to_string()]);
    assert!(own == keys, "{asked} genga");
    table.tap(Modifiers::COMMAND, Key::Z);
    assert_eq!(*table.recipe(), Recipe::default(), "the whole drag was one step");
    assert_eq!(table.count(), before);
}

#[test]
fn a_goal_is_turned_by_the_keyboard_stop_by_stop() {
    let mut table = Table::plain_kick();
    table.harness.get_by_role_and_label(Role::Slider, GOALS[1]).focus();
    table.harness.run();
    for on in ["2", "1-2", "1"] {
        table.tap(Modifiers::NONE, Key::ArrowRight);
        assert_eq!(table.recipe().get("spacing.on").unwrap(), on);
    }
    assert!(table.says("on ones"));
    table.harness.get_by_role_and_label(Role::Slider, GOALS[0]).focus();
    table.harness.run();
    let before = table.count();
    table.tap(Modifiers::NONE, Key::ArrowRight);
    assert_eq!(table.count(), before + 1);
}

#[test]
fn of_a_sheet_in_layers_no_number_of_genga_is_asked() {
    let mut table = Table::plain_kick();
    table.turn("layers", "limbs");
    let node = table.harness.get_by_role_and_label(Role::Slider, GOALS[0]);
    assert!(node.accesskit_node().is_disabled());
    table.slide(GOALS[2], 1.0);
    assert_eq!(table.recipe().get("spacing.weight").unwrap(), "0.7");
}

#[test]
fn presets_are_points_between_which_goals_go() {
    let mut table = Table::plain_kick();
    for preset in ["TV action", "TV acting", "Walk and run", "Full"] {
        table.harness.get_by_label(preset).click();
        table.harness.run();
        assert!(!table.says("your own"), "{preset} is at a stop of each goal");
    }
    assert!(table.says("on ones"));
    table.turn("spacing.weight", "0.2");
    assert!(table.says("your own"));
    table.harness.get_by_label("Defaults").click();
    table.harness.run();
    assert_eq!(*table.recipe(), Recipe::default());
    assert!(table.says("twos and threes"));
}

#[test]
fn the_other_settings_are_expert_with_the_first_sentence_of_their_help() {
    let mut table = Table::plain_kick();
    let sentence =
        "Koma per drawing: 1 is on ones, 2 on twos, 3 on threes, where genga leave room.";
    assert!(!table.says(sentence));
    table.harness.get_by_label("Expert").click();
    table.harness.run();
    assert!(table.says(sentence));
    table.harness.get_by_role_and_label(Role::ComboBox, "spacing.on");
}
