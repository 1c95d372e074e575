//! Saving, opening, recovering and exporting.

use std::path::Path;
use std::sync::Arc;

use egui::{Key, Modifiers, Theme};
use egui_kittest::kittest::Queryable;
use genga::recipe::Recipe;
use genga_studio::Language;

use crate::desk::Memory;
use crate::harness::{Table, sample};

/// A file dropped on the window.
#[derive(Debug)]
struct Dropped(std::path::PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

impl Table {
    fn drop_file(&mut self, path: &Path) {
        let dropped = Arc::new(Dropped(path.to_owned()));
        self.harness.input_mut().dropped_files.push(dropped);
        self.wait();
    }

    /// Exports with the last order.
    pub(crate) fn export(&mut self) {
        self.tap(Modifiers::COMMAND, Key::E);
        self.harness.get_by_label("Write the files").click();
        (0..3).for_each(|_| self.harness.step());
        self.rest();
    }

    fn pin_contact(&mut self) {
        self.harness.key_press(Key::Home);
        (0..42).for_each(|_| self.harness.key_press(Key::ArrowRight));
        self.harness.key_press(Key::K);
        self.harness.run();
        assert_eq!(self.edits().pins.len(), 1);
    }
}

fn save(table: &mut Table) {
    table.harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    table.harness.run();
}

#[test]
fn a_save_is_a_recipe_that_the_command_line_reads_and_the_next_session_opens() {
    let mut table = Table::with_kick();
    table.pin_contact();
    table.turn("spacing.on", "3");
    assert_eq!(table.harness.state().title(), "kick * – genga");
    save(&mut table);
    assert_eq!(table.harness.state().title(), "kick – genga");
    let saved = table.desk.text(&sample("kick.genga.toml")).unwrap();
    let (recipe, edits) = Recipe::parse(&saved).unwrap();
    assert_eq!((&recipe, &edits), (table.recipe(), table.edits()));
    let again =
        Table::with(&sample("kick.bvh"), Arc::clone(&table.desk), Language::English, Theme::Light);
    assert_eq!((again.recipe(), again.edits()), (&recipe, &edits));
}

#[test]
fn what_was_not_saved_is_kept_and_offered_again() {
    let autosave = sample("kick.genga-autosave.toml");
    let mut table = Table::with_kick();
    assert_eq!(table.desk.text(&autosave), None);
    table.pin_contact();
    assert!(table.desk.text(&autosave).unwrap().contains("frame = 42"));
    let desk = Arc::clone(&table.desk);
    drop(table);
    let mut again =
        Table::with(&sample("kick.bvh"), Arc::clone(&desk), Language::English, Theme::Light);
    assert!(again.edits().is_empty());
    again.harness.get_by_label("Recover").click();
    again.harness.run();
    assert_eq!(again.edits().pins.len(), 1);
    assert!(again.harness.query_by_label("Recover").is_none());
    save(&mut again);
    assert_eq!(desk.text(&autosave), None, "what is saved needs no second copy");
}

#[test]
fn of_two_sheets_both_are_kept_and_offered_again() {
    let other = sample("kick.genga-autosave-other.toml");
    let mut table = Table::with_kick();
    table.tap(Modifiers::NONE, Key::X);
    table.turn("spacing.on", "3");
    table.tap(Modifiers::NONE, Key::X);
    save(&mut table);
    assert!(table.desk.text(&other).unwrap().contains("on = 3"), "B is in no recipe");
    let desk = Arc::clone(&table.desk);
    drop(table);
    let open =
        || Table::with(&sample("kick.bvh"), Arc::clone(&desk), Language::English, Theme::Light);
    let mut again = open();
    again.harness.get_by_label("Recover").click();
    again.harness.run();
    let on = |table: &Table| table.recipe().get("spacing.on").unwrap();
    assert_eq!(on(&again), "2-3", "A is worked on, as before");
    again.tap(Modifiers::NONE, Key::X);
    assert_eq!(on(&again), "3");
    again.harness.get_by_label("B: The other sheet (X)");
    drop(again);
    let mut again = open();
    again.harness.get_by_label("Discard").click();
    again.harness.run();
    assert_eq!(desk.text(&other), None);
}

#[test]
fn what_was_left_can_be_thrown_away() {
    let autosave = sample("kick.genga-autosave.toml");
    let desk: Arc<Memory> = Arc::default();
    desk.files.lock().unwrap().insert(autosave.clone(), "[spacing]\non = 3\n".into());
    let mut table =
        Table::with(&sample("kick.bvh"), Arc::clone(&desk), Language::English, Theme::Light);
    table.harness.get_by_label("Discard").click();
    table.harness.run();
    assert_eq!(desk.text(&autosave), None);
    assert_eq!(*table.recipe(), Recipe::default());
}

#[test]
fn a_full_disk_is_said_and_nothing_is_lost() {
    let mut table = Table::with_kick();
    *table.desk.is_full.lock().unwrap() = true;
    table.pin_contact();
    table.harness.get_by_label_contains("no space left");
    save(&mut table);
    table.harness.get_by_label_contains("kick.genga.toml: no space left");
    assert_eq!(table.harness.state().title(), "kick * – genga", "it is not saved");
    *table.desk.is_full.lock().unwrap() = false;
    save(&mut table);
    assert!(table.desk.text(&sample("kick.genga.toml")).unwrap().contains("frame = 42"));
}

#[test]
fn a_clip_is_opened_by_dropping_it_and_a_bad_one_leaves_the_other() {
    let mut table = Table::empty(Arc::default(), Language::English, Theme::Dark);
    table.drop_file(&sample("swing.bvh"));
    assert_eq!(table.harness.state().title(), "swing – genga");
    let place = tempfile::tempdir().unwrap();
    let bad = place.path().join("bad.bvh");
    std::fs::write(&bad, "HIERARCHY\nROOT").unwrap();
    table.drop_file(&bad);
    table.harness.get_by_label_contains("bad.bvh:2:");
    assert_eq!(table.harness.state().title(), "swing – genga");
}

#[test]
fn a_recipe_is_opened_by_its_name() {
    let mut table = Table::with_kick();
    let path = Path::new("/recipes/threes.toml");
    table.desk.write_text(path, "[spacing]\non = 3\n");
    table.harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
    table.harness.run();
    table.harness.get_by_label("File").type_text("/recipes/threes.toml");
    table.harness.run();
    table.harness.get_by_label("Open it").click();
    table.harness.run();
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "3");
    save(&mut table);
    assert!(table.desk.text(path).unwrap().contains("on = 3"));
}

