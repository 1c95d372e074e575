//! Properties of every written file.

use std::path::Path;

use serde_json::Value;

use super::open_toonz;
use super::sheets::{cut_of_24, layer, sheet};
use crate::xdts::{Xdts, XdtsPair, read};
use genga::edits::Edits;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Blank, Sheet};
use genga::slate::Slate;

fn here(path: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

pub(super) fn json(file: &str) -> Value {
    serde_json::from_str(file.strip_prefix("exchangeDigitalTimeSheet Save Data\n").unwrap())
        .unwrap()
}

fn both(sheet: &Sheet, cut: &str) -> XdtsPair {
    Xdts { circled: true }.write(sheet, cut).unwrap()
}

pub(super) fn sample(name: &str) -> (Clip, Sheet) {
    let clip = bvh::read(&std::fs::read(here("data").join(name)).unwrap()).unwrap().clip;
    let clip = genga::motion::clean::lead_in::strip(clip).0;
    let mut engine = Engine::new(clip.clone()).unwrap();
    let sheet = engine.run(&Recipe::default(), &Edits::default()).unwrap().sheet.clone();
    (clip, sheet)
}

const SAMPLES: [&str; 5] = ["kick.bvh", "kuroda-pitch.bvh", "pitch.bvh", "swing.bvh", "tennis.bvh"];

/// Checks everything that holds for both files of any sheet.
pub(super) fn holds(sheet: &Sheet, cut: &str) {
    let made = both(sheet, cut);
    for file in [&made.genga, &made.douga] {
        let table = &json(file)["timeTables"][0];
        assert_eq!(table["name"], cut);
        assert_eq!(table["duration"], sheet.cut_length());
        let names = table["timeTableHeaders"][0]["names"].as_array().unwrap();
        let tracks = table["fields"][0]["tracks"].as_array().unwrap();
        assert!(
            tracks.iter().all(|track| names.len() > track["trackNo"].as_u64().unwrap() as usize)
        );
        for (track, layer) in tracks.iter().zip(&sheet.layers) {
            let entries = track["frames"].as_array().unwrap();
            let koma: Vec<_> = entries.iter().map(|e| e["frame"].as_u64().unwrap()).collect();
            assert!(koma.is_sorted_by(|a, b| a < b), "{koma:?}");
            assert_eq!(koma[0], 0);
            let values: Vec<_> =
                entries.iter().map(|e| e["data"][0]["values"][0].as_str().unwrap()).collect();
            assert_eq!(values[values.len() - 1], "SYMBOL_NULL_CELL");
            let before = sheet.blank.before as u64;
            assert_eq!(koma[koma.len() - 1], before + layer.length() as u64);
            if before > 0 {
                assert_eq!((values[0], koma[1]), ("SYMBOL_NULL_CELL", before));
            }
            for pair in values.windows(2) {
                assert!(pair[0] != pair[1] || pair[0] == "SYMBOL_TICK_1", "{values:?}");
            }
        }
    }
    open_toonz::agrees(sheet, &made.genga, &made.douga);
    round_trip(sheet, &made);
}

/// Checks that both files read back as the sheet.
fn round_trip(sheet: &Sheet, made: &XdtsPair) {
    let [genga, douga] = [&made.genga, &made.douga].map(|file| read(file.as_bytes()).unwrap());
    assert_eq!((genga.length, douga.length), (sheet.cut_length(), sheet.cut_length()));
    let before = sheet.blank.before;
    for ((layer, genga), douga) in sheet.layers.iter().zip(&genga.columns).zip(&douga.columns) {
        let number = |mark: &crate::xdts::Mark| match mark {
            crate::xdts::Mark::Drawing(number) => number.parse::<usize>().ok(),
            _ => None,
        };
        let end = before + layer.length();
        let drawings: Vec<_> = douga
            .on_koma(end)
            .skip(before)
            .map(|change| number(&change.mark).unwrap() - 1)
            .collect();
        assert_eq!(drawings, layer.koma().collect::<Vec<_>>());
        let kept = genga.on_koma(end).skip(before).map(|change| number(&change.mark).is_some());
        let meant = layer.koma().map(|drawing| layer.drawings[drawing].role.is_kept());
        assert!(kept.eq(meant), "keys are numbered, inbetweens are marks");
        for column in [genga, douga] {
            let koma = column.on_koma(sheet.cut_length()).enumerate();
            let mut blank = koma.filter(|(koma, _)| !(before..end).contains(koma));
            assert!(blank.all(|(_, change)| change.mark == crate::xdts::Mark::Blank));
        }
    }
}

#[test]
fn every_sample_is_the_same_in_both_files_koma_by_koma() {
    for name in SAMPLES {
        holds(&sample(name).1, name);
    }
}

#[test]
fn the_signature_is_a_line_of_its_own_and_no_mark_is_in_front() {
    let made = both(&cut_of_24(), "c001");
    for file in [&made.genga, &made.douga] {
        assert!(file.starts_with("exchangeDigitalTimeSheet Save Data\n{\""), "{file}");
        assert!(file.ends_with("}\n"));
    }
}

#[test]
fn the_files_of_a_kick_look_as_they_did() {
    let made = both(&sample("kick.bvh").1, "kick");
    insta::assert_snapshot!("genga", made.genga);
    insta::assert_snapshot!("douga", made.douga);
}

#[test]
fn cut_and_scene_of_the_name_go_into_the_header_and_the_whole_name_stays() {
    let header = |cut: &str| {
        let file = json(&both(&cut_of_24(), cut).genga);
        assert_eq!(file["timeTables"][0]["name"], cut);
        let text = |member: &str| file["header"][member].as_str().unwrap_or("-").to_owned();
        [text("cut"), text("scene")]
    };
    assert_eq!(header("s03_c045"), ["45", "3"]);
    assert_eq!(header("EP12_SC1_C012A"), ["12", "1"]);
    assert_eq!(header("take20240501_s2_c5"), ["5", "2"]);
    for without in ["kick", "", "20240501", "蹴り", "c045", "cmu-11_01-soccer-kick", "s1_walk_c3d"]
    {
        assert_eq!(header(without), ["-", "-"], "{without}");
    }
}

#[test]
fn a_slate_goes_into_the_header_over_the_name() {
    let slate = Slate { scene: "4".into(), cut: "C-045a".into(), ..Slate::default() };
    let file = json(&both(&Sheet { slate, ..cut_of_24() }, "s03_c012").genga);
    assert_eq!(file["header"], serde_json::json!({ "cut": "45", "scene": "4" }));
    assert_eq!(file["timeTables"][0]["name"], "s03_c012");
}

#[test]
fn a_cut_that_is_entered_late_and_left_early_has_null_cells_at_both_ends() {
    let sheet = cut_of_24().with_blank(Blank { before: 24, after: 12 });
    holds(&sheet, "c1");
    let read = read(both(&sheet, "c1").douga.as_bytes()).unwrap();
    let spelled = super::sheets::spelled(&read.columns[0], read.length);
    let blank = |koma: usize| vec!["x"; koma].join(" ");
    let drawn = "1 1 1 1 1 1 2 2 3 3 4 4 4 5 5 5 6 6 6 7 7 7 7 7";
    assert_eq!(spelled, format!("{} {drawn} {}", blank(24), blank(12)));
}

#[test]
fn columns_of_one_name_are_told_apart_by_their_tracks() {
    let two = sheet(vec![
        layer("A", "ee", &[(0, 3), (1, 2)]),
        layer("A", "eie", &[(0, 1), (1, 2), (2, 2)]),
    ]);
    holds(&two, "c1");
    let read = read(both(&two, "c1").genga.as_bytes()).unwrap();
    let columns: Vec<_> = read
        .columns
        .iter()
        .map(|column| (column.track, &*column.name, column.changes.len()))
        .collect();
    assert_eq!(columns, [(0, "A", 2), (1, "A", 3)]);
}

#[test]
fn no_column_has_a_name_that_means_sound_or_no_name() {
    let layers = ["S1", "s9", "", "S10", "腕"].map(|name| layer(name, "e", &[(0, 1)]));
    let read = read(both(&sheet(layers.to_vec()), "c1").douga.as_bytes()).unwrap();
    let names: Vec<_> = read.columns.iter().map(|column| &*column.name).collect();
    assert_eq!(names, ["cel_S1", "cel_s9", "C", "S10", "腕"]);
}

#[test]
fn a_drawing_shown_again_has_its_number_again() {
    let again = sheet(vec![layer("A", "egie", &[(0, 2), (1, 2), (0, 1), (0, 2), (2, 1), (3, 1)])]);
    let made = both(&again, "c1");
    open_toonz::agrees(&again, &made.genga, &made.douga);
    let columns = [&made.genga, &made.douga].map(|file| {
        let read = read(file.as_bytes()).unwrap();
        super::sheets::spelled(&read.columns[0], read.length)
    });
    assert_eq!(columns, ["1 1 2 2 1 1 1 1o 3", "1 1 2 2 1 1 1 3 4"]);
}

#[test]
fn the_smallest_sheets_are_written_and_none_is_refused() {
    holds(&sheet(vec![layer("A", "e", &[(0, 1)])]), "蹴り \"1\"\n");
    holds(&sheet(vec![layer("A", "e", &[(0, 1)]), layer("B", "", &[])]), "c1");
    for empty in [sheet(vec![]), sheet(vec![layer("A", "", &[])])] {
        let error = Xdts::default().write(&empty, "c1").unwrap_err().to_string();
        assert!(error.contains("no koma"), "{error}");
    }
    let lying = sheet(vec![layer("A", "e", &[(1, 1)])]);
    let error = Xdts::default().write(&lying, "c1").unwrap_err().to_string();
    assert_eq!(error, "layer A shows drawing 1 but has 1");
}
