//! Numbers that stay: what was exported once keeps its numbers on screen and in the files.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use egui::{Key, Modifiers, Theme};
use egui_kittest::kittest::Queryable;
use genga_files::sheet_json;
use genga_studio::Language;

use crate::harness::{Table, sample};

fn open(clip: &Path) -> Table {
    Table::plain(clip, Arc::default(), Language::English, Theme::Light)
}

/// Numbers of the genga on the sheet in a folder.
fn numbers(folder: &Path) -> Vec<String> {
    let file = fs::read(folder.join("sheet.json")).unwrap();
    let sheet = sheet_json::read(&file).unwrap().sheet;
    let numbers = sheet.layers[0].genga_numbers();
    numbers.iter().flatten().map(ToString::to_string).collect()
}

/// The numbers as the strip says them, genga by genga.
fn said(table: &mut Table, count: usize) -> Vec<String> {
    table.tap(Modifiers::NONE, Key::Home);
    let mut said = Vec::new();
    for _ in 0..count {
        let says = table.strip_says();
        let number = says.strip_prefix("genga ").unwrap().split(',').next().unwrap();
        said.push(number.to_owned());
        table.tap(Modifiers::NONE, Key::ArrowDown);
    }
    said
}

#[test]
fn a_genga_that_comes_later_has_a_letter_on_screen_as_in_the_files_and_others_stay() {
    let place = tempfile::tempdir().unwrap();
    let (clip, folder) = (place.path().join("kick.bvh"), place.path().join("kick-genga"));
    fs::copy(sample("kick.bvh"), &clip).unwrap();
    let mut table = open(&clip);
    table.export();
    let first = numbers(&folder);
    assert_eq!(first[..3], ["1", "2", "3"]);

    table.go(43);
    table.tap(Modifiers::NONE, Key::K);
    assert_eq!(table.edits().pins.len(), 1);
    let says = table.strip_says();
    let number = says.strip_prefix("genga ").unwrap().split(',').next().unwrap().to_owned();
    assert!(number.ends_with('a'), "{says}");
    table.harness.get_by_label(&format!("Genga {number}"));
    table.harness.get_by_label(&format!("genga {number}"));
    table.export();
    let second = numbers(&folder);
    assert!(second.contains(&number) && second.contains(&first[first.len() - 1]), "{second:?}");
    assert_eq!(said(&mut table, second.len()), second);

    let mut again = open(&clip);
    assert_eq!(again.edits().pins.len(), 0, "the pin was not saved");
    assert_eq!(said(&mut again, first.len()), first, "the number of the pin is free");
}