#[test]
fn an_export_is_what_a_run_writes() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("kick.bvh");
    std::fs::copy(sample("kick.bvh"), &clip).unwrap();
    let mut table = Table::with(&clip, Arc::default(), Language::English, Theme::Light);
    table.harness.get_by_label("Export").click();
    let button = |table: &mut Table| {
        (0..2).for_each(|_| table.harness.step());
        table.harness.get_by_label("Write the files").rect()
    };
    assert_eq!(button(&mut table), button(&mut table), "it is whole as soon as it is there");
    let hold = Arc::clone(&table.desk);
    let writing = hold.is_writing.lock().unwrap();
    table.harness.get_by_label("Write the files").click();
    (0..3).for_each(|_| table.harness.step());
    assert!(table.harness.state().is_exporting(), "it does not wait for the disk");
    drop(writing);
    table.rest();
    let folder = place.path().join("kick-genga");
    for file in ["sheet.json", "keys.csv", "limited.bvh", "recipe.toml", "report.json", "speed.svg"]
    {
        assert!(folder.join(file).is_file(), "{file}");
    }
    // A sheet edited by hand is not overwritten, as in a run.
    let sheet = std::fs::read_to_string(folder.join("sheet.json")).unwrap();
    std::fs::write(folder.join("sheet.json"), sheet.replace("\"koma\": 2", "\"koma\": 3")).unwrap();
    table.export();
    table.harness.get_by_label_contains("is not as a run wrote it");
}

#[test]
fn an_export_is_asked_for_remembered_and_goes_where_it_is_told() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("kick.bvh");
    std::fs::copy(sample("kick.bvh"), &clip).unwrap();
    let mut table = Table::with(&clip, Arc::default(), Language::English, Theme::Light);
    table.tap(Modifiers::COMMAND, Key::E);
    table.harness.get_by_label("All formats").click();
    table.harness.run();
    for format in ["xdts", "xsheet"] {
        table.harness.get_by_label(format).click();
        table.harness.run();
    }
    let out = place.path().join("out/first");
    *table.desk.chosen.lock().unwrap() = Some(out.clone());
    table.harness.get_by_label("Choose the folder…").click();
    for _ in 0..40 {
        table.harness.step();
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    table.harness.get_by_label("Write the files").click();
    table.harness.step();
    table.harness.step();
    table.rest();
    for file in ["sheet.json", "kick_genga_ts.xdts", "xsheet/0001.svg"] {
        assert!(out.join(file).is_file(), "{file}");
    }
    let desk = Arc::clone(&table.desk);
    let mut again = Table::with(&clip, desk, Language::English, Theme::Light);
    again.tap(Modifiers::COMMAND, Key::E);
    let is_on = |table: &Table, format: &str| {
        use egui_kittest::kittest::NodeT;
        let shown = table.harness.get_by_label(format);
        shown.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
    };
    assert!(is_on(&again, "xdts") && is_on(&again, "json") && !is_on(&again, "strip"));
    let folder = again.harness.get_by_label("Folder of the export");
    let folder = egui_kittest::kittest::NodeT::accesskit_node(&folder).value().unwrap();
    assert_eq!(Path::new(&folder), place.path().join("out/kick-genga"));
    again.tap(Modifiers::NONE, Key::Escape);
    assert!(again.harness.query_by_label("Write the files").is_none());
}

