//! Sheets for programs and for paper as written by the program, and keys that a person marked on them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::clips::here;

fn genga(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_genga"));
    command.current_dir(folder).args(args).stdin(Stdio::null()).output().unwrap()
}

fn kick() -> String {
    here("data/kick.bvh").to_string_lossy().into_owned()
}

/// A folder with the files that `run` delivers for the kick.
fn delivered(more: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let kick = kick();
    let run = ["run", &kick, "--deliver", "xdts,xsheet", "--out", "out"];
    let made = genga(folder.path(), &[&run, more].concat());
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    folder
}

fn refused(folder: &Path, args: &[&str]) -> String {
    let output = genga(folder, args);
    assert!(!output.status.success());
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn run_delivers_both_timesheets_and_the_paper() {
    let folder = delivered(&[]);
    let text = |name: &str| fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    for name in ["kick_genga_ts.xdts", "kick_douga_ts.xdts"] {
        assert!(text(name).starts_with("exchangeDigitalTimeSheet Save Data\n{"));
        assert!(!text(name).contains("OPTION_KEYFRAME"));
    }
    assert!(text("kick_xsheet.html").starts_with("<!DOCTYPE html>"));
    assert!(text("xsheet/0001.svg").starts_with("<svg "));
}

#[test]
fn keys_marked_on_a_sheet_come_back_as_pins() {
    let folder = delivered(&["--with", "xdts.circled=true"]);
    let kick = kick();
    let alone = ["--set", "keys.min_price=1000", "--set", "keys.rest=0"];
    let keys = |more: &[&str]| {
        let output = genga(folder.path(), &[&["keys", &kick], more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let table = String::from_utf8(output.stdout).unwrap();
        // Column, koma and source frame of a row.
        let number = |row: &csv::StringRecord, at: usize| row[at].parse::<usize>().unwrap();
        let row = |row: csv::StringRecord| (row[1].to_owned(), number(&row, 6), number(&row, 9));
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let rows: Vec<_> = reader.records().map(|record| row(record.unwrap())).collect();
        (rows, table, String::from_utf8(output.stderr).unwrap())
    };
    let (own, ..) = keys(&[]);
    for file in ["out/kick_genga_ts.xdts", "out/kick_douga_ts.xdts"] {
        let (back, table, said) = keys(&[&["--pin-from", file], &alone[..]].concat());
        // A found key may be drawn before its own koma; the sheet beside the file knows its frame.
        let frames = |rows: &[(String, usize, usize)]| {
            rows.iter().map(|(column, _, frame)| (column.clone(), *frame)).collect::<Vec<_>>()
        };
        assert_eq!(frames(&back), frames(&own), "{file}");
        assert!(table.contains("pinned: A2"), "{table}");
        // The first and the last drawing are there anyway.
        let pinned = format!("pinned from {file}: {} keys of column A; 2 others", own.len() - 2);
        assert!(said.contains(&pinned), "{said}");
    }
    let (_, table, _) = keys(&["--pin-from", "out/kick_genga_ts.xdts", "--pin", "0:mine"]);
    assert!(table.contains("pinned: mine") && !table.contains("pinned: A1;"), "{table}");
}

#[test]
fn the_marked_sheet_is_not_written_over() {
    let folder = delivered(&[]);
    let (kick, marked) = (kick(), folder.path().join("out/kick_genga_ts.xdts"));
    let before = fs::read(&marked).unwrap();
    let run = ["run", &kick, "--pin-from", "out/kick_genga_ts.xdts", "--out", "out"];
    for format in ["xdts", "csv,all"] {
        let said = refused(folder.path(), &[&run[..], &["--deliver", format]].concat());
        assert!(said.contains("write over the sheet you marked"), "{said}");
        assert_eq!(fs::read(&marked).unwrap(), before);
    }
    assert!(genga(folder.path(), &run).status.success(), "no sheet is written");
}

#[test]
fn a_douga_sheet_without_circles_has_no_keys_and_says_what_to_give() {
    let folder = delivered(&[]);
    let kick = kick();
    let said = refused(folder.path(), &["keys", &kick, "--pin-from", "out/kick_douga_ts.xdts"]);
    for word in
        ["out/kick_douga_ts.xdts: ", "circled", "_genga_ts.xdts", "--with xdts.circled=true"]
    {
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn what_is_no_timesheet_or_not_of_this_clip_is_refused_in_words() {
    let folder = delivered(&[]);
    let (kick, place) = (kick(), folder.path());
    let said = refused(place, &["keys", &kick, "--pin-from", &kick]);
    assert!(said.contains("kick.bvh: line 1: there is no column source_frame"), "{said}");
    let genga = ["keys", &kick, "--pin-from", "out/kick_genga_ts.xdts"];
    let said = refused(place, &[&genga[..], &["--trim", "0..40"]].concat());
    assert!(said.contains("it has 92 koma and the sheet of this clip 40"), "{said}");
    let said = refused(place, &[&genga[..], &["--pin-column", "B"]].concat());
    assert!(said.contains("there is no column B; there are A"), "{said}");
    let said = refused(place, &["keys", &kick, "--pin-from", "none.xdts"]);
    assert!(said.contains("none.xdts"), "{said}");
}

#[test]
fn a_timesheet_that_was_edited_lays_its_timing_on_the_motion() {
    let folder = delivered(&["--deliver", "cut"]);
    let kick = kick();
    let text = |file: &str| fs::read_to_string(folder.path().join(file)).unwrap();
    let deliver = |sheet: &str, out: &str, more: &[&str]| {
        let words = ["deliver", sheet, &kick, "--to", "csv,bvh", "--out", out];
        let output = genga(folder.path(), &[&words, more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stderr).unwrap()
    };
    let said = deliver("out/kick_douga_ts.xdts", "same", &[]);
    assert!(said.contains("those of out/sheet.json"), "{said}");
    for file in ["limited.bvh", "sheet.csv", "keys.csv"] {
        assert_eq!(text(&format!("same/{file}")), text(&format!("out/{file}")), "{file}");
    }
    // As another program writes it: on one line, members in another order, without drawing 3, and with drawing 5 again
    // on koma 88.
    let (signature, json) = text("out/kick_douga_ts.xdts")
        .split_once('\n')
        .map(|(a, b)| (a.to_owned(), b.to_owned()))
        .unwrap();
    let mut file: serde_json::Value = serde_json::from_str(&json).unwrap();
    let frames = file["timeTables"][0]["fields"][0]["tracks"][0]["frames"].as_array_mut().unwrap();
    let number =
        |frame: &serde_json::Value| frame["data"][0]["values"][0].as_str().unwrap().to_owned();
    frames.retain(|frame| number(frame) != "3");
    let mut fifth = frames.iter().find(|frame| number(frame) == "5").unwrap().clone();
    fifth["frame"] = 87.into();
    frames.insert(0, fifth);
    fs::write(folder.path().join("edited.xdts"), format!("{signature}\n{file}")).unwrap();
    deliver("edited.xdts", "back", &["--drawings", "out/sheet.json"]);
    let drawings = |file: &str| -> Vec<usize> {
        let mut table = csv::Reader::from_path(folder.path().join(file)).unwrap();
        table.records().map(|row| row.unwrap()[2].parse().unwrap()).collect()
    };
    let mut expected = drawings("out/sheet.csv");
    expected.iter_mut().filter(|drawing| **drawing == 3).for_each(|drawing| *drawing = 2);
    let end =
        expected[87..].iter().position(|drawing| *drawing != expected[87]).map_or(92, |at| 87 + at);
    expected[87..end].fill(5);
    assert_eq!(drawings("back/sheet.csv"), expected);
    // The pose of each koma is that of its drawing in the whole run's file.
    let rows = |file: &str| -> Vec<String> {
        text(file)
            .lines()
            .skip_while(|line| !line.starts_with("Frame Time"))
            .skip(1)
            .map(str::to_owned)
            .collect()
    };
    let (before, after) = (rows("out/limited.bvh"), rows("back/limited.bvh"));
    let first =
        |drawing: usize| drawings("out/sheet.csv").iter().position(|at| *at == drawing).unwrap();
    for (koma, drawing) in expected.iter().enumerate() {
        assert_eq!(after[koma], before[first(*drawing)], "koma {koma}");
    }
    // From a cut folder, the run's sheet is two folders above.
    deliver("out/kick/douga/kick_douga_ts.xdts", "cut", &[]);
    let said = refused(folder.path(), &["deliver", "edited.xdts", &kick, "--to", "bvh"]);
    assert!(said.contains("no sheet.json is beside it") && said.contains("--drawings"), "{said}");
    let words = ["deliver", "out/kick_genga_ts.xdts", &kick, "--to", "bvh", "--out", "x"];
    let said = refused(folder.path(), &words);
    assert!(said.contains("out/kick_genga_ts.xdts: this is a timesheet of key drawings"), "{said}");
}
