use std::sync::LazyLock;

use proptest::prelude::*;
use serde_json::{Value, json};

use super::super::{Tdts, Xdts, read_cells};
use super::*;
use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;

fn sheet(layers: &str) -> Sheet {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh");
    let mut engine = Engine::new(bvh::open(path.as_ref()).unwrap().clip).unwrap();
    let mut recipe = Recipe::default();
    recipe.set("layers", layers).unwrap();
    engine.run(&recipe, &Edits::default()).unwrap().sheet.clone()
}

/// A sheet of the whole body, for tests of many cases.
static BODY: LazyLock<Sheet> = LazyLock::new(|| sheet("body"));

fn douga(sheet: &Sheet) -> String {
    Xdts::default().write(sheet, "kick").unwrap().douga
}

/// A small editor that follows the published rules and changes the frames of a track of the first field.
fn edited(text: &str, track: usize, edit: impl FnOnce(&mut Vec<(u64, String)>)) -> String {
    let (signature, json) = text.split_once('\n').unwrap();
    let mut file: Value = serde_json::from_str(json).unwrap();
    let frames = &mut file["timeTables"][0]["fields"][0]["tracks"][track]["frames"];
    let read = |frame: &Value| {
        let value = frame["data"][0]["values"][0].as_str().unwrap().to_owned();
        (frame["frame"].as_u64().unwrap(), value)
    };
    let mut entries = frames.as_array().unwrap().iter().map(read).collect();
    edit(&mut entries);
    let write = |(frame, value): &(u64, String)| json!({ "frame": frame, "data": [{ "id": 0, "values": [value] }] });
    *frames = entries.iter().map(write).collect();
    format!("{signature}\n{file}")
}

/// The drawing on each koma of a layer, from 1.
fn on_koma(sheet: &Sheet, layer: usize) -> Vec<usize> {
    sheet.layers[layer].koma().map(|drawing| drawing + 1).collect()
}

#[test]
fn what_comes_back_unchanged_is_the_same_sheet() {
    for layers in ["body", "limbs", "joints"] {
        let sheet = sheet(layers);
        assert_eq!(retimed(&read_cells(douga(&sheet).as_bytes()).unwrap(), &sheet).unwrap(), sheet);
        for version in [5, 11] {
            let tdts = Tdts { version, ..Tdts::default() }.write(&sheet, "kick").unwrap();
            assert_eq!(retimed(&read_cells(tdts.as_bytes()).unwrap(), &sheet).unwrap(), sheet);
        }
        let late = sheet.clone().with_blank(Blank { before: 24, after: 9 });
        for before in [&sheet, &late] {
            let back = retimed(&read_cells(douga(&late).as_bytes()).unwrap(), before).unwrap();
            assert_eq!(back, late, "{layers}: whatever it was before");
        }
    }
}

#[test]
fn a_column_may_leave_early_and_must_not_enter_late_alone() {
    let sheet = sheet("limbs");
    let later = |track: usize, koma: u64| {
        let text = edited(&douga(&sheet), track, |entries| {
            entries.retain(|(at, _)| *at >= koma);
            entries.push((0, "SYMBOL_NULL_CELL".into()));
            entries.push((koma, "1".into()));
        });
        retimed(&read_cells(text.as_bytes()).unwrap(), &sheet)
    };
    let error = later(1, 5).unwrap_err().to_string();
    assert!(error.contains("column B, koma 1: nothing is shown there"), "{error}");
    let text = edited(&douga(&sheet), 1, |entries| {
        entries.retain(|(at, _)| *at < 50);
        entries.push((50, "SYMBOL_NULL_CELL".into()));
    });
    let back = retimed(&read_cells(text.as_bytes()).unwrap(), &sheet).unwrap();
    assert_eq!((back.layers[1].length(), back.blank), (50, Blank::default()));
}