#[test]
fn an_export_that_is_stopped_leaves_nothing() {
    let place = tempfile::tempdir().unwrap();
    let clip = place.path().join("kick.bvh");
    std::fs::copy(sample("kick.bvh"), &clip).unwrap();
    let mut table = Table::with(&clip, Arc::default(), Language::English, Theme::Light);
    let hold = Arc::clone(&table.desk);
    let writing = hold.is_writing.lock().unwrap();
    table.tap(Modifiers::COMMAND, Key::E);
    table.harness.get_by_label("Write the files").click();
    (0..3).for_each(|_| table.harness.step());
    table.harness.get_by_label("Stop writing").click();
    (0..3).for_each(|_| table.harness.step());
    drop(writing);
    table.rest();
    table.harness.get_by_label_contains("stopped: nothing was written");
    assert!(!place.path().join("kick-genga").join("sheet.json").exists());
}

#[test]
fn an_export_without_a_card_says_what_it_lacks() {
    let mut table = Table::with_kick();
    table.harness.get_by_label("Export").click();
    table.harness.run();
    let says = "No card is chosen";
    assert!(table.harness.query_by_label_contains(says).is_some());
    assert_eq!(table.focused(), None, "no card looks chosen");
    table.harness.get_by_label("Clip Studio").click();
    table.harness.run();
    assert!(table.harness.query_by_label_contains(says).is_none());
}

#[test]
fn the_work_goes_on_while_results_are_written() {
    let mut table = Table::with_kick();
    let hold = Arc::clone(&table.desk);
    let writing = hold.is_writing.lock().unwrap();
    table.harness.key_press_modifiers(Modifiers::COMMAND, Key::E);
    table.harness.step();
    table.harness.step();
    table.harness.get_by_label("Write the files").click();
    table.harness.step();
    table.harness.step();
    let name = "exporting to";
    table.harness.get_by_label_contains(name);
    let button = table.harness.get_by_label("Export");
    assert!(egui_kittest::kittest::NodeT::accesskit_node(&button).is_disabled());
    table.harness.key_press(Key::K);
    table.harness.step();
    table.harness.step();
    assert!(!table.edits().is_empty(), "a key was set meanwhile");
    drop(writing);
    table.rest();
    assert!(table.harness.query_by_label_contains(name).is_none());
    let written = hold.exported.lock().unwrap();
    assert!(written[0].is_empty(), "what was there when the export began");
}

#[test]
fn a_clip_is_chosen_in_a_dialog_and_offered_again() {
    let desk: Arc<Memory> = Arc::default();
    *desk.chosen.lock().unwrap() = Some(sample("swing.bvh"));
    let mut table = Table::empty(Arc::clone(&desk), Language::English, Theme::Light);
    table.harness.get_by_label("Choose a file…").click();
    for _ in 0..400 {
        table.harness.step();
        if table.harness.state().is_opening() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    table.wait();
    assert_eq!(table.harness.state().title(), "swing – genga");
    let again =
        Table::with(&sample("kick.bvh"), Arc::clone(&desk), Language::English, Theme::Light);
    assert_eq!(*desk.opened.lock().unwrap(), [sample("kick.bvh"), sample("swing.bvh")]);
    drop(again);
    let mut empty = Table::empty(desk, Language::English, Theme::Light);
    empty.harness.get_by_label("swing.bvh").click();
    empty.harness.step();
    empty.wait();
    assert_eq!(empty.harness.state().title(), "swing – genga");
}

#[test]
fn a_folder_is_a_list_of_takes_to_go_through() {
    let place = tempfile::tempdir().unwrap();
    for name in ["kick.bvh", "pitch.bvh", "swing.bvh"] {
        std::fs::copy(sample(name), place.path().join(name)).unwrap();
    }
    std::fs::write(place.path().join("notes.txt"), "no take").unwrap();
    let mut table = Table::empty(Arc::default(), Language::English, Theme::Light);
    table.drop_file(place.path());
    assert_eq!(table.harness.state().title(), "kick – genga");
    table.harness.get_by_label("Takes 0 / 3");
    table.tap(Modifiers::COMMAND, Key::D);
    table.harness.get_by_label("kick · done");
    table.turn("spacing.on", "3");
    table.harness.get_by_label("One recipe for all").click();
    table.harness.run();
    table.harness.get_by_label("Next").click();
    table.harness.step();
    table.wait();
    assert_eq!(table.harness.state().title(), "pitch * – genga");
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "3");
    table.tap(Modifiers::COMMAND, Key::F);
    table.harness.get_by_label("pitch · flagged");
    table.harness.key_press_modifiers(Modifiers::COMMAND, Key::ArrowUp);
    table.harness.step();
    table.wait();
    assert_eq!(table.harness.state().title(), "kick – genga", "a step saves");
    assert_eq!(table.recipe().get("spacing.on").unwrap(), "3");
    let marks = table.desk.text(&place.path().join("genga-takes.txt")).unwrap();
    assert_eq!(marks, "done kick.bvh\nflagged pitch.bvh\n");
}
