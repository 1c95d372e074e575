//! A take with unsaved work is not left without a word: another clip is opened or the window closed only when it is
//! answered what happens to it, and nothing is lost either way.

use std::path::Path;
use std::sync::Arc;

use egui::{Key, Modifiers, Theme, ViewportEvent, ViewportId};
use egui_kittest::kittest::Queryable;
use genga_studio::Language;

use crate::desk::Memory;
use crate::harness::{Table, sample};

impl Table {
    fn pin_something(&mut self) {
        self.tap(Modifiers::NONE, Key::ArrowDown);
        self.tap(Modifiers::NONE, Key::L);
        assert_eq!(self.edits().pins.len(), 1);
    }

    fn answer(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        (0..3).for_each(|_| self.harness.step());
    }

    /// Asks the window to close, as its cross does.
    fn close(&mut self) -> Vec<egui::ViewportCommand> {
        let root = self.harness.input_mut().viewports.entry(ViewportId::ROOT).or_default();
        root.events.push(ViewportEvent::Close);
        self.harness.step();
        let output = self.harness.output();
        let root = output.viewport_output.get(&ViewportId::ROOT);
        root.map(|root| root.commands.clone()).unwrap_or_default()
    }
}

fn open(table: &mut Table, clip: &Path) {
    table.harness.state_mut().open_any(clip);
    table.harness.run();
}

#[test]
fn another_clip_waits_until_the_work_is_saved_or_kept() {
    let saved = sample("kick.genga.toml");
    let kept = sample("kick.genga-autosave.toml");
    for (answer, is_saved) in
        [("Save, then open", true), ("Open, and offer them again later", false)]
    {
        let desk: Arc<Memory> = Arc::default();
        let clip = sample("kick.bvh");
        let mut table = Table::plain(&clip, Arc::clone(&desk), Language::English, Theme::Light);
        table.pin_something();
        open(&mut table, &sample("swing.bvh"));
        assert_eq!(table.harness.state().title(), "kick * – genga", "it asks first");
        table.answer("Stay here");
        assert!(table.harness.query_by_label(answer).is_none());
        open(&mut table, &sample("swing.bvh"));
        table.answer(answer);
        table.wait();
        assert_eq!(table.harness.state().title(), "swing – genga");
        assert_eq!(desk.text(&saved).is_some(), is_saved);
        assert_eq!(desk.text(&kept).is_some(), !is_saved);
        open(&mut table, &clip);
        table.wait();
        assert_eq!(table.harness.query_by_label("Recover").is_some(), !is_saved);
    }
}

#[test]
fn without_unsaved_work_nothing_is_asked() {
    let mut table = Table::plain_kick();
    open(&mut table, &sample("swing.bvh"));
    table.wait();
    assert_eq!(table.harness.state().title(), "swing – genga");
    assert!(!table.close().contains(&egui::ViewportCommand::CancelClose));
}

#[test]
fn the_window_stays_until_the_work_is_saved_or_kept() {
    let mut table = Table::plain_kick();
    table.pin_something();
    assert!(table.close().contains(&egui::ViewportCommand::CancelClose));
    table.harness.step();
    table.answer("Save, then close");
    assert!(table.desk.text(&sample("kick.genga.toml")).is_some());
    assert!(!table.close().contains(&egui::ViewportCommand::CancelClose));
}

#[test]
fn the_offer_to_recover_is_no_error() {
    let desk: Arc<Memory> = Arc::default();
    desk.write_text(&sample("kick.genga-autosave.toml"), "[spacing]\non = 3\n");
    let table = Table::plain(&sample("kick.bvh"), desk, Language::English, Theme::Light);
    let offer = table.harness.get_by_label("Recover").rect();
    let red = |color: egui::Color32| i32::from(color.r()) > 60 + i32::from(color.g());
    let shapes = table.harness.output().shapes.iter().map(|clipped| &clipped.shape);
    // The frame of a notice comes with its shadow.
    let alone = shapes.flat_map(|shape| match shape {
        egui::Shape::Vec(shapes) => shapes.iter().collect(),
        one => vec![one],
    });
    let framed = alone.filter_map(|shape| match shape {
        egui::Shape::Rect(frame) if frame.rect.contains_rect(offer) => Some(frame.stroke),
        _ => None,
    });
    let strokes: Vec<_> = framed.filter(|stroke| stroke.width > 1.0).collect();
    assert!(!strokes.is_empty() && !strokes.iter().any(|stroke| red(stroke.color)), "{strokes:?}");
}
