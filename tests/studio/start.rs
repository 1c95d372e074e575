//! The start: a built-in clip and a tour through six steps.

use std::sync::Arc;

use egui::{Key, Modifiers, Theme};
use egui_kittest::kittest::Queryable;
use genga_studio::Language;

use crate::harness::Table;

#[test]
fn a_file_that_is_no_motion_is_refused_with_every_format_in_both_languages() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("scene.blend");
    std::fs::write(&path, "BLENDER-v300").unwrap();
    for (language, words) in [
        (Language::English, ["a scene of Blender", "ASF/AMC"]),
        (Language::Japanese, ["開けるのは", "MikuMikuDance の VMD"]),
    ] {
        let mut table = Table::empty(Arc::default(), language, Theme::Light);
        table.open(&path);
        for word in words {
            table.harness.query_all_by_label_contains(word).next().expect(word);
        }
    }
}

#[test]
fn one_button_opens_a_kick_and_the_tour_goes_from_there_to_the_export() {
    let mut table = Table::empty(Arc::default(), Language::English, Theme::Light);
    table.harness.run();
    table.harness.get_by_label("Try it with a kick").click();
    (0..3).for_each(|_| table.harness.step());
    table.wait();
    assert_eq!(table.harness.state().title(), "kick – genga");
    table.harness.get_by_label("1/6");
    assert!(table.harness.query_by_label("Done.").is_none());
    for _ in 0..2 {
        table.harness.key_press(Key::Space);
        table.harness.step();
    }
    table.harness.run();
    table.harness.get_by_label("Done.");
    for step in 2..=6 {
        table.harness.get_by_label("Next").click();
        table.harness.run();
        table.harness.get_by_label(&format!("{step}/6"));
        assert!(table.harness.query_by_label("Done.").is_none(), "of step {step}");
    }
    table.harness.get_by_label("Finish").click();
    table.harness.run();
    assert!(table.harness.query_by_label("6/6").is_none());
    table.tap(Modifiers::NONE, Key::F1);
    table.harness.get_by_label("Tour of six steps").click();
    table.harness.run();
    table.harness.get_by_label("1/6");
    table.harness.get_by_label("End the tour").click();
    table.harness.run();
    assert!(table.harness.query_by_label("1/6").is_none());
}
