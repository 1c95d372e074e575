use proptest::prelude::*;
use serde_json::Value;

use super::super::read::Column;
use super::super::tests::sheets::{cut_of_24, layer, sheet};
use super::super::{Xdts, read, read_cells};
use super::{IntoTimesheet, PaperColumn, PutInto};
use genga::sheet::Sheet;
use genga::sheet::{Blank, SpokenLine};

/// A director's timesheet, spelled unlike ours: other order, blanks, unknown members, camera work and dialogue.
const DIRECTORS: &str = "exchangeDigitalTimeSheet Save Data\r\n{ \"version\" : 5,\r\n\t\"memo\": \"手描き \\u3042\",\r\n  \
    \"timeTables\":[ {\"name\":\"c012\", \"frameRate\": 24.0, \"duration\": 60,\r\n\
    \"timeTableHeaders\":[{\"names\":[\"A\", \"BOOK\" ],\"fieldId\":0},{\"fieldId\":3,\"names\":[\"S1\"]},\r\n\
    {\"fieldId\":5,\"names\":[\"CAM\"]}],\r\n\"fields\":[{\"tracks\":[\r\n\
    {\"trackNo\":0,\"frames\":[{\"frame\":0,\"data\":[{\"values\":[\"1\"],\"id\":0,\"memo\":\"x\"}]},\
    {\"frame\":60,\"data\":[{\"id\":0,\"values\":[\"SYMBOL_NULL_CELL\"]}]}]},\r\n\
    {\"trackNo\":1,\"frames\":[{\"frame\":0,\"data\":[{\"id\":0,\"values\":[\"SYMBOL_NULL_CELL\"]}]}]}\r\n],\"fieldId\":0},\
    {\"fieldId\":3,\"tracks\":[{\"trackNo\":0,\"frames\":[{\"frame\":2,\"data\":[{\"id\":0,\"values\":[\"アキ\",\"えい！\"]}]}]}]},\
    {\"fieldId\":5,\"tracks\":[{\"trackNo\":0,\"frames\":[{\"frame\":3,\"data\":[{\"id\":0,\"values\":[\"PAN\"]}]}]}]}]}],\r\n\
    \"header\":{\"scene\":\"3\",\"cut\":\"12\"}}\r\n";

fn named(name: &str) -> IntoTimesheet {
    IntoTimesheet { names: vec![name.into()], ..IntoTimesheet::default() }
}

fn put(into: &IntoTimesheet, timesheet: &str, sheet: &Sheet) -> (String, Vec<String>) {
    let PutInto { bytes, notes } = into.put(timesheet.as_bytes(), sheet).unwrap();
    (String::from_utf8(bytes).unwrap(), notes)
}

/// The parts of a text that a changed one still has, in front and at the end.
fn common(old: &str, new: &str) -> (usize, usize) {
    let front = old.bytes().zip(new.bytes()).take_while(|(a, b)| a == b).count();
    let back = old.bytes().rev().zip(new.bytes().rev()).take_while(|(a, b)| a == b).count();
    (front, back)
}

#[test]
fn a_new_column_comes_after_the_last_and_all_else_stays_byte_for_byte() {
    let late = cut_of_24().with_blank(Blank { before: 24, after: 12 });
    let (text, notes) = put(&named("C"), DIRECTORS, &late);
    assert_eq!(
        notes,
        [
            "the timesheet has no inbetween marks: all drawings are numbered (CELL)",
            "column C in CELL is new"
        ]
    );
    // Without the two pieces that were put in, it is the text that it was.
    let name = text.find(",\"C\"").unwrap();
    let track = text.find(",{\"frames\":[{\"data\"").unwrap();
    let end = track + text[track..].find("\"trackNo\":2}").unwrap() + "\"trackNo\":2}".len();
    let without = [&text[..name], &text[name + 4..track], &text[end..]].concat();
    assert_eq!(without, DIRECTORS);
    let back = read(text.as_bytes()).unwrap();
    let own = read(Xdts::default().write(&late, "c012").unwrap().douga.as_bytes()).unwrap();
    assert_eq!(back.columns[2], Column { track: 2, name: "C".into(), ..own.columns[0].clone() });
    assert_eq!(back.columns[..2], read(DIRECTORS.as_bytes()).unwrap().columns[..]);
    assert_eq!((back.length, back.lines.len()), (60, 1));
}