#[test]
fn drawings_are_moved_held_shown_twice_and_left_out() {
    let sheet = sheet("body");
    let text = edited(&douga(&sheet), 0, |entries| {
        let (second, third) = (entries[1].0, entries[2].0);
        // Move the second drawing a koma earlier, drop the third, and show the second again on koma 81.
        entries[1].0 = second - 1;
        entries.retain(|(koma, _)| *koma != third);
        entries.retain(|(koma, _)| !(80..84).contains(koma));
        entries.push((80, "2".into()));
    });
    let back = retimed(&read_cells(text.as_bytes()).unwrap(), &sheet).unwrap();
    let (before, after) = (on_koma(&sheet, 0), on_koma(&back, 0));
    let [second, third, fourth] =
        [2, 3, 4].map(|number| before.iter().position(|at| *at == number).unwrap());
    assert_eq!(after.len(), before.len());
    assert_eq!(after[..second - 1], before[..second - 1]);
    assert!(after[second - 1..fourth].iter().all(|drawing| *drawing == 2), "{third}: {after:?}");
    assert_eq!(after[80], 2);
    assert_eq!(back.layers[0].drawings, sheet.layers[0].drawings, "poses, roles and reasons stay");
}

#[test]
fn of_several_columns_each_has_its_own_timing_by_its_name() {
    let sheet = sheet("limbs");
    let text = edited(&douga(&sheet), 2, |entries| entries[1].0 += 1);
    let mut timesheet = read_cells(text.as_bytes()).unwrap();
    timesheet.columns.reverse();
    let back = retimed(&timesheet, &sheet).unwrap();
    let changed = (0..5).filter(|layer| on_koma(&back, *layer) != on_koma(&sheet, *layer));
    assert_eq!(changed.collect::<Vec<_>>(), [2]);
    timesheet.columns.pop();
    let error = retimed(&timesheet, &sheet).unwrap_err().to_string();
    assert_eq!(error, "the timesheet has no column A; it has E, D, C, B");
}

#[test]
fn what_has_no_pose_is_refused_with_its_place() {
    let sheet = sheet("body");
    let refused = |value: &str, koma: u64| {
        let text = edited(&douga(&sheet), 0, |entries| {
            entries.retain(|(at, _)| *at != koma);
            entries.push((koma, value.into()));
        });
        retimed(&read_cells(text.as_bytes()).unwrap(), &sheet).unwrap_err().to_string()
    };
    for (value, words) in [
        (
            "27",
            "column A, koma 31: the sheet has no drawing 27, it has 1 to 26; one that was added by hand",
        ),
        ("0", "no drawing 0"),
        ("3a", "no drawing 3a"),
        ("SYMBOL_NULL_CELL", "column A, koma 31: nothing is shown there"),
        ("SYMBOL_TICK_1", "key drawings (ACTION)"),
    ] {
        let error = refused(value, 30);
        assert!(error.contains(words), "{value}: {error}");
    }
    let genga = Xdts::default().write(&sheet, "kick").unwrap().genga;
    let error = retimed(&read_cells(genga.as_bytes()).unwrap(), &sheet).unwrap_err().to_string();
    assert!(error.contains("CUT_douga_ts.xdts"), "{error}");
}

proptest! {
    /// Whatever numbers a person writes on the koma come back unchanged.
    #[test]
    fn any_timing_of_drawings_comes_back(numbers in prop::collection::vec(1_usize..=26, 1..200)) {
        let mut sheet = BODY.clone();
        let exposures = numbers.iter().map(|number| Exposure { drawing: number - 1, koma: 1 });
        let original = std::mem::replace(&mut sheet.layers[0].exposures, exposures.collect());
        let text = douga(&sheet);
        sheet.layers[0].exposures = original;
        let back = retimed(&read_cells(text.as_bytes()).unwrap(), &sheet).unwrap();
        prop_assert_eq!(on_koma(&back, 0), numbers);
        prop_assert!(back.check().is_ok());
    }
}
