//! Rounds of a loop, and marked ranges as passages with goals of their own.

use std::path::Path;
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Theme};
use egui_kittest::kittest::{NodeT, Queryable};
use genga_studio::Language;

use crate::harness::{Table, sample};

impl Table {
    /// Marks the koma `from` to `to`, counted from 1, as the played range.
    fn mark(&mut self, from: usize, to: usize) {
        self.go(from);
        self.tap(Modifiers::NONE, Key::I);
        self.go(to);
        self.tap(Modifiers::NONE, Key::O);
    }

    fn length(&self) -> usize {
        let head = self.harness.get_by_role_and_label(Role::Slider, "Play head");
        let text = head.accesskit_node().value().unwrap();
        text.rsplit(' ').next().unwrap().parse().unwrap()
    }
}

#[test]
fn a_marked_range_becomes_a_passage_with_goals_of_its_own() {
    let mut table = Table::plain_kick();
    table.tap(Modifiers::NONE, Key::Q);
    assert!(table.recipe().scopes.passages.is_empty(), "nothing is marked yet");
    table.mark(25, 48);
    table.harness.get_by_label("Passage").click();
    table.harness.run();
    let passages = &table.recipe().scopes.passages;
    assert_eq!(passages.iter().map(|own| own.frames.to_string()).collect::<Vec<_>>(), ["24..48"]);
    table.harness.get_by_role_and_label(Role::Slider, "Drawings a second").focus();
    table.harness.run();
    for _ in 0..3 {
        table.tap(Modifiers::NONE, Key::ArrowRight);
    }
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "2-3", "the rest is as it was");
    let own: Vec<(&str, &str)> = table.recipe().scopes.passages[0].settings.iter().collect();
    assert!(own.contains(&("spacing.on", "1")), "{own:?}");
    table.harness.get_by_label_contains("Remove: passage 24..48").click();
    table.harness.run();
    assert!(table.recipe().scopes.passages.is_empty());
}

/// Writes a kick that goes back the way it came, so that its last pose is its first.
fn to_and_fro(clip: &Path) -> usize {
    let text = std::fs::read_to_string(sample("kick.bvh")).unwrap();
    let (head, motion) = text.split_once("MOTION").unwrap();
    let lines: Vec<&str> = motion.trim().lines().collect();
    let rows = &lines[2..];
    let back = rows.iter().rev().skip(1);
    let all: Vec<&str> = rows.iter().chain(back).copied().collect();
    let count = all.len();
    let text = format!("{head}MOTION\nFrames: {count}\n{}\n{}\n", lines[1], all.join("\n"));
    std::fs::write(clip, text).unwrap();
    count
}

#[test]
fn every_round_of_a_loop_is_played_and_its_source_begins_again() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("round.bvh");
    let frames = to_and_fro(&clip);
    let mut table = Table::plain(&clip, Arc::default(), Language::English, Theme::Light);
    table.turn("loop", "true");
    let round = table.length();
    assert!((frames - 2..=frames).contains(&round), "{round}");
    table.turn("cycles", "3");
    assert_eq!(table.length(), 3 * round);
    let drawing = |table: &Table| {
        let mut points = Vec::new();
        let view = table.canvas("Source");
        for clipped in &table.harness.output().shapes {
            if let egui::Shape::Path(path) = &clipped.shape {
                points.extend(path.points.iter().filter(|point| view.contains(**point)).copied());
            }
        }
        points
    };
    // Without trails, which reach into the rounds before and after.
    table.tap(Modifiers::NONE, Key::T);
    table.go(10);
    let first = drawing(&table);
    table.go(10 + round);
    let second = drawing(&table);
    assert_eq!(first, second, "the same pose of the source");
    table.go(11 + round);
    assert_ne!(drawing(&table), first);
}