#[test]
fn an_empty_column_is_filled_and_one_with_drawings_only_if_it_is_said() {
    let (text, notes) = put(&named("BOOK"), DIRECTORS, &cut_of_24());
    assert_eq!(notes[1], "column BOOK in CELL was empty and is filled");
    let (front, back) = common(DIRECTORS, &text);
    assert!(
        DIRECTORS[..front].contains("\"trackNo\":1,\"frames\":[") && front + back < DIRECTORS.len()
    );
    assert!(DIRECTORS[DIRECTORS.len() - back..].starts_with("}]}\r\n],\"fieldId\":0}"), "{text}");
    let error = IntoTimesheet::default().put(DIRECTORS.as_bytes(), &cut_of_24()).unwrap_err();
    assert!(
        error.to_string().contains("a column A with drawings: replace it with --replace"),
        "{error}"
    );
    let replaces = IntoTimesheet { replaces: true, ..IntoTimesheet::default() };
    let (text, notes) = put(&replaces, DIRECTORS, &cut_of_24());
    assert_eq!(notes[1], "column A in CELL is replaced");
    let there = read(text.as_bytes()).unwrap();
    assert_eq!(there.columns[0].changes.len(), 8);
    assert_eq!(there.columns[1], read(DIRECTORS.as_bytes()).unwrap().columns[1]);
    assert!(!text.contains("\"memo\":\"x\""), "what was on the replaced column is gone with it");
}

#[test]
fn the_timesheet_becomes_longer_only_if_the_cut_is() {
    let (text, _) = put(&named("C"), DIRECTORS, &cut_of_24());
    assert!(text.contains("\"duration\": 60,"));
    let long = cut_of_24().with_blank(Blank { before: 50, after: 0 });
    let (text, notes) = put(&named("C"), DIRECTORS, &long);
    assert!(text.contains("\"duration\": 74,"), "{text}");
    assert_eq!(
        notes[1],
        "the timesheet had 60 koma and has 74 now; its other columns stay as they are"
    );
}

#[test]
fn a_sheet_of_marks_gets_numbered_keys_and_a_word_decides_otherwise() {
    let marked =
        DIRECTORS.replacen("[\"SYMBOL_NULL_CELL\"]}]}]}\r\n]", "[\"SYMBOL_TICK_1\"]}]}]}\r\n]", 1);
    let (text, notes) = put(&named("C"), &marked, &cut_of_24());
    assert_eq!(notes[1], "column C in ACTION is new");
    assert_eq!(text.matches("SYMBOL_TICK_1").count(), 1 + 3);
    let cell = IntoTimesheet { column: Some(PaperColumn::Cell), ..named("C") };
    let (text, notes) = put(&cell, &marked, &cut_of_24());
    assert_eq!((text.matches("SYMBOL_TICK_1").count(), notes.len()), (1, 1));
}

#[test]
fn a_tdts_gets_both_columns_and_keeps_its_own_members() {
    for version in [5, 11] {
        let theirs = super::super::Tdts { version, ..Default::default() };
        let mut theirs = theirs.write(&cut_of_24(), "s1_c2").unwrap();
        theirs = theirs.replacen("\"duration\":24", "\"color\":3,\"duration\":24", 1);
        let (text, notes) = put(&named("B"), &theirs, &cut_of_24());
        assert_eq!(notes, ["column B in ACTION is new", "column B in CELL is new"], "{version}");
        let (action, cell) = (read(text.as_bytes()).unwrap(), read_cells(text.as_bytes()).unwrap());
        for sheet in [&action, &cell] {
            assert_eq!(sheet.columns[0].changes, sheet.columns[1].changes);
            assert_eq!((sheet.columns.len(), &*sheet.columns[1].name), (2, "B"));
        }
        assert_eq!(cell.columns[0].changes.len(), 7);
        assert!(text.contains("\"color\":3,"));
    }
}

#[test]
fn lists_that_are_not_there_are_made() {
    let bare = "toeiDigitalTimeSheet Save Data{\"timeTables\":[{\"duration\":9,\"name\":\"\"}],\"version\":5}";
    let (text, _) = put(&IntoTimesheet::default(), bare, &cut_of_24());
    let [action, cell] = [read(text.as_bytes()).unwrap(), read_cells(text.as_bytes()).unwrap()];
    assert_eq!((action.length, action.columns.len(), cell.columns.len()), (24, 1, 1));
    assert_eq!(action.columns[0].name, "A");
    let empty = "exchangeDigitalTimeSheet Save Data\n{\"timeTables\":[{\"duration\":9,\"timeTableHeaders\":[ ],\
                 \"fields\":[]}],\"version\":5}";
    let (text, _) = put(&IntoTimesheet::default(), empty, &cut_of_24());
    assert_eq!(read_cells(text.as_bytes()).unwrap().columns[0].changes.len(), 7);
}

#[test]
fn what_cannot_be_put_in_is_refused() {
    let said = |into: &IntoTimesheet, timesheet: &str, sheet: &Sheet| {
        into.put(timesheet.as_bytes(), sheet).unwrap_err().to_string()
    };
    let two = sheet(vec![layer("A", "e", &[(0, 1)]), layer("B", "e", &[(0, 1)])]);
    assert!(said(&named("A"), DIRECTORS, &two).contains("2 layers, and there are names for 1"));
    let twice = IntoTimesheet { names: vec!["X".into(), "X".into()], ..IntoTimesheet::default() };
    assert!(said(&twice, DIRECTORS, &two).contains("two layers of the sheet would be column X"));
    let twins = DIRECTORS.replacen("\"BOOK\"", "\"A\"", 1);
    assert!(said(&named("A"), &twins, &cut_of_24()).contains("two columns A"));
    assert!(said(&named("A"), "{}", &cut_of_24()).contains("expected \"exchange"));
    assert!(said(&named("A"), "exchangeDigitalTimeSheet Save Data{}", &cut_of_24()).contains("no"));
    assert!(said(&named("A"), DIRECTORS, &sheet(vec![])).contains("no koma"));
    let mut spoken = cut_of_24();
    spoken.lines = vec![SpokenLine { begin: 0, koma: 2, speaker: "".into(), words: "a".into() }];
    assert!(
        put(&named("C"), DIRECTORS, &spoken)
            .1
            .last()
            .unwrap()
            .contains("spoken lines are not put in")
    );
}

proptest! {
    /// Whatever a file looks like, a column more leaves every value of it as it was.
    #[test]
    fn every_other_value_stays(theirs in super::super::tests::laws::any_sheet(), pretty in any::<bool>()) {
        let text = Xdts::default().write(&theirs, "c1").unwrap().douga;
        let (signature, json) = text.split_once('\n').unwrap();
        let before: Value = serde_json::from_str(json).unwrap();
        let text = match pretty {
            true => format!("{signature}\n{}", serde_json::to_string_pretty(&before).unwrap()),
            false => text.clone(),
        };
        let (put, _) = put(&named("新"), &text, &cut_of_24());
        let mut after: Value = serde_json::from_str(put.split_once('\n').unwrap().1).unwrap();
        let table = &mut after["timeTables"][0];
        prop_assert_eq!(table["fields"][0]["tracks"].as_array_mut().unwrap().pop().unwrap()["trackNo"].as_u64(), Some(theirs.layers.len() as u64));
        table["timeTableHeaders"][0]["names"].as_array_mut().unwrap().pop();
        let length = theirs.cut_length().max(24);
        prop_assert_eq!(table["duration"].as_u64(), Some(length as u64));
        table["duration"] = before["timeTables"][0]["duration"].clone();
        prop_assert_eq!(after, before);
    }
}
